#include "solver/newton.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace hawser {
namespace {

constexpr double slope_cap = 0.5;          // largest change of r' in one step
constexpr double position_cap = 0.1;       // largest change of r, of L
constexpr double floor_factor = 0.2;       // after a full step
constexpr double floor_negligible = 1e-8;  // of its start: then the exact matrix, also where no tension is left
constexpr double roundoff_scatter = 2.0;   // rounding was seen up to 1.9 times its floor (theory 6.1)
constexpr int stalled_steps = 4;           // full steps that no longer lower the residual
constexpr int resting_steps = 12;          // steps with the residual at rounding, whatever the increments
constexpr double pushed_back = 0.5;        // of the push at the start of a step: then it is shortened
constexpr int searches = 12;               // of the length of a step
constexpr double short_step = 0.3;         // of what the cap leaves: then the floor rises

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
    const bool at_rounding = residual <= rounding_margin * roundoff;
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

/// Factorizes and solves at the present point; false, with the status, where there is no increment.
bool increment_found(NewtonSystem& system, double floor, IncrementSize& size, NewtonReport& report) {
  ++report.factorizations;
  if (!system.solve(floor)) {
    report.status = NewtonStatus::no_increment;
    return false;
  }
  size = system.increment();
  if (!std::isfinite(size.scaled)) report.status = NewtonStatus::not_finite;
  return std::isfinite(size.scaled);
}

/// Whether the present point ends the iteration, after a step of this size.
std::optional<NewtonStatus> settled(NewtonSystem& system, const NewtonOptions& options, Rounding& rounding, double residual, bool full,
                                    const IncrementSize& size) {
  const bool small = full && size.scaled <= options.increment_tolerance * options.length;
  if (small && residual <= std::max(system.tolerance(), roundoff_scatter * system.roundoff())) return NewtonStatus::converged;
  if (rounding.holds(residual, system.roundoff(), full, small)) return NewtonStatus::roundoff;
  return std::nullopt;
}

/// Goes along the increment to where the residual pushes back or forward by no more than half of what it pushed with at the start (`slope`,
/// negative), or the whole way where it never pushes back; returns the fraction. A line that turns without stretching answers with the cube of the
/// step.
double searched_advance(NewtonSystem& system, double whole, double slope, double& residual) {
  double factor = whole, low = 0.0, high = whole;
  system.advance(factor);
  residual = system.residual();
  for (int search = 0; search < searches; ++search) {
    const double here = system.work();
    if (here <= -pushed_back * slope && (here >= pushed_back * slope || factor == whole)) break;
    (here < 0.0 ? low : high) = factor;
    const double cube = here > 0.0 ? factor * std::cbrt(slope / (slope - here)) : high;
    const double next = std::clamp(std::isfinite(cube) ? cube : low, low + 0.1 * (high - low), low + 0.7 * (high - low));
    system.advance(next - factor);
    factor = next;
    residual = system.residual();
  }
  return factor;
}

}  // namespace

double capped_step(const IncrementSize& size, double length) {
  const double by_slope = size.slope > slope_cap ? slope_cap / size.slope : 1.0;
  const double by_position = size.position > position_cap * length ? position_cap * length / size.position : 1.0;
  return std::min(by_slope, by_position);
}

NewtonReport guarded_newton(NewtonSystem& system, const NewtonOptions& options) {
  NewtonReport report;
  double floor = options.floor, last_floor = options.floor;  // the last positive one
  Rounding rounding;
  report.residual = system.residual();
  report.residuals.push_back(report.residual);
  const auto raise = [&] { last_floor = floor = floor > 0.0 ? std::min(floor / floor_factor, options.floor) : last_floor; };
  while (report.factorizations < options.max_iterations) {
    IncrementSize size;
    if (!increment_found(system, floor, size, report)) return report;
    const bool at_rounding = report.residual <= rounding_margin * system.roundoff();
    const double slope = system.work(), cap = capped_step(size, options.length);
    if (!(slope < 0.0) && !at_rounding) {
      if (floor >= options.floor) return report;
      raise();
      continue;
    }
    double factor = cap;
    if (at_rounding) {
      system.advance(cap);
      report.residual = system.residual();
    } else {
      factor = searched_advance(system, cap, slope, report.residual);
    }
    report.residuals.push_back(report.residual);
    const bool full = factor == 1.0;
    if (const auto status = settled(system, options, rounding, report.residual, full, size)) {
      report.status = *status;
      return report;
    }
    if (full && floor > 0.0) {
      last_floor = floor;
      floor *= floor_factor;
      if (floor < floor_negligible * options.floor || floor < system.least_tension()) floor = 0.0;
    } else if (factor < short_step * cap) {
      raise();
    }
  }
  return report;
}

NewtonReport newton(NewtonSystem& system, const NewtonOptions& options) {
  NewtonReport report;
  double floor = options.floor;
  Rounding rounding;
  report.residual = system.residual();
  report.residuals.push_back(report.residual);
  while (report.factorizations < options.max_iterations) {
    IncrementSize size;
    if (!increment_found(system, floor, size, report)) return report;
    const double factor = capped_step(size, options.length);
    if (options.inexact_matrix && floor == 0.0) {
      report.residual = damped_advance(system, factor, report.residual);
    } else {
      system.advance(factor);
      report.residual = system.residual();
    }
    report.residuals.push_back(report.residual);
    const bool full = factor == 1.0;
    if (const auto status = settled(system, options, rounding, report.residual, full, size)) {
      report.status = *status;
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
