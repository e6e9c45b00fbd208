#include "solver/bordered_solver.hpp"

#include <fmt/format.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/linear/dense_spectrum.hpp"

namespace hawser {
namespace {

constexpr double weakest_hold = 10.0 * std::numeric_limits<double>::epsilon();  // of the forces that balance in a row of S: below, no digit is left
constexpr int probing_steps = 3;
constexpr int dense_below = 200;  // rows of S: eigenvalues one by one

}  // namespace

void BorderedSolver::analyze(const Tangent& pattern) {
  chains_.analyze(pattern.chain);
  border_ = pattern.border;
  places_.assign(border_.ends.size(), {});
  int slots = 0;
  std::vector<int> end_of(pattern.chain.chains().size(), -1);  // the first one seen of every chain
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const Chain& chain = pattern.chain.chains()[border_.ends[i].line];
    places_[i].first = chain.first_dof;
    places_[i].count = chain.dofs();
    int& first = end_of[border_.ends[i].line];
    if (first >= 0) {
      places_[i].slot = 1;
      places_[i].partner = first;
      places_[first].partner = static_cast<int>(i);
    }
    first = static_cast<int>(i);
    slots = std::max(slots, places_[i].slot + 1);
  }
  responses_.assign(3 * static_cast<std::size_t>(slots), std::vector<double>(pattern.chain.dofs()));
  stiffness_.resize(3 * border_.hubs, 3 * border_.hubs);
  motion_.resize(3 * border_.hubs);
}

FactorReport BorderedSolver::factorize(const Tangent& tangent) {
  FactorReport report = chains_.factorize(tangent.chain);
  if (report.status != FactorStatus::ok || tangent.border.empty()) return report;
  border_ = tangent.border;
  respond();
  condense();
  return factorize_hubs(std::move(report));
}

FactorReport BorderedSolver::factorize_and_solve(TangentPanels& panels, const Tangent& tangent, std::span<double> b) {
  if (tangent.border.empty()) return chains_.factorize_and_solve(panels, b);
  panels.whole();
  const FactorReport report = factorize(tangent);
  if (report.status == FactorStatus::ok) solve(b);
  return report;
}

FactorReport BorderedSolver::solve_once(TangentPanels& panels, const Tangent& tangent, std::span<double> b) {
  return tangent.border.empty() ? chains_.solve_once(panels, b) : factorize_and_solve(panels, tangent, b);
}

/// Zeroes the r of hub ends.
void BorderedSolver::hold(std::span<double> b) const {
  for (const BorderEnd& end : border_.ends) std::fill_n(&b[end.r], 3, 0.0);
}

void BorderedSolver::respond() {
  for (std::size_t k = 0; k < responses_.size(); ++k) {
    const int slot = static_cast<int>(k) / 3, axis = static_cast<int>(k) % 3;
    std::vector<double>& x = responses_[k];
    std::fill(x.begin(), x.end(), 0.0);
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const BorderEnd& end = border_.ends[i];
      if (places_[i].slot == slot) Eigen::Map<Eigen::VectorXd>(&x[end.window], end.column.rows()) = -end.column.col(axis);
    }
    hold(x);
    chains_.solve(x);
    for (std::size_t i = 0; i < places_.size(); ++i)
      if (places_[i].slot == slot) x[border_.ends[i].r + axis] = 1.0;
  }
}

void BorderedSolver::condense() {
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](std::size_t i, std::size_t j) {
    const BorderEnd &force = border_.ends[i], &moved = border_.ends[j];
    for (int axis = 0; axis < 3; ++axis) {
      const std::vector<double>& x = responses_[3 * places_[j].slot + axis];
      const Vec3 f = force.row * Eigen::Map<const Eigen::VectorXd>(&x[force.window], force.row.cols());
      for (int k = 0; k < 3; ++k) entries.emplace_back(3 * force.hub + k, 3 * moved.hub + axis, f[k]);
    }
  };
  for (std::size_t i = 0; i < places_.size(); ++i) {
    add(i, i);
    if (places_[i].partner >= 0) add(i, static_cast<std::size_t>(places_[i].partner));
  }
  stiffness_.setFromTriplets(entries.begin(), entries.end());
}

