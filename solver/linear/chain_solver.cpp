// The chain solver: linear time and memory, no exchange of rows (chain_kernel.hpp), watched.
//
// Elimination without exchanges has backward error |dA| <= c eps |L||U|. Its kernel measures the growth g of the worked entries node by node;
// when eps g would pass 1e-14 relative to the entries given, or a pivot is zero or not finite, the matrix is factorized again by the band
// solver, which exchanges rows. A well-posed statics or dynamics tangent never gets there.
#include <omp.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <memory>

#include "solver/linear/backends.hpp"
#include "solver/linear/band_solver.hpp"
#include "solver/linear/chain_kernel.hpp"
#include "solver/linear/chain_panels.hpp"
#include "solver/linear/factor_reports.hpp"
#include "solver/linear/untouched.hpp"

namespace hawser {

namespace {

constexpr double growth_limit = 100.0;  // 1e-14 / eps

// Measured (bench/README.md, threads): two threads gain 1.5 in factorizing 10^4 nodes, but nothing in a solve of as many, which takes 0.2 ms.
constexpr int nodes_to_share_factorization = 4000, nodes_to_share_panels = 2000, nodes_to_share_solve = 40000;

class ChainSolver final : public LinearSolver {
 public:
  explicit ChainSolver(int threads) : threads_(threads) {}

  std::string_view name() const override { return "chain"; }
  bool takes_unsymmetric() const override { return true; }

  void analyze(const BlockTridiagonal& pattern) override {
    chains_.assign(pattern.chains().begin(), pattern.chains().end());
    for ([[maybe_unused]] const Chain& c : chains_) assert(c.block == 3 || c.block == 6 || c.block == 7);
    factors_ = UntouchedVector<double>(pattern.values().size());
    for (const Chain& c : chains_) touch_first(c);
    pivoted_.reset();
    fell_back_ = false;
  }

  FactorReport factorize(const BlockTridiagonal& matrix) override {
    assert(matrix.chains().size() == chains_.size());
    PivotWatch watch;
    symmetry_ = matrix.symmetry(), unsymmetric_form_ = Factors::lu;
    for (const Chain& c : chains_) factorize(c, matrix.values().data() + c.first_value, watch);
    fell_back_ = !accurate(watch);
    return fell_back_ ? factorize_pivoted(matrix) : report_of(watch);
  }

  FactorReport factorize_and_solve(MatrixPanels& panels, std::span<double> b) override { return eliminate(panels, b, Factors::lu); }
  FactorReport solve_once(MatrixPanels& panels, std::span<double> b) override { return eliminate(panels, b, Factors::spent_lu); }

  void solve(std::span<double> b) override {
    if (fell_back_) return pivoted_->solve(b);
    for (const Chain& c : chains_) solve(c, b.data() + c.first_dof);
  }

  std::size_t bytes() const override { return sizeof(double) * factors_.size() + (pivoted_ ? pivoted_->bytes() : 0); }

 private:
  FactorReport eliminate(MatrixPanels& panels, std::span<double> b, Factors unsymmetric_form) {
    PivotWatch watch;
    symmetry_ = panels.symmetry(), unsymmetric_form_ = unsymmetric_form;
    for (std::size_t i = 0; i < chains_.size(); ++i) {
      const Chain& c = chains_[i];
      panels_.start(kernel_, panels, static_cast<int>(i), c, form(c), factors_of(c), b.data() + c.first_dof);
      eliminate(c, b.data() + c.first_dof, watch);
    }
    fell_back_ = !accurate(watch);
    if (!fell_back_) return report_of(watch);
    const FactorReport report = factorize_pivoted(panels.whole());
    if (report.status == FactorStatus::ok) pivoted_->solve(b);
    return report;
  }

  /// With 3 unknowns a node L Delta L^T gains nothing where the factors stay in the cache (README.md).
  Factors form(const Chain& c) const { return symmetry_ == Symmetry::symmetric && c.block > 3 ? Factors::ldlt : unsymmetric_form_; }

  static bool accurate(const PivotWatch& watch) {
    const bool pivots_usable = watch.not_finite == 0.0 && usable_pivot(watch.smallest) && usable_pivot(watch.largest);
    return pivots_usable && watch.growth_squared <= growth_limit * growth_limit;
  }

