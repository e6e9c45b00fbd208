#include "solver/stability.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include "assembly/assembler.hpp"
#include "solver/bordered_solver.hpp"
#include "solver/linear/dense_spectrum.hpp"
#include "solver/norms.hpp"
#include "solver/static_system.hpp"

namespace hawser {
namespace {

constexpr double neutral_share = 1e-6;
constexpr double rounding_share = 1e-14;  // of the stiffness of stretching
constexpr double bracket_width = 1e-3;    // relative
constexpr int most_doublings = 60;        // of the first bracket
constexpr int inverse_iterations = 12;
constexpr int krylov_least = 40, krylov_most = 300;  // vectors
constexpr int krylov_numbers = 6'000'000;            // in all of them, where that leaves more than the least
constexpr double krylov_breakdown = 1e-12;
constexpr double resolved = 1e-12;      // of the largest eigenvalue of (K - sigma M)^-1 M: less is rounding, as of what has no mass
constexpr double ritz_accuracy = 1e-3;  // of an eigenvalue of (K - sigma M)^-1 M

/// The diagonal of M, over the chain unknowns; zero where a support holds.
std::vector<double> mode_mass(const Model& model) {
  std::vector<double> mass(model.dofs, 0.0);
  for (int index = 0; index < static_cast<int>(model.lines.size()); ++index) {
    const Line& line = model.lines[index];
    const Chain& chain = model.chain(index);
    for (int i = 0; i < line.nodes; ++i) {
      const double before = i > 0 ? line.s[i] - line.s[i - 1] : 0.0, after = i + 1 < line.nodes ? line.s[i + 1] - line.s[i] : 0.0;
      const double l = model.node_length[line.first_node + i], carried = 0.5 * (before + after);
      for (int k = 0; k < chain.block; ++k) mass[chain.dof(i) + k] = carried * (k < 3 ? 1.0 : l * l);
    }
  }
  for (const Support& support : model.supports) {
    const auto first = mass.begin() + static_cast<std::ptrdiff_t>(model.dof(support.line, support.node));
    if (support.position) std::fill_n(first, 3, 0.0);
    if (support.clamped && model.chain(support.line).block == 6) std::fill_n(first + 3, 3, 0.0);
  }
  return mass;
}

/// K - sigma M and what is asked of it.
class Pencil {
 public:
  Pencil(const Model& model, const State& state)
      : elastic_(elastic_part(model)), assembler_(elastic_), tangent_(assembler_.make_tangent()), mass_(mode_mass(model)) {
    std::vector<double> r(model.unknowns);
    assembler_.tangent(state, TangentWeights{}, TangentFloor{}, r, tangent_);
    tangent_.symmetrize();
    tangent_.chain.declare(Symmetry::symmetric);
    shifted_ = tangent_;
    chain_mass_ = mass_;
    for (const BorderEnd& end : tangent_.border.ends) std::fill_n(&chain_mass_[end.r], 3, 0.0);
  }

  /// How many eigenvalues are less; those of inner unknowns, which have no mass, are 0 or infinite and counted by themselves.
  int below(double sigma) {
    shift(sigma);
    return inertia_of_symmetric_part(shifted_.chain).negative + negative_hub_pivots(shifted_);
  }
  int without_mass() const { return tangent_.negative_inner_pivots(); }

  /// Inverse iteration with K - sigma M; returns the Rayleigh quotient and the mode over all unknowns. Nothing where it cannot be factorized.
  std::optional<double> iterate(double sigma, std::vector<double>& mode) {
    shift(sigma);
    const auto chains = make_linear_solver(LinearSolverKind::automatic);
    BorderedSolver linear(*chains);
    linear.analyze(shifted_);
    if (linear.factorize(shifted_).status != FactorStatus::ok) return std::nullopt;
    std::vector<double> x(mass_.size()), kx(mass_.size());
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = mass_[i] * (1.0 + 0.5 * std::sin(1.7 * static_cast<double>(i)));  // no symmetry of its own
    double quotient = 0.0;
    for (int k = 0; k < inverse_iterations; ++k) {
      linear.solve(x);
      multiply(tangent_, x, kx);
      double energy = 0.0, size = 0.0;
      for (std::size_t i = 0; i < x.size(); ++i) {
        if (mass_[i] > 0.0) energy += x[i] * kx[i];
        size += mass_[i] * x[i] * x[i];
      }
      quotient = energy / size;
      if (k + 1 == inverse_iterations) break;
      for (std::size_t i = 0; i < x.size(); ++i) x[i] *= mass_[i] / std::sqrt(size);
    }
    mode.assign(elastic_.unknowns, 0.0);
    assembler_.expand(with_no_residual(), x, mode);
    return quotient;
  }

