// Newton's method for R(x) = 0 with a floored tangent and a cap on the step (theory 7.2).
//
//   T(x, T_f) d = -R(x),   x <- x + a d,   a = min(1, 0.5 / max|d_r'|, 0.1 L / max|d_r|)
//
// T_f [N] is the least tension that the geometric part of the matrix may use; the residual never changes. After a step
// with a = 1 the floor falls to a fifth; once it is under the least tension of the state, or negligible, the matrix is
// the exact one (T_f = 0) and convergence is quadratic. No line search: with the floor the residual may rise for a
// while, and demanding that it falls prevents convergence from a straight start (theory 7.2).
#pragma once

#include <vector>

#include "solver/norms.hpp"

namespace hawser {

/// What Newton asks of a problem. All sizes in the scaled norms of norms.hpp.
class NewtonSystem {
 public:
  virtual ~NewtonSystem() = default;

  /// Scaled residual [N] at the present point.
  virtual double residual() = 0;

  /// Residual [N] below which the present point is converged, and what rounding leaves there.
  virtual double tolerance() = 0;
  virtual double roundoff() = 0;

  /// Least tension [N] of the present point; asked only while the floor is positive.
  virtual double least_tension() = 0;

  /// Factorizes the tangent at the present point with this floor and solves for the increment; false: no increment.
  virtual bool solve(double floor) = 0;
  virtual IncrementSize increment() const = 0;

  /// Work d . R of the last increment with the residual of the last call of residual() [J]: the slope of the energy along d, where there is one.
  virtual double work() const = 0;

  /// Adds the last increment that was carried, if `moving`, to the present one, and keeps the sum: motion with momentum.
  virtual void carry(bool moving) = 0;

  /// Moves the present point by `factor` times the increment.
  virtual void advance(double factor) = 0;
};

/// A residual that stands still below this many round-off floors counts as rounding.
constexpr double rounding_margin = 20.0;

struct NewtonOptions {
  double length = 1.0;                // L [m], of the step cap and of the increment criterion
  double floor = 0.0;                 // T_f at the start [N]; 0: the exact matrix from the first iteration
  double increment_tolerance = 1e-8;  // of the last increment, relative to L
  int max_iterations = 200;
  bool inexact_matrix = false;  // the matrix is not the tangent (modified Newton): once the floor is gone, halve steps that raise the residual
};

/// The share of an increment of this size that Newton takes.
double capped_step(const IncrementSize& size, double length);

enum class NewtonStatus {
  converged,
  roundoff,      // stands still a little above the tolerance, where rounding holds it: as good as converged
  no_increment,  // the matrix could not be factorized
  not_finite,
  too_many_iterations,
};

struct NewtonReport {
  NewtonStatus status = NewtonStatus::too_many_iterations;
  int factorizations = 0;
  double residual = 0.0;          // N, at the last point
  std::vector<double> residuals;  // N, at every point from the first one
  bool converged() const { return status == NewtonStatus::converged || status == NewtonStatus::roundoff; }
};

NewtonReport newton(NewtonSystem& system, const NewtonOptions& options);

/// The same with a guard, for points far from an equilibrium or near several: where the system's matrix is definite every step goes downhill.
///   - A step ends where the residual pushes back as hard as it pushed forward at the start: |d . R(x + a d)| <= |d . R(x)| / 2.
///   - The floor rises fivefold after a step that had to be short, and where d does not lead downhill.
/// A line that hardly stretches has to turn in small steps then: slow from far away, but it neither flies off nor ends on a saddle.
NewtonReport guarded_newton(NewtonSystem& system, const NewtonOptions& options);

}  // namespace hawser