  static FactorReport report_of(const PivotWatch& watch) {
    FactorReport report;
    report.negative_pivots = watch.negative;
    report.smallest_pivot = watch.smallest;
    report.largest_pivot = watch.largest;
    return report;
  }

  void factorize(const Chain& c, const double* values, PivotWatch& watch) {
    const double* middle = values + std::size_t{3} * c.block * c.block * (c.nodes / 2);
    on_fronts(
        c, nodes_to_share_factorization, watch,
        [&](Front front, PivotWatch& w) { kernel_.factorize(c.block, c.nodes, form(c), values, factors_of(c), front, w); },
        [&](PivotWatch& w) { kernel_.factorize_middle(c.block, c.nodes, form(c), middle, factors_of(c), w); }, nothing);
  }

  void eliminate(const Chain& c, double* b, PivotWatch& watch) {
    on_fronts(
        c, nodes_to_share_panels, watch, [&](Front front, PivotWatch& w) { panels_.eliminate(front, w); },
        [&](PivotWatch& w) { panels_.eliminate_middle(w); },
        [&](Front front) { kernel_.backward(c.block, c.nodes, form(c), factors_of(c), b, front); });
  }

  void solve(const Chain& c, double* b) {
    assert(form(c) != Factors::spent_lu);
    PivotWatch unread;
    on_fronts(
        c, nodes_to_share_solve, unread, [&](Front front, PivotWatch&) { kernel_.forward(c.block, c.nodes, form(c), factors_of(c), b, front); },
        [&](PivotWatch&) { kernel_.solve_middle(c.block, c.nodes, form(c), factors_of(c), b); },
        [&](Front front) { kernel_.backward(c.block, c.nodes, form(c), factors_of(c), b, front); });
  }

  /// Each thread the factors of its front.
  void touch_first(const Chain& c) {
    double* const first = factors_of(c);
    double* const end = first + c.block * c.block * (3 * std::ptrdiff_t{c.nodes} - 2);
    double* const middle = first + (end - first) / 2;
    PivotWatch unread;
    on_fronts(
        c, nodes_to_share_panels, unread,
        [&](Front front, PivotWatch&) { std::fill(front == Front::right ? middle : first, front == Front::left ? middle : end, 0.0); },
        [](PivotWatch&) {}, nothing);
  }

  static constexpr auto nothing = [](Front) {};

  /// Towards the middle node, there, and back. Of two threads each keeps to its front, whose numbers stay in its cache; the numbers are those of
  /// one thread.
  template <class Inwards, class Middle, class Outwards>
  void on_fronts(const Chain& c, int nodes_to_share, PivotWatch& watch, Inwards inwards, Middle at_middle, Outwards outwards) {
    if (threads_ == 1 || c.nodes < nodes_to_share) {
      inwards(Front::both, watch), at_middle(watch), outwards(Front::both);
      return;
    }
    PivotWatch watch_right;
#pragma omp parallel num_threads(2)
    {
      const bool alone = omp_get_num_threads() == 1, right = omp_get_thread_num() == 1;
      const Front front = alone ? Front::both : right ? Front::right : Front::left;
      inwards(front, right ? watch_right : watch);
#pragma omp barrier
      if (!right) at_middle(watch);
#pragma omp barrier
      outwards(front);
    }
    watch.add(watch_right);
  }

  double* factors_of(const Chain& c) { return factors_.data() + c.first_value; }

  // The fallback's memory is twice the factors': it is taken when first needed.
  FactorReport factorize_pivoted(const BlockTridiagonal& matrix) {
    if (!pivoted_) {
      pivoted_ = std::make_unique<BandSolver>();
      pivoted_->analyze(matrix);
    }
    FactorReport report = pivoted_->factorize(matrix);
    report.fell_back = true;
    return report;
  }

  const int threads_;
  const ChainKernel& kernel_ = *chain_kernels().front();
  std::vector<Chain> chains_;
  UntouchedVector<double> factors_;
  std::unique_ptr<BandSolver> pivoted_;
  ChainPanels panels_;
  Symmetry symmetry_ = Symmetry::unknown;
  Factors unsymmetric_form_ = Factors::lu;
  bool fell_back_ = false;
};

}  // namespace

std::unique_ptr<LinearSolver> make_chain_solver(int threads) { return std::make_unique<ChainSolver>(threads); }

}  // namespace hawser
