#include "solver/time/generalized_alpha.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace hawser {
namespace {

// Newton converges quadratically: the residual that passes this test is usually far below it.
constexpr double automatic_tolerance = 1.0e-8;

constexpr double largest_turn_of_iteration = 0.5;  // theory 6.3

// A slack line has many solutions at the end of a long step, most of them with elements flipped over. Newton may find any
// of them; one that turns further than this in one step is not believed.
constexpr double largest_turn_of_step = 0.5;

// The floor of theory 6.1 is an estimate: a residual this close above it that no longer falls is at the floor.
constexpr double floor_margin = 10.0;

}  // namespace

AlphaCoefficients::AlphaCoefficients(double spectral_radius)
    : alpha_m((2.0 * spectral_radius - 1.0) / (spectral_radius + 1.0)),
      alpha_f(spectral_radius / (spectral_radius + 1.0)),
      gamma(0.5 + alpha_f - alpha_m),
      beta(0.25 * (1.0 + alpha_f - alpha_m) * (1.0 + alpha_f - alpha_m)) {
  assert(spectral_radius >= 0.0 && spectral_radius <= 1.0);
}

double AlphaCoefficients::error_constant() const {
  const double shift = alpha_m - alpha_f;
  return (1.0 + 3.0 * shift * shift) / 12.0;
}

GeneralizedAlpha::GeneralizedAlpha(const System& system, LinearSolver& solver, const StepOptions& options)
    : system_(system),
      solver_(solver),
      options_(options),
      alpha_(options.spectral_radius),
      tolerance_(options.tolerance > 0.0 ? options.tolerance : automatic_tolerance),
      tangent_(system.make_tangent()),
      auxiliary_(system.unknowns()),
      rebased_(system.unknowns()),
      residual_(system.unknowns()),
      increment_(system.unknowns()),
      condensed_(system.dofs()),
      predicted_(system.prescribed().size()) {
  trial_.q.resize(system.unknowns());
  trial_.v.resize(system.unknowns());
  trial_.a.resize(system.unknowns());
  solver_.analyze(tangent_.chain);
}

StepReport GeneralizedAlpha::start(State& state) {
  StepReport report;
  trial_ = state;
  std::fill(trial_.a.begin(), trial_.a.end(), 0.0);
  system_.prescribe(trial_);
  // The residual is linear in qdd: the second solve only removes the rounding of the first.
  for (int pass = 0; pass < 2; ++pass) {
    report.status = linearize({0.0, 0.0, 1.0}, {}, report);
    if (report.status != StepStatus::ok) {
      return report;
    }
    solve();
    ++report.iterations;
    for (std::size_t i = 0; i < increment_.size(); ++i) {
      trial_.a[i] += increment_[i];
    }
  }
  state = trial_;
  auxiliary_ = state.a;
  rebased_ = state.a;
  last_step_ = 0.0;
  return report;
}

StepReport GeneralizedAlpha::step(State& state, double t, double h, const TangentFloor& floor) {
  assert(h > 0.0);
  const TangentWeights weights{1.0, alpha_.gamma / (alpha_.beta * h), (1.0 - alpha_.alpha_m) / ((1.0 - alpha_.alpha_f) * alpha_.beta * h * h)};
  predict(state, t, h);
  follow_prescribed(weights);
  StepReport report;
  report.status = iterate(weights, floor, system_.roundoff_floor(state), report);
  if (report.status == StepStatus::ok && turned_too_far(state)) {
    report.status = StepStatus::not_converged;
  }
  if (report.status == StepStatus::ok) {
    report.easy = report.iterations <= allowed_iterations(report) / 2;
    accept(state, h);
  }
  return report;
}

/// Newton from the predicted state. The same factors once more contract the residual about as much as the last iteration
/// did: where that is enough they are kept.
StepStatus GeneralizedAlpha::iterate(const TangentWeights& weights, const TangentFloor& floor, double floor_force, StepReport& report) {
  const double wanted_length = tolerance_ * system_.reference_length();
  double previous = INFINITY;
  bool keep = false;
  while (report.iterations < allowed_iterations(report)) {
    if (!keep) {
      const StepStatus status = linearize(weights, floor, report);
      if (status != StepStatus::ok) {
        return status;
      }
      previous = measure(report).force;
    }
    solve();
    ++report.iterations;
    const bool whole = update(weights);
    system_.residual(trial_, residual_);
    ++report.residuals;
    const auto [force, reference] = measure(report);
    if (!std::isfinite(force)) {
      return StepStatus::not_finite;
    }
    const double wanted_force = std::max(tolerance_ * reference, floor_force);
    const bool small = force <= wanted_force && system_.scaled_increment(increment_) <= wanted_length;
    const bool at_floor = force <= floor_margin * floor_force && force > 0.5 * previous;
    if (whole && (small || at_floor)) {
      return StepStatus::ok;
    }
    keep = whole && force < previous && force * (force / previous) <= wanted_force;
    previous = force;
  }
  return StepStatus::not_converged;
}