/// Factors of S. A few inverse iterations find the motion that is held most weakly, and how weakly: |S x| against |S| |x|, row by row.
FactorReport BorderedSolver::factorize_hubs(FactorReport report) {
  report.negative_pivots = -1;
  hubs_.compute(stiffness_);
  const bool regular = hubs_.info() == Eigen::Success;
  Eigen::VectorXd motion = Eigen::VectorXd::LinSpaced(stiffness_.cols(), 1.0, 2.0);
  double hold = regular ? 1.0 : 0.0;
  for (int step = 0; step < probing_steps && hold > weakest_hold; ++step) {
    const Eigen::VectorXd force = motion / motion.cwiseAbs().maxCoeff();
    motion = hubs_.solve(force);
    const Eigen::VectorXd balanced = stiffness_.cwiseAbs() * motion.cwiseAbs();
    hold = motion.allFinite() ? (force.array().abs() / balanced.array().max(std::numeric_limits<double>::min())).maxCoeff() : 0.0;
  }
  if (hold > weakest_hold) return report;
  Eigen::Index row = 0;
  if (regular && motion.allFinite())
    motion.cwiseAbs().maxCoeff(&row);
  else
    stiffness_.diagonal().cwiseAbs().minCoeff(&row);
  const auto end = std::find_if(border_.ends.begin(), border_.ends.end(), [&](const BorderEnd& e) { return e.hub == row / 3; });
  report.status = FactorStatus::singular;
  report.failed_unknown = end->r;
  report.message = fmt::format("nothing holds a point where lines meet along {}", "xyz"[row % 3]);
  return report;
}

void BorderedSolver::solve(std::span<double> b) {
  if (border_.empty()) return chains_.solve(b);
  motion_.setZero();
  for (const BorderEnd& end : border_.ends) motion_.segment<3>(3 * end.hub) += Eigen::Map<const Vec3>(&b[end.r]);
  hold(b);
  chains_.solve(b);
  for (const BorderEnd& end : border_.ends)
    motion_.segment<3>(3 * end.hub) -= end.row * Eigen::Map<const Eigen::VectorXd>(&b[end.window], end.row.cols());
  motion_ = hubs_.solve(motion_).eval();
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const Place& place = places_[i];
    Eigen::Map<Eigen::VectorXd> chain(&b[place.first], static_cast<Eigen::Index>(place.count));
    for (int axis = 0; axis < 3; ++axis) {
      const std::vector<double>& x = responses_[3 * place.slot + axis];
      chain += motion_[3 * border_.ends[i].hub + axis] * Eigen::Map<const Eigen::VectorXd>(&x[place.first], chain.size());
    }
  }
}

void multiply(const Tangent& tangent, std::span<const double> x, std::span<double> y) {
  const std::vector<BorderEnd>& ends = tangent.border.ends;
  std::vector<double> held(x.begin(), x.end());
  for (const BorderEnd& end : ends) std::fill_n(&held[end.r], 3, 0.0);
  tangent.chain.multiply(held, y);
  for (const BorderEnd& end : ends) {
    Eigen::Map<Eigen::VectorXd> window(&y[end.window], end.column.rows());
    window += end.column * Eigen::Map<const Vec3>(&x[end.r]);
  }
  std::vector<std::size_t> first(static_cast<std::size_t>(tangent.border.hubs), y.size());
  for (const BorderEnd& end : ends) {
    Eigen::Map<Vec3> here(&y[end.r]);
    const Vec3 force = here + end.row * Eigen::Map<const Eigen::VectorXd>(&held[end.window], end.row.cols());
    here.setZero();
    std::size_t& at = first[static_cast<std::size_t>(end.hub)];
    at = std::min(at, end.r);
    Eigen::Map<Vec3> sum(&y[at]);
    sum += force;
  }
}

int negative_hub_pivots(const Tangent& tangent) {
  if (tangent.border.empty()) return 0;
  Tangent symmetric = tangent;
  symmetric.symmetrize();
  const auto chains = make_linear_solver(LinearSolverKind::automatic);
  BorderedSolver solver(*chains);
  solver.analyze(symmetric);
  solver.factorize(symmetric);
  const Eigen::SparseMatrix<double>& S = solver.hub_stiffness();
  if (S.nonZeros() == 0) return 1;  // the chains have no inverse: nothing shows that it is stable
  if (S.rows() < dense_below) {
    const Eigen::MatrixXd dense(S);
    return negative_eigenvalues(0.5 * (dense + dense.transpose()));
  }
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(S);
  return factors.info() == Eigen::Success ? static_cast<int>((factors.vectorD().array() < 0.0).count()) : 1;
}

}  // namespace hawser
