// System: what a time scheme needs to know of a mechanical system.
//
//   R(q, v, a, t) = M(q) a + f(q, v, t) = 0,    tangent = stiffness dR/dq + damping dR/dv + mass dR/da
//
// Vectors q, v, a, r, d have `unknowns` entries; the condensed linear system has `dofs` (assembly/assembler.hpp).
// LineSystem (line_system.hpp) is the production implementation; tests put in problems whose solution is known.
#pragma once

#include <cstddef>
#include <span>

#include "assembly/assembler.hpp"
#include "assembly/state.hpp"
#include "solver/bordered_solver.hpp"

namespace hawser {

/// The largest entry of a residual in the scaled norm of theory 6.1 and where it is.
struct ScaledResidual {
  double force = 0.0;       // N; not a number where an entry is not
  std::size_t unknown = 0;  // of the largest entry
};

/// An increment in the scaled norm of theory 6.1, and the largest rotation or stretch in it: |d_r'|, between the nodes of a bar |d_r1 - d_r0|/l.
struct IncrementMeasure {
  double scaled = 0.0;  // m
  double turn = 0.0;    // -
};

class System {
 public:
  virtual ~System() = default;

  virtual std::size_t unknowns() const = 0;
  virtual std::size_t dofs() const = 0;

  virtual Tangent make_tangent() const = 0;
  virtual void residual(const State& state, std::span<double> r) const = 0;
  virtual void tangent(const State& state, const TangentWeights& weights, const TangentFloor& floor, std::span<double> r, Tangent& t) const = 0;
  virtual void reduce(Tangent& t, std::span<const double> r, std::span<double> rhs) const = 0;

  /// Residual, tangent, its factors and x, the solution of T x = -R: tangent, reduce, factorize and solve. Where the solver refuses the matrix
  /// (not_applicable) it is in t, and x is -R.
  virtual FactorReport linearize(const State& state, const TangentWeights& weights, const TangentFloor& floor, BorderedSolver& solver,
                                 std::span<double> r, Tangent& t, std::span<double> x) const;

  virtual void expand(const Tangent& t, std::span<const double> x, std::span<double> d) const = 0;

  /// Zeroes the part of a residual in the directions that may not move.
  virtual void project(std::span<double> r) const = 0;

  /// Unknowns that prescribe() writes, the same at all times.
  virtual std::span<const std::size_t> prescribed() const = 0;

  /// Writes position, velocity and acceleration of the prescribed unknowns at state.t.
  virtual void prescribe(State& state) const = 0;

  /// Norms of theory 6.1: residual [N] after project(), increment.
  virtual ScaledResidual scaled_residual(std::span<const double> r) const = 0;
  virtual IncrementMeasure measure_increment(std::span<const double> d) const = 0;

  /// What residual [N] and increment [m] are compared with; the residual as it is before project().
  virtual double reference_force(std::span<const double> r) const = 0;
  virtual double reference_length() const = 0;

  /// Residual [N] that rounding leaves at an exact solution.
  virtual double roundoff_floor(const State& state) const = 0;
};

}  // namespace hawser