/// Adds the increment, or as much of it as may be taken at once: true where that is all of it.
bool GeneralizedAlpha::update(const TangentWeights& weights) {
  const double turn = system_.largest_turn(increment_);
  const double factor = turn > largest_turn_of_iteration ? largest_turn_of_iteration / turn : 1.0;
  for (std::size_t i = 0; i < increment_.size(); ++i) {
    const double d = factor * increment_[i];
    trial_.q[i] += d;
    trial_.v[i] += weights.damping * d;
    trial_.a[i] += weights.mass * d;
  }
  return factor == 1.0;
}

int GeneralizedAlpha::allowed_iterations(const StepReport& report) const {
  return report.modified_newton ? options_.max_modified_iterations : options_.max_iterations;
}

double GeneralizedAlpha::local_error() {
  const double scale = alpha_.error_constant() * last_step_ * last_step_;
  for (std::size_t i = 0; i < increment_.size(); ++i) {
    increment_[i] = scale * (auxiliary_[i] - rebased_[i]);
  }
  return system_.scaled_increment(increment_);
}

/// The trial state with the old acceleration at the new time, which takes fewer iterations than a zero one (README.md),
/// and a_n moved to the new step.
void GeneralizedAlpha::predict(const State& state, double t, double h) {
  const double ratio = last_step_ > 0.0 ? h / last_step_ : 1.0;
  trial_.t = t;
  for (std::size_t i = 0; i < rebased_.size(); ++i) {
    const double a = state.a[i] + ratio * (auxiliary_[i] - state.a[i]);
    const double a_new = (state.a[i] - alpha_.alpha_m * a) / (1.0 - alpha_.alpha_m);
    rebased_[i] = a;
    trial_.q[i] = state.q[i] + h * (state.v[i] + h * ((0.5 - alpha_.beta) * a + alpha_.beta * a_new));
    trial_.v[i] = state.v[i] + h * ((1.0 - alpha_.gamma) * a + alpha_.gamma * a_new);
    trial_.a[i] = state.a[i];
  }
}

/// Puts the prescribed positions in and corrects velocity and acceleration as a Newton increment would.
void GeneralizedAlpha::follow_prescribed(const TangentWeights& weights) {
  const std::span<const std::size_t> unknowns = system_.prescribed();
  for (std::size_t k = 0; k < unknowns.size(); ++k) {
    predicted_[k] = {trial_.q[unknowns[k]], trial_.v[unknowns[k]], trial_.a[unknowns[k]]};
  }
  system_.prescribe(trial_);
  for (std::size_t k = 0; k < unknowns.size(); ++k) {
    const double d = trial_.q[unknowns[k]] - predicted_[k][0];
    trial_.v[unknowns[k]] = predicted_[k][1] + weights.damping * d;
    trial_.a[unknowns[k]] = predicted_[k][2] + weights.mass * d;
  }
}

/// Residual, tangent and its factors at the trial state. A solver that refuses an unsymmetric matrix gets the symmetric
/// part: Newton is then a modified one.
StepStatus GeneralizedAlpha::linearize(const TangentWeights& weights, const TangentFloor& floor, StepReport& report) {
  system_.tangent(trial_, weights, floor, residual_, tangent_);
  ++report.residuals;
  ++report.factorizations;
  FactorReport factors = solver_.factorize(tangent_.chain);
  if (factors.status == FactorStatus::not_applicable) {
    tangent_.chain.symmetrize();
    factors = solver_.factorize(tangent_.chain);
    report.modified_newton = true;
    ++report.factorizations;
  }
  if (factors.status != FactorStatus::ok) {
    report.worst = factors.failed_unknown;
    return StepStatus::singular;
  }
  return StepStatus::ok;
}

/// increment_ from residual_ with the factors in hand.
void GeneralizedAlpha::solve() {
  system_.reduce(tangent_, residual_, condensed_);
  solver_.solve(condensed_);
  system_.expand(tangent_, condensed_, increment_);
}

/// Projects residual_ and measures it: the force that must vanish and the one to compare it with [N].
GeneralizedAlpha::Measure GeneralizedAlpha::measure(StepReport& report) {
  const double reference = system_.reference_force(residual_);
  system_.project(residual_);
  const ScaledResidual largest = system_.scaled_residual(residual_);
  report.worst = largest.unknown;
  report.residual = reference > 0.0 ? largest.force / reference : 0.0;
  return {largest.force, reference};
}

/// The trial state against the old one.
bool GeneralizedAlpha::turned_too_far(const State& state) {
  for (std::size_t i = 0; i < increment_.size(); ++i) {
    increment_[i] = trial_.q[i] - state.q[i];
  }
  return system_.largest_turn(increment_) > largest_turn_of_step;
}

void GeneralizedAlpha::accept(State& state, double h) {
  for (std::size_t i = 0; i < auxiliary_.size(); ++i) {
    const double forces = (1.0 - alpha_.alpha_f) * trial_.a[i] + alpha_.alpha_f * state.a[i];
    auxiliary_[i] = (forces - alpha_.alpha_m * rebased_[i]) / (1.0 - alpha_.alpha_m);
  }
  std::swap(state, trial_);
  last_step_ = h;
}

}  // namespace hawser
