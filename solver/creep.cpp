#include "solver/creep.hpp"

#include <algorithm>
#include <cmath>

namespace hawser {
namespace {

constexpr double solved = 0.1;         // of the residual that a step begins with
constexpr double corrected = 0.05;     // of the first increment of a step
constexpr double diverging = 2.0;      // increment over the one before
constexpr int step_iterations = 10;    // of one step
constexpr int easy = 3, hard = 5;      // of these
constexpr double after_failure = 4.0;  // factors of c
constexpr double after_easy = 0.25, after_fair = 0.5;

/// One step; the iterations it took, 0 where Newton failed.
int step(CreepingSystem& system, const CreepOptions& options, NewtonReport& report) {
  double first = 0.0, last = HUGE_VAL;
  for (int iteration = 1; iteration <= step_iterations && report.factorizations < options.max_iterations; ++iteration) {
    ++report.factorizations;
    if (!system.solve(0.0)) return 0;
    const IncrementSize size = system.increment();
    if (!std::isfinite(size.scaled) || capped_step(size, options.length) < 1.0) return 0;
    if (iteration == 1 && system.work() >= 0.0) return 0;  // not downhill: towards a point that is not stable
    system.advance(1.0);
    if (iteration == 1) first = size.scaled;
    if (system.residual() <= solved * report.residual || size.scaled <= corrected * first) return iteration;
    if (iteration > 2 && size.scaled > diverging * last) return 0;
    last = size.scaled;
  }
  return 0;
}

}  // namespace

NewtonReport creep(CreepingSystem& system, const CreepOptions& options) {
  NewtonReport report;
  double c = options.resistance;
  system.resist(c);
  report.residual = system.residual();
  report.residuals.push_back(report.residual);
  const auto at_rest = [&] { return report.residual <= std::max(options.enough * system.tolerance(), rounding_margin * system.roundoff()); };
  while (report.factorizations < options.max_iterations && !at_rest()) {
    const int iterations = step(system, options, report);
    if (iterations == 0) system.go_back();
    c *= iterations == 0 ? after_failure : iterations <= easy ? after_easy : iterations <= hard ? after_fair : 1.0;
    system.resist(c);
    report.residual = system.residual();
    report.residuals.push_back(report.residual);
    if (!std::isfinite(c)) break;
  }
  if (at_rest()) report.status = NewtonStatus::converged;
  system.resist(0.0);
  return report;
}

}  // namespace hawser
