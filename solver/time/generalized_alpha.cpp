#include "solver/time/generalized_alpha.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <utility>

namespace hawser {
namespace {

// Newton converges quadratically: the residual that passes this test is usually far below it.
constexpr double automatic_tolerance = 1.0e-8;

using Array = Eigen::Map<Eigen::ArrayXd>;
using ConstArray = Eigen::Map<const Eigen::ArrayXd>;

Array array(std::vector<double>& x) { return {x.data(), static_cast<Eigen::Index>(x.size())}; }
ConstArray array(const std::vector<double>& x) { return {x.data(), static_cast<Eigen::Index>(x.size())}; }

constexpr double largest_turn_of_iteration = 0.5;  // theory 6.3

// A slack line has many solutions at the end of a long step, most of them with elements flipped over. Newton may find any
// of them; one that turns further than this in one step is not believed.
constexpr double largest_turn_of_step = 0.5;

// A tangent and its factors cost about as much as three iterations with old factors, and serve the first iteration of a step.
constexpr int iterations_worth_factors = 3;
constexpr int longest_pause = 32;  // steps

// The floor of theory 6.1 is an estimate: a residual this close above it that no longer falls is at the floor.
constexpr double floor_margin = 10.0;

}  // namespace

/// What rounding leaves of the residual at a state [N]. Found when first asked for: it takes a pass over the elements.
class GeneralizedAlpha::RoundingForce {
 public:
  RoundingForce(const System& system, const State& state) : system_(system), state_(state) {}
  double force() {
    if (!force_) {
      force_ = system_.roundoff_floor(state_);
    }
    return *force_;
  }

 private:
  const System& system_;
  const State& state_;
  std::optional<double> force_;
};

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
      change_(system.unknowns()),
      residual_(system.unknowns()),
      increment_(system.unknowns()),
      predicted_(system.prescribed().size()) {
  trial_.q.resize(system.unknowns());
  trial_.v.resize(system.unknowns());
  trial_.a.resize(system.unknowns());
  solver_.analyze(tangent_);
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
    ++report.iterations;
    for (std::size_t i = 0; i < increment_.size(); ++i) {
      trial_.a[i] += increment_[i];
    }
  }
  state = trial_;
  auxiliary_ = state.a;
  rebased_ = state.a;
  std::fill(change_.begin(), change_.end(), 0.0);
  last_step_ = 0.0;
  return report;
}

StepReport GeneralizedAlpha::step(State& state, double t, double h, const TangentFloor& floor) {
  assert(h > 0.0);
  const TangentWeights weights{1.0, alpha_.gamma / (alpha_.beta * h), (1.0 - alpha_.alpha_m) / ((1.0 - alpha_.alpha_f) * alpha_.beta * h * h)};
  predict(state, t, h);
  follow_prescribed(weights);
  StepReport report;
  report.status = iterate(state, weights, floor, report);
  if (report.status == StepStatus::ok && turned_too_far(state)) {
    report.status = StepStatus::not_converged;
  }
  if (report.status == StepStatus::ok) {
    report.easy = report.iterations <= allowed_iterations(report) / 2;
    accept(state, h);
  }
  return report;
}

/// Newton from the predicted state. Factors serve again, those of an earlier step too, where the contraction just observed says that this
/// finishes the step for less than new ones cost. An iteration with old factors that gained nothing is taken back.
StepStatus GeneralizedAlpha::iterate(const State& state, const TangentWeights& weights, const TangentFloor& floor, StepReport& report) {
  RoundingForce rounding(system_, state);
  bool keep = old_factors_serve(weights, floor), old = keep;
  const bool fresh = !old;
  const int worth = std::min(iterations_worth_factors, factors_.fresh_iterations + 1);
  double previous = INFINITY;
  if (old) {
    evaluate(report);
    previous = measure(report).force;
  }
  while (report.iterations < allowed_iterations(report)) {
    if (keep) {
      solve();
    } else {
      const StepStatus status = linearize(weights, floor, report);
      if (status != StepStatus::ok) {
        return status;
      }
      previous = measure(report).force;
    }
    ++report.iterations;
    const auto [increment, turn] = system_.measure_increment(increment_);
    const double taken = turn > largest_turn_of_iteration ? largest_turn_of_iteration / turn : 1.0;
    const bool whole = taken == 1.0;
    move(taken, weights);
    evaluate(report);
    const Measure now = measure(report);
    const double force = now.force;
    if (!std::isfinite(force) && !old) {
      return StepStatus::not_finite;
    }
    const double wanted = wanted_force(now, rounding);
    if (whole && settled(force, previous, wanted, increment, rounding)) {
      if (old) {
        factors_.failures = 0;
      }
      if (fresh) {
        factors_.fresh_iterations = report.iterations;
      }
      return StepStatus::ok;
    }
    const int more = old ? worth - report.iterations : 1;
    keep = whole && force < previous && more > 0 && force * std::pow(force / previous, more) <= wanted;
    if (old && !keep) {
      give_up_old_factors();
      if (!(force < previous)) {
        move(-taken, weights);
      }
      old = false;
    }
    previous = force;
  }
  return StepStatus::not_converged;
}

