// Norms of residuals and increments in mixed units (theory 6.1), shared by statics and dynamics.
//
//   residual    R_hat = max over nodes ( |R_r|,  |R_r'| / l )   [N]
//   increment   d_hat = max over nodes ( |d_r|,  l |d_r'| )     [m]
//
// R_r [N] is conjugate to r [m], R_r' [N m] to r' = dr/ds (dimensionless); l = Model::node_length, the shorter adjacent
// element. The inner unknowns of a joint are slopes (or a factor on a slope) of its node and are measured like r'.
// A residual must be projected (Assembler::project) before it is judged: what a support carries is no error.
#pragma once

#include <span>

#include "assembly/model.hpp"
#include "assembly/state.hpp"

namespace hawser {

/// Scaled norm [N] of a residual of Model::unknowns entries.
double residual_norm(const Model& model, std::span<const double> r);

struct IncrementSize {
  double position = 0.0;  // m, max |d_r|
  double slope = 0.0;     // max |d_r'|
  double scaled = 0.0;    // m, d_hat
};
IncrementSize increment_size(const Model& model, std::span<const double> d);

/// The node with the largest scaled residual.
struct WorstNode {
  int line = 0, node = 0;  // node 0-based within its line
  double residual = 0.0;   // N
  bool slope = false;      // its R_r' is larger than its R_r
};
WorstNode worst_node(const Model& model, std::span<const double> r);

/// L [m]: the length of the longest line, what increments and stiffnesses are measured against.
double longest_line(const Model& model);

/// The largest |R_r| [N] at a support or a hub of the residual BEFORE projection: there it is the tension of the line.
double largest_end_force(const Model& model, std::span<const double> unprojected);

/// Reference force [N] of the stopping criterion: the largest end force, and not less than the largest nodal load at t = 0.
/// The tension is the better measure: nodal loads w l shrink with the mesh while the round-off grows like 1/l.
double reference_force(const Model& model, std::span<const double> unprojected);

/// Largest load on one node [N]: weight of the adjacent half elements, wet weight and force of a body, spread loads.
double largest_nodal_load(const Model& model);

/// Residual that rounding leaves at an exact solution [N]: the largest over the elements of
///   2 eps ( EA max(1, |r| / l) + 12 EI |r| / l^3 + (k + mu w/d) |r| l ),   |r| the larger of the element's ends.
/// First part theory 6.1; second the bending force of a position error eps |r| (12 EI / l^3); third, where there is a seabed,
/// its normal force and its friction on an element that rests on it.
double roundoff_force(const Model& model, const State& state);

}  // namespace hawser
