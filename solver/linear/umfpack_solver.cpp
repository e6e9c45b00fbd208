// UMFPACK: unsymmetric multifrontal LU with threshold pivoting. The numeric factorization is UMFPACK's own allocation, made anew each time.
#include <array>
#include <cassert>
#include <cmath>

#include <umfpack.h>

#include "solver/linear/backends.hpp"
#include "solver/linear/csc_map.hpp"
#include "solver/linear/factor_reports.hpp"

namespace hawser {

namespace {

class UmfpackSolver final : public LinearSolver {
 public:
  UmfpackSolver() {
    umfpack_di_defaults(control_.data());
    control_[UMFPACK_IRSTEP] = 0;  // refinement would need the matrix of the factors, and its digits are not wanted of a direction
  }
  UmfpackSolver(const UmfpackSolver&) = delete;
  UmfpackSolver& operator=(const UmfpackSolver&) = delete;
  ~UmfpackSolver() override { release(); }

  std::string_view name() const override { return "umfpack"; }
  bool takes_unsymmetric() const override { return true; }

  void analyze(const BlockTridiagonal& pattern) override {
    release();
    map_ = CscMap(pattern, CscMap::Part::whole);
    const int n = map_.unknowns();
    [[maybe_unused]] const int status =
        umfpack_di_symbolic(n, n, map_.column_start.data(), map_.row.data(), nullptr, &symbolic_, control_.data(), info_.data());
    assert(status == UMFPACK_OK);
    integer_work_.resize(n);
    work_.resize(n);
    solution_.resize(n);
  }

  FactorReport factorize(const BlockTridiagonal& matrix) override {
    if (const auto unknown = first_not_finite(matrix)) return not_finite_report(*unknown);
    map_.copy_values(matrix);
    umfpack_di_free_numeric(&numeric_);
    umfpack_di_numeric(map_.column_start.data(), map_.row.data(), map_.value.data(), symbolic_, &numeric_, control_.data(), info_.data());
    if (info_[UMFPACK_STATUS] != UMFPACK_OK || !usable_pivot(info_[UMFPACK_UMIN]) || !usable_pivot(info_[UMFPACK_UMAX]))
      return singular_report(unusable_unknown());
    FactorReport report;
    report.smallest_pivot = info_[UMFPACK_UMIN];
    report.largest_pivot = info_[UMFPACK_UMAX];
    return report;
  }

  void solve(std::span<double> b) override {
    umfpack_di_wsolve(UMFPACK_A, map_.column_start.data(), map_.row.data(), map_.value.data(), solution_.data(), b.data(), numeric_, control_.data(),
                      info_.data(), integer_work_.data(), work_.data());
    std::copy(solution_.begin(), solution_.end(), b.begin());
  }

  std::size_t bytes() const override {
    const double units = info_[UMFPACK_SYMBOLIC_SIZE] + info_[UMFPACK_NUMERIC_SIZE];
    return map_.bytes() + static_cast<std::size_t>(units * info_[UMFPACK_SIZE_OF_UNIT]) + sizeof(int) * integer_work_.size() +
           sizeof(double) * (work_.size() + solution_.size());
  }

 private:
  // Which column of the matrix the worst pivot stands in; asked for after a failure only.
  std::size_t unusable_unknown() {
    if (!numeric_) return 0;
    std::vector<int> column(map_.unknowns());
    std::vector<double> pivot(map_.unknowns());
    int reciprocal_scale = 0;
    umfpack_di_get_numeric(nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, column.data(), pivot.data(), &reciprocal_scale, nullptr,
                           numeric_);
    for (std::size_t k = 0; k < pivot.size(); ++k)
      if (!usable_pivot(std::abs(pivot[k]))) return static_cast<std::size_t>(column[k]);
    return 0;
  }

  void release() {
    umfpack_di_free_numeric(&numeric_);
    umfpack_di_free_symbolic(&symbolic_);
  }

  std::array<double, UMFPACK_CONTROL> control_{};
  std::array<double, UMFPACK_INFO> info_{};
  CscMap map_;
  void *symbolic_ = nullptr, *numeric_ = nullptr;
  std::vector<int> integer_work_;
  std::vector<double> work_, solution_;
};

}  // namespace

std::unique_ptr<LinearSolver> make_umfpack_solver() { return std::make_unique<UmfpackSolver>(); }

}  // namespace hawser
