// CHOLMOD, simplicial L D L^T of a symmetric matrix in its natural order (a chain fills nothing outside its band, and no permuted copy
// is made). D may have either sign, so an indefinite matrix is no breakdown; but rows are not exchanged, so its growth is watched.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include <cholmod.h>
#include <fmt/format.h>

#include "solver/linear/backends.hpp"
#include "solver/linear/csc_map.hpp"
#include "solver/linear/factor_reports.hpp"

namespace hawser {

namespace {

constexpr double symmetric_to = 1e-12;  // relative; what rounding leaves of a tangent that is symmetric by its formula
constexpr double growth_limit = 100.0;  // 1e-14 / eps, as the chain solver

class CholmodSolver final : public LinearSolver {
 public:
  CholmodSolver() {
    cholmod_start(&common_);
    common_.print = 0;
    common_.supernodal = CHOLMOD_SIMPLICIAL;
    common_.final_ll = 0;
    common_.nmethods = 1;
    common_.method[0].ordering = CHOLMOD_NATURAL;
    common_.postorder = 0;
  }
  CholmodSolver(const CholmodSolver&) = delete;
  CholmodSolver& operator=(const CholmodSolver&) = delete;
  ~CholmodSolver() override {
    release();
    cholmod_finish(&common_);
  }

  std::string_view name() const override { return "cholmod"; }
  bool takes_unsymmetric() const override { return false; }

  void analyze(const BlockTridiagonal& pattern) override {
    release();
    map_ = CscMap(pattern, CscMap::Part::upper);
    cholmod_sparse a = matrix_view();
    factor_ = cholmod_analyze(&a, &common_);
    assert(factor_);
  }

  FactorReport factorize(const BlockTridiagonal& matrix) override {
    if (const auto unknown = first_not_finite(matrix)) return not_finite_report(*unknown);
    FactorReport report;
    if (const double asymmetry = matrix.asymmetry(); asymmetry > symmetric_to) {
      report.status = FactorStatus::not_applicable;
      report.message = fmt::format("CHOLMOD takes symmetric matrices only; |A - A^T| is {:.1e} of |A|", asymmetry);
      return report;
    }
    map_.copy_values(matrix);
    cholmod_sparse a = matrix_view();
    cholmod_factorize(&a, factor_, &common_);
    if (common_.status == CHOLMOD_NOT_POSDEF) return singular_report(factor_->minor);
    note_pivots(report);
    return report;
  }

  void solve(std::span<double> b) override {
    cholmod_dense rhs{};
    rhs.nrow = rhs.d = rhs.nzmax = b.size();
    rhs.ncol = 1;
    rhs.x = b.data();
    rhs.xtype = CHOLMOD_REAL;
    rhs.dtype = CHOLMOD_DOUBLE;
    cholmod_solve2(CHOLMOD_A, factor_, &rhs, nullptr, &solution_, nullptr, &work_y_, &work_e_, &common_);
    std::copy_n(static_cast<const double*>(solution_->x), b.size(), b.begin());
  }

  std::size_t bytes() const override { return map_.bytes() + common_.memory_inuse; }

 private:
  cholmod_sparse matrix_view() {
    cholmod_sparse a{};
    a.nrow = a.ncol = static_cast<std::size_t>(map_.unknowns());
    a.nzmax = map_.value.size();
    a.p = map_.column_start.data();
    a.i = map_.row.data();
    a.x = map_.value.data();
    a.stype = 1;
    a.itype = CHOLMOD_INT;
    a.xtype = CHOLMOD_REAL;
    a.dtype = CHOLMOD_DOUBLE;
    a.sorted = a.packed = 1;
    return a;
  }

  void note_pivots(FactorReport& report) const {
    const double* values = static_cast<const double*>(factor_->x);
    const int* column_start = static_cast<const int*>(factor_->p);
    report.negative_pivots = 0;
    report.smallest_pivot = std::numeric_limits<double>::infinity();
    for (int j = 0; j < map_.unknowns(); ++j) {
      const double pivot = values[column_start[j]], size = std::abs(pivot);
      if (!usable_pivot(size)) {
        report = singular_report(static_cast<std::size_t>(j));
        return;
      }
      report.negative_pivots += pivot < 0.0;
      report.smallest_pivot = std::min(report.smallest_pivot, size);
      report.largest_pivot = std::max(report.largest_pivot, size);
    }
    // Of a symmetric matrix the first entry to outgrow the others is a pivot: it bounds the growth of all.
    double largest = 0.0;
    for (const double v : map_.value) largest = std::max(largest, std::abs(v));
    if (report.largest_pivot <= growth_limit * largest) return;
    report.status = FactorStatus::not_applicable;
    report.message =
        fmt::format("an indefinite matrix on which LDL^T without exchange of rows is not stable: growth {:.1e}", report.largest_pivot / largest);
  }

  void release() {
    cholmod_free_factor(&factor_, &common_);
    cholmod_free_dense(&solution_, &common_);
    cholmod_free_dense(&work_y_, &common_);
    cholmod_free_dense(&work_e_, &common_);
  }

  cholmod_common common_;
  CscMap map_;
  cholmod_factor* factor_ = nullptr;
  cholmod_dense *solution_ = nullptr, *work_y_ = nullptr, *work_e_ = nullptr;
};

}  // namespace

std::unique_ptr<LinearSolver> make_cholmod_solver() { return std::make_unique<CholmodSolver>(); }

}  // namespace hawser
