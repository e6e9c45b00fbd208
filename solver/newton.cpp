#include "solver/newton.hpp"

#include <algorithm>
#include <cmath>

namespace hawser {
namespace {

constexpr double slope_cap = 0.5;          // largest change of r' in one step
constexpr double position_cap = 0.1;       // largest change of r, of L
constexpr double floor_factor = 0.2;       // after a full step
constexpr double floor_negligible = 1e-8;  // of its start: then the exact matrix, also where no tension is left
constexpr double roundoff_scatter = 2.0;   // rounding was seen up to 1.9 times its floor (theory 6.1)
constexpr double roundoff_margin = 20.0;   // a stalled residual below this many round-off floors counts as rounding
constexpr int stalled_steps = 4;           // full steps that no longer lower the residual
constexpr int resting_steps = 12;          // steps with the residual at rounding, whatever the increments

double step_factor(const IncrementSize& size, double length) {
  const double by_slope = size.slope > slope_cap ? slope_cap / size.slope : 1.0;
  const double by_position = size.position > position_cap * length ? position_cap * length / size.position : 1.0;
  return std::min(by_slope, by_position);
}

/// Recognises a residual that rounding holds up. Either full, small steps no longer lower it; or it has long been there while
/// the increments wander: then they are rounding too, along a direction that nothing holds (the slope of a bare end).
class Rounding {
 public:
  bool holds(double residual, double roundoff, bool full_step, bool small_step) {
    if (residual < 0.5 * best_) {
      best_ = residual;
      stalled_ = 0;
    } else if (full_step) {
      ++stalled_;
    }
    const bool at_rounding = residual <= roundoff_margin * roundoff;
    resting_ = at_rounding ? resting_ + 1 : 0;
    return at_rounding && ((stalled_ >= stalled_steps && small_step) || resting_ >= resting_steps);
  }

 private:
  double best_ = HUGE_VAL;
  int stalled_ = 0, resting_ = 0;
};

/// Takes the increment back in halves until it no longer raises the residual: the guard of a modified Newton.
double damped_advance(NewtonSystem& system, double factor, double residual_before) {
  system.advance(factor);
  double residual = system.residual();
  for (int halvings = 0; halvings < 6 && !(residual <= residual_before); ++halvings) {
    factor *= 0.5;
    system.advance(-factor);
    residual = system.residual();
  }
  return residual;
}

}  // namespace

NewtonReport newton(NewtonSystem& system, const NewtonOptions& options) {
  NewtonReport report;
  double floor = options.floor;
  Rounding rounding;
  report.residual = system.residual();
  report.residuals.push_back(report.residual);
  while (report.factorizations < options.max_iterations) {
    ++report.factorizations;
    if (!system.solve(floor)) {
      report.status = NewtonStatus::no_increment;
      return report;
    }
    const IncrementSize size = system.increment();
    if (!std::isfinite(size.scaled)) {
      report.status = NewtonStatus::not_finite;
      return report;
    }
    const double factor = step_factor(size, options.length);
    if (options.inexact_matrix && floor == 0.0) {
      report.residual = damped_advance(system, factor, report.residual);
    } else {
      system.advance(factor);
      report.residual = system.residual();
    }
    report.residuals.push_back(report.residual);
    const bool full = factor == 1.0;
    const bool small = full && size.scaled <= options.increment_tolerance * options.length;
    if (small && report.residual <= std::max(system.tolerance(), roundoff_scatter * system.roundoff())) {
      report.status = NewtonStatus::converged;
      return report;
    }
    if (rounding.holds(report.residual, system.roundoff(), full, small)) {
      report.status = NewtonStatus::roundoff;
      return report;
    }
    if (full && floor > 0.0) {
      floor *= floor_factor;
      if (floor < floor_negligible * options.floor || floor < system.least_tension()) floor = 0.0;
    }
  }
  return report;
}

}  // namespace hawser