 private:
  void shift(double sigma) {
    shifted_ = tangent_;
    for (const Chain& chain : shifted_.chain.chains())
      for (int i = 0; i < chain.nodes; ++i)
        for (int k = 0; k < chain.block; ++k)
          shifted_.chain.D(chain, i)[k * (chain.block + 1)] -= sigma * chain_mass_[chain.dof(i) + static_cast<std::size_t>(k)];
    for (BorderEnd& end : shifted_.border.ends)
      for (int k = 0; k < 3; ++k) {
        const auto own = static_cast<Eigen::Index>(end.r - end.window) + k;
        end.column(own, k) = end.row(k, own) = end.column(own, k) - sigma * mass_[end.r + static_cast<std::size_t>(k)];
      }
  }

  const Tangent& with_no_residual() {
    const std::vector<double> none(elastic_.unknowns, 0.0);
    std::vector<double> rhs(elastic_.dofs);
    assembler_.reduce(tangent_, none, rhs);
    return tangent_;
  }

  Model elastic_;
  Assembler assembler_;
  Tangent tangent_;
  Tangent shifted_;
  std::vector<double> mass_, chain_mass_;  // of the chains with the ends at hubs held
};

/// Eigenvalues of K x = kappa M x with all loads, from a Krylov space of A = (K - sigma M)^-1 M; M that of a unit mass. Vectors are scaled by the
/// root of the lumped masses.
class Krylov {
 public:
  Krylov(const Assembler& assembler, const State& state, double sigma)
      : sigma_(sigma), mass_(assembler.make_tangent()), chains_(make_linear_solver(LinearSolverKind::automatic)), linear_(*chains_) {
    const Model& model = assembler.model();
    const std::vector<double> lumped = mode_mass(model);
    root_ = Eigen::Map<const Eigen::VectorXd>(lumped.data(), static_cast<Eigen::Index>(lumped.size())).cwiseSqrt();
    Tangent shifted = assembler.make_tangent();
    std::vector<double> r(model.unknowns);
    assembler.tangent(state, {0.0, 0.0, 1.0}, TangentFloor{}, r, mass_);
    assembler.tangent(state, {1.0, 0.0, -sigma}, TangentFloor{}, r, shifted);
    linear_.analyze(shifted);
    if (linear_.factorize(shifted).status == FactorStatus::ok) span_space();
  }

  /// Those that are accurate; none where K - sigma M cannot be factorized.
  std::vector<std::complex<double>> values() const {
    std::vector<std::complex<double>> values;
    if (size_ == 0) return values;
    const Eigenpairs pairs = eigenpairs(H_.topLeftCorner(size_, size_));
    const double largest = pairs.values.cwiseAbs().maxCoeff();
    for (Eigen::Index i = 0; i < size_; ++i) {
      const std::complex<double> theta = pairs.values[i];
      const double error = H_(size_, size_ - 1) * std::abs(pairs.vectors(size_ - 1, i));
      if (std::abs(theta) > resolved * largest && error <= ritz_accuracy * std::abs(theta)) values.push_back(sigma_ + 1.0 / theta);
    }
    return values;
  }

 private:
  Eigen::VectorXd times(const Eigen::VectorXd& x) {
    const Eigen::VectorXd plain = (root_.array() > 0.0).select(x.cwiseQuotient(root_.cwiseMax(1e-300)), 0.0);
    Eigen::VectorXd y(x.size());
    const auto n = static_cast<std::size_t>(x.size());
    multiply(mass_, {plain.data(), n}, {y.data(), n});
    linear_.solve({y.data(), n});
    return root_.cwiseProduct(y);
  }

  /// Arnoldi, orthogonalised twice.
  void span_space() {
    const Eigen::Index n = root_.size(), most = std::min(std::clamp<Eigen::Index>(krylov_numbers / n, krylov_least, krylov_most), n - 1);
    Eigen::MatrixXd V(n, most + 1);
    H_ = Eigen::MatrixXd::Zero(most + 1, most);
    V.col(0) = root_.cwiseProduct(Eigen::VectorXd::NullaryExpr(n, [](Eigen::Index i) { return 1.0 + 0.5 * std::sin(1.7 * static_cast<double>(i)); }));
    V.col(0).normalize();
    while (size_ < most) {
      Eigen::VectorXd x = times(V.col(size_));
      const double whole = x.norm();
      for (int twice = 0; twice < 2; ++twice) {
        const Eigen::VectorXd h = V.leftCols(size_ + 1).transpose() * x;
        x -= V.leftCols(size_ + 1) * h;
        H_.col(size_).head(size_ + 1) += h;
      }
      ++size_;
      H_(size_, size_ - 1) = x.norm();
      if (H_(size_, size_ - 1) <= krylov_breakdown * whole) return;
      V.col(size_) = x.normalized();
    }
  }