double GeneralizedAlpha::wanted_force(const Measure& now, RoundingForce& rounding) const {
  const double tolerated = tolerance_ * now.reference;
  return now.force <= tolerated ? tolerated : std::max(tolerated, rounding.force());
}

/// Judges the next increment, not the one already made: it shrinks with the residual.
bool GeneralizedAlpha::settled(double force, double previous, double wanted_force, double increment, RoundingForce& rounding) const {
  const double next_increment = increment * std::min(1.0, force / previous);
  if (force <= wanted_force && next_increment <= tolerance_ * system_.reference_length()) {
    return true;
  }
  return force > 0.5 * previous && force <= floor_margin * rounding.force();
}

/// The factors in hand are of an earlier step with the same weights, and worth trying.
bool GeneralizedAlpha::old_factors_serve(const TangentWeights& weights, const TangentFloor& floor) {
  if (!factors_.valid || !(factors_.weights == weights) || !(factors_.floor == floor)) {
    return false;
  }
  if (factors_.pause > 0) {
    --factors_.pause;
    return false;
  }
  return true;
}

/// Motions that change the tangent from step to step soon stop paying for attempts.
void GeneralizedAlpha::give_up_old_factors() {
  factors_.pause = std::min((1 << factors_.failures) - 1, longest_pause);
  factors_.failures = std::min(factors_.failures + 1, 6);
}

/// Adds a share of the increment.
void GeneralizedAlpha::move(double factor, const TangentWeights& weights) {
  const auto d = array(increment_);
  array(trial_.q) += factor * d;
  array(trial_.v) += factor * weights.damping * d;
  array(trial_.a) += factor * weights.mass * d;
}

int GeneralizedAlpha::allowed_iterations(const StepReport& report) const {
  return report.modified_newton ? options_.max_modified_iterations : options_.max_iterations;
}

double GeneralizedAlpha::local_error() {
  const double scale = alpha_.error_constant() * last_step_ * last_step_;
  array(increment_) = scale * (array(auxiliary_) - array(rebased_));
  return system_.measure_increment(increment_).scaled;
}

/// The trial state with an acceleration that goes on changing as in the last step (README.md), and a_n moved to the new step.
void GeneralizedAlpha::predict(const State& state, double t, double h) {
  const double ratio = last_step_ > 0.0 ? h / last_step_ : 1.0;
  const ConstArray q = array(state.q), v = array(state.v), qdd = array(state.a);
  Array a = array(rebased_);
  trial_.t = t;
  a = qdd + ratio * (array(auxiliary_) - qdd);
  array(trial_.a) = qdd + ratio * array(change_);
  find_auxiliary(state, increment_);
  const Array a_new = array(increment_);
  array(trial_.q) = q + h * v + h * h * ((0.5 - alpha_.beta) * a + alpha_.beta * a_new);
  array(trial_.v) = v + h * ((1.0 - alpha_.gamma) * a + alpha_.gamma * a_new);
}

/// The auxiliary acceleration of the trial state.
void GeneralizedAlpha::find_auxiliary(const State& state, std::vector<double>& out) {
  const double next = 1.0 / (1.0 - alpha_.alpha_m);
  array(out) = next * ((1.0 - alpha_.alpha_f) * array(trial_.a) + alpha_.alpha_f * array(state.a) - alpha_.alpha_m * array(rebased_));
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

/// Residual, tangent, its factors and the increment at the trial state. A solver that refuses an unsymmetric matrix gets the symmetric
/// part: Newton is then a modified one.
StepStatus GeneralizedAlpha::linearize(const TangentWeights& weights, const TangentFloor& floor, StepReport& report) {
  factors_.valid = false;
  FactorReport factors = system_.linearize(trial_, weights, floor, solver_, residual_, tangent_, condensed());
  ++report.residuals;
  ++report.factorizations;
  if (factors.status == FactorStatus::not_applicable) {
    tangent_.symmetrize();
    factors = solver_.factorize(tangent_);
    if (factors.status == FactorStatus::ok) {
      solver_.solve(condensed());
    }
    report.modified_newton = true;
    ++report.factorizations;
  }
  if (factors.status != FactorStatus::ok) {
    report.worst = factors.failed_unknown;
    return StepStatus::singular;
  }
  system_.expand(tangent_, condensed(), increment_);
  factors_.valid = !report.modified_newton;
  factors_.weights = weights;
  factors_.floor = floor;
  return StepStatus::ok;
}

void GeneralizedAlpha::evaluate(StepReport& report) {
  system_.residual(trial_, residual_);
  ++report.residuals;
}

/// increment_ from residual_ with the factors in hand.
void GeneralizedAlpha::solve() {
  system_.reduce(tangent_, residual_, condensed());
  solver_.solve(condensed());
  system_.expand(tangent_, condensed(), increment_);
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
  array(increment_) = array(trial_.q) - array(state.q);
  return system_.measure_increment(increment_).turn > largest_turn_of_step;
}

void GeneralizedAlpha::accept(State& state, double h) {
  find_auxiliary(state, auxiliary_);
  array(change_) = array(trial_.a) - array(state.a);
  std::swap(state, trial_);
  last_step_ = h;
}

}  // namespace hawser
