#include "bench/sundials_band.hpp"

#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_band.h>
#include <sunmatrix/sunmatrix_band.h>

#include <algorithm>
#include <cassert>

namespace hawser::bench {

namespace {

class SundialsBand final : public LinearSolver {
 public:
  SundialsBand() { SUNContext_Create(nullptr, &context_); }
  ~SundialsBand() override {
    release();
    SUNContext_Free(&context_);
  }
  SundialsBand(const SundialsBand&) = delete;
  SundialsBand& operator=(const SundialsBand&) = delete;

  std::string_view name() const override { return "sundials"; }
  bool takes_unsymmetric() const override { return true; }

  void analyze(const BlockTridiagonal& pattern) override {
    assert(pattern.chains().size() == 1);
    release();
    chain_ = pattern.chains().front();
    const auto n = static_cast<sunindextype>(chain_.dofs());
    const sunindextype half_width = 2 * chain_.block - 1;
    matrix_ = SUNBandMatrix(n, half_width, half_width, context_);
    vector_ = N_VMake_Serial(n, nullptr, context_);
    solver_ = SUNLinSol_Band(vector_, matrix_, context_);
    SUNLinSolInitialize(solver_);
  }

  FactorReport factorize(const BlockTridiagonal& matrix) override {
    SUNMatZero(matrix_);
    for (int i = 0; i < chain_.nodes; ++i) {
      place(matrix.D(chain_, i), i, i);
      if (i + 1 == chain_.nodes) continue;
      place(matrix.U(chain_, i), i, i + 1);
      place(matrix.L(chain_, i), i + 1, i);
    }
    FactorReport report;
    if (SUNLinSolSetup(solver_, matrix_) != 0) {
      report.status = FactorStatus::singular;
      report.message = "SUNLinSol_Band met a zero pivot";
    }
    return report;
  }

  void solve(std::span<double> b) override {
    N_VSetArrayPointer(b.data(), vector_);
    SUNLinSolSolve(solver_, matrix_, vector_, vector_, 0.0);
  }

  std::size_t bytes() const override { return sizeof(double) * SM_LDATA_B(matrix_) + sizeof(sunindextype) * chain_.dofs(); }

 private:
  void place(const double* block, int block_row, int block_column) {
    const int n = chain_.block;
    for (int j = 0; j < n; ++j) {
      const sunindextype column = static_cast<sunindextype>(n) * block_column + j;
      std::copy_n(block + n * j, n, SM_COLUMN_B(matrix_, column) + n * (block_row - block_column) - j);
    }
  }

  void release() {
    if (!solver_) return;
    SUNLinSolFree(solver_);
    N_VDestroy(vector_);
    SUNMatDestroy(matrix_);
    solver_ = nullptr;
  }

  SUNContext context_ = nullptr;
  Chain chain_;
  SUNMatrix matrix_ = nullptr;
  N_Vector vector_ = nullptr;
  SUNLinearSolver solver_ = nullptr;
};

}  // namespace

std::unique_ptr<LinearSolver> make_sundials_band_solver() { return std::make_unique<SundialsBand>(); }

}  // namespace hawser::bench