  double sigma_;
  Tangent mass_;
  std::unique_ptr<LinearSolver> chains_;
  BorderedSolver linear_;
  Eigen::VectorXd root_;
  Eigen::MatrixXd H_;
  Eigen::Index size_ = 0;
};

/// Scales the mode to 1 m at its largest displacement and says where that is.
void normalise(const Model& model, StabilityMode& mode) {
  double largest = 0.0;
  for (int index = 0; index < static_cast<int>(model.lines.size()); ++index) {
    for (int i = 0; i < model.lines[index].nodes; ++i) {
      const Eigen::Map<const Vec3> r(&mode.shape[model.dof(index, i)]);
      if (r.norm() <= largest) continue;
      largest = r.norm();
      mode.line = index;
      mode.s = model.lines[index].s[i];
      mode.direction = r / largest;
    }
  }
  if (largest == 0.0) return;
  double sign = 1.0;
  for (int axis = 2; axis >= 0; --axis)
    if (std::abs(mode.direction[axis]) > 0.5 * mode.direction.cwiseAbs().maxCoeff()) sign = std::copysign(1.0, mode.direction[axis]);
  mode.direction *= sign;
  for (double& x : mode.shape) x *= sign / largest;
}

}  // namespace

bool flows(const Model& model) {
  const bool drags = model.wet || std::any_of(model.bodies.begin(), model.bodies.end(), [](const Body& body) { return body.drag > 0.0; });
  return drags && (model.current.fastest() > 0.0 || model.tow != Vec3::Zero());
}

bool has_potential(const Model& model) { return !flows(model) && !model.rubs() && !(model.seabed && !model.seabed->surface.level()); }

double neutral_stiffness(const Model& model, double reference_force) { return neutral_share * reference_force / std::pow(longest_line(model), 2); }

double rounding_stiffness(const Model& model) {
  double stretching = 0.0;
  for (int e = 0; e < model.total_elements(); ++e) stretching = std::max(stretching, model.element.EA[e] / std::pow(model.element.length[e], 2));
  return rounding_share * stretching;
}

std::optional<StabilityMode> softest_mode(const Model& model, const State& state, double reference_force) {
  const double neutral = neutral_stiffness(model, reference_force);
  if (!(neutral > 0.0)) return std::nullopt;
  Pencil pencil(model, state);
  if (pencil.below(neutral) == 0) return std::nullopt;
  double low = -neutral, high = neutral;
  for (int i = 0; i < most_doublings && pencil.below(low) > 0; ++i) {
    high = low;
    low *= 4.0;
  }
  while (high - low > bracket_width * std::max(neutral, std::abs(low))) {
    const double middle = 0.5 * (low + high);
    (pencil.below(middle) > 0 ? high : low) = middle;
  }
  StabilityMode mode;
  const std::optional<double> stiffness = pencil.iterate(low, mode.shape);
  if (!stiffness) return std::nullopt;
  mode.stiffness = *stiffness;
  mode.negative_pivots = pencil.below(-neutral) + pencil.without_mass();
  normalise(model, mode);
  return mode;
}

int modes_below(const Model& model, const State& state, double stiffness) {
  Pencil pencil(model, state);
  return pencil.below(stiffness) + pencil.without_mass();
}

std::optional<double> slowest_decay(const Model& model, const State& state, double softest) {
  const Model massive = with_unit_mass(model);
  const Assembler assembler(massive);
  std::optional<double> slowest;
  for (const double sigma : {0.0, -std::abs(softest)}) {
    const Krylov krylov(assembler, state, sigma);
    for (const std::complex<double>& value : krylov.values()) slowest = std::min(slowest.value_or(HUGE_VAL), value.real());
    if (!slowest) return std::nullopt;
    if (*slowest < 0.0) break;
  }
  return slowest;
}

std::optional<double> decay_with_all_loads(const Model& model, const State& state, double reference_force) {
  const double neutral = neutral_stiffness(model, reference_force);
  const std::optional<StabilityMode> mode = softest_mode(model, state, reference_force);
  const std::optional<double> slowest = slowest_decay(model, state, mode ? mode->stiffness : neutral);
  return slowest && *slowest > std::min(neutral, rounding_stiffness(model)) ? slowest : std::nullopt;
}

}  // namespace hawser
