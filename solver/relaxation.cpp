#include "solver/relaxation.hpp"

#include <cmath>

namespace hawser {

NewtonReport relax(NewtonSystem& system, const RelaxationOptions& options) {
  NewtonReport report;
  report.residual = system.residual();
  report.residuals.push_back(report.residual);
  bool moving = false;
  while (report.factorizations < options.max_steps) {
    ++report.factorizations;
    if (!system.solve(options.floor)) {
      report.status = NewtonStatus::no_increment;
      return report;
    }
    system.carry(moving);
    const IncrementSize size = system.increment();
    if (!std::isfinite(size.scaled)) {
      report.status = NewtonStatus::not_finite;
      return report;
    }
    const double factor = capped_step(size, options.length);
    system.advance(factor);
    report.residual = system.residual();
    report.residuals.push_back(report.residual);
    if (report.residual <= options.enough * system.tolerance()) {
      report.status = NewtonStatus::converged;
      return report;
    }
    moving = factor == 1.0 && system.work() <= 0.0;
  }
  return report;
}

}  // namespace hawser
