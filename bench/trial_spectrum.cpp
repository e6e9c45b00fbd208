// The whole spectrum of an equilibrium with all its loads, for the trial of statics.
//
//   K x = kappa M x,    stable where every kappa has a positive real part:  M x' = -K x decays
//
// K and M are dense, by central differences of the residual; M is a unit mass per metre of line. Nothing of solver/stability.cpp is used.
#include "bench/trial.hpp"

#include <Eigen/LU>
#include <complex>
#include <vector>

#include "assembly/assembler.hpp"
#include "solver/linear/dense_spectrum.hpp"
#include "solver/static_system.hpp"

namespace hawser::bench {
namespace {

/// Unknowns that may move, those of the ends at one hub together.
std::vector<std::vector<std::size_t>> motions(const Model& model) {
  std::vector<std::vector<std::size_t>> motions;
  std::vector<char> held(model.unknowns, 0);
  for (const Support& support : model.supports) {
    const std::size_t first = model.dof(support.line, support.node);
    for (std::size_t k = 0; k < 3; ++k) {
      if (support.position) held[first + k] = 1;
      if (support.clamped && model.chain(support.line).block == 6) held[first + 3 + k] = 1;
    }
  }
  for (const Hub& hub : model.hubs)
    for (std::size_t k = 0; k < 3; ++k) {
      motions.emplace_back();
      for (const Support& end : hub.ends) {
        motions.back().push_back(model.dof(end.line, end.node) + k);
        held[motions.back().back()] = 1;
      }
    }
  for (std::size_t i = 0; i < model.unknowns; ++i)
    if (!held[i]) motions.push_back({i});
  return motions;
}

}  // namespace

/// Directions of r' at clamps count as held: their stretch is stiff.
double least_decay(const Model& model, const State& state) {
  constexpr double resolved = 1e-9;  // of the longest decay time: stretching is below it, and what rounding leaves of it has any sign
  constexpr double nudge = 1e-7;     // m: far below a slip, far above the rounding of coordinates
  const Model massive = with_unit_mass(model);
  const Assembler assembler(massive);
  const std::vector<std::vector<std::size_t>> free = motions(model);
  const auto n = static_cast<Eigen::Index>(free.size());
  Eigen::MatrixXd K(n, n), M(n, n);
  std::vector<double> ahead(model.unknowns), behind(model.unknowns);
  const auto differentiate = [&](std::vector<double> State::*vector, double step, Eigen::MatrixXd& by) {
    State moved = state;
    moved.a.assign(model.unknowns, 0.0);
    for (Eigen::Index j = 0; j < n; ++j) {
      for (const std::size_t i : free[j]) (moved.*vector)[i] += step;
      assembler.residual(moved, ahead);
      assembler.project(ahead);
      for (const std::size_t i : free[j]) (moved.*vector)[i] -= 2.0 * step;
      assembler.residual(moved, behind);
      assembler.project(behind);
      for (const std::size_t i : free[j]) (moved.*vector)[i] += step;
      for (Eigen::Index i = 0; i < n; ++i) by(i, j) = (ahead[free[i][0]] - behind[free[i][0]]) / (2.0 * step);
    }
  };
  differentiate(&State::q, nudge, K);
  differentiate(&State::a, 1.0, M);
  const Eigen::VectorXcd decay_times = eigenvalues(K.partialPivLu().solve(M));  // 1/kappa: the small kappa, which count, are the accurate ones
  const double longest = decay_times.cwiseAbs().maxCoeff();
  double least = HUGE_VAL;
  for (const std::complex<double>& time : decay_times)
    if (std::abs(time) > resolved * longest) least = std::min(least, (1.0 / time).real());
  return least;
}

}  // namespace hawser::bench
