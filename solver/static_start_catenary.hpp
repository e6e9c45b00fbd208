// Elastic catenary of several segments between two held ends, with any constant load vector on each segment.
//
// F(s) is the force that the part beyond s exerts on the part before it; q the load per unstretched length, P the force
// at the far end of a segment:
//   F' = -q,   F jumps by -P,   r' = F/|F| + F/EA
// With e = -q/|q|, F = H + V e (H across q, constant; V = V0 + |q| s) and T = |F|, a segment gives in closed form
//   r(s) - r(0) = F-mean s/EA + A H + B e,   A = [asinh(V/H)]/|q|,   B = [T]/|q|          (theory 7.1 in vectors)
// where the differences [.] are written without cancellation, so |q| -> 0 (a straight line) needs no branch.
//
// The end force is found from r(L) = D. That is the stationary point of the complementary energy
//   Psi(F0) = int ( |F| + |F|^2 / 2EA ) ds - F0 . D
// which is strictly convex in F0: three unknowns, one solution, and Newton with a step control reaches it from anywhere,
// taut or slack, level or vertical, heavy or buoyant.
#pragma once

#include <vector>

#include "assembly/scene.hpp"

namespace hawser {

struct CatenarySegment {
  double length = 0.0;        // m, unstretched
  double EA = 0.0;            // N
  Vec3 load = Vec3::Zero();   // N/m
  Vec3 point = Vec3::Zero();  // N, at its far end
};

/// r(s) - r(0) of a segment that starts with force F; s from 0 to its length.
Vec3 catenary_span(const CatenarySegment& segment, const Vec3& F, double s);

/// Derivative of catenary_span with respect to F: symmetric, positive definite.
Mat3 catenary_compliance(const CatenarySegment& segment, const Vec3& F, double s);

/// Slope r' where the force is F.
Vec3 catenary_slope(double EA, const Vec3& F);

struct EndForce {
  bool converged = false;
  int iterations = 0;
  Vec3 force = Vec3::Zero();  // N, F at s = 0
  double gap = 0.0;           // m, |r(L) - D|
};

/// The end force of a chain of segments over the chord D.
EndForce solve_end_force(const std::vector<CatenarySegment>& segments, const Vec3& chord);

}  // namespace hawser
