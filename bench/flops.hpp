// Operations and bytes of an element, for the roofline: counted, not estimated.
//
// Assembly: the element kernel itself runs over a scalar that counts. +, -, *, / and square root are one operation each (a
// fused multiply-add is two); selects, comparisons and signs are none. The nodal axial term belongs to two elements and is
// evaluated once; sums at the nodes are added. Lanes that a pack leaves idle at the end of a line are not counted.
// Chain: LU point by point of blocks of b (solver/linear/README.md), per node
//   D = L U: 2/3 b^3 - b^2/2 - b/6,   Y = L^-1 U: b^3 - b^2,   X = L U^-1: b^3,   D -= X Y: 2 b^3;
//   forward: b^2 - b + 2 b^2,   backward: 2 b^2 + b^2.
// The watch of pivots and growth is not counted.
// Bytes are those that must move at least: every array once per pass, no line fetched before it is overwritten.
#pragma once

#include "assembly/scene.hpp"

namespace hawser::bench {

/// Operations of one element in a sweep.
double assembly_flops(ModelChoice family, bool wet, bool with_tangent);

/// Operations of one node of b unknowns.
constexpr double factorize_flops(double b) { return 14.0 / 3.0 * b * b * b - 1.5 * b * b - b / 6.0; }
constexpr double solve_flops(double b) { return 6.0 * b * b - b; }

}  // namespace hawser::bench
