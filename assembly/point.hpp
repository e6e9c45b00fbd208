// Point: kinematics at a quadrature point, and what the terms answer there (architecture rule 4).
//
// With a = r', b = r'' (prime: per unstretched length) and t = a/|a|, a term adds to the generalized forces per unstretched
// length conjugate to (r, r', r'') and to the weighted derivative blocks
//   Jrr = k dFr/dr + c dFr/dr_dot + m dFr/dr_ddot,   Jra = k dFr/da,   Jaa = k dFa/da + c dFa/da_dot,
//   Jab = k dFa/db (dFb/da is its transpose),   Jbb = k dFb/db          (k, c, m: TangentWeights).
// Forces are residual contributions: internal and inertia positive, external negative. Units N, m, s.
#pragma once

#include "assembly/small.hpp"

namespace hawser {

template <class S>
struct Point {
  V3<S> a, b;                       // r', r''
  V3<S> velocity, velocity_a;       // r_dot, r'_dot
  V3<S> acceleration;               // r_ddot
  V3<S> current, current_gradient;  // u(z), du/dz
  S lambda, inverse_lambda, alpha;  // |a|, 1/|a|, a.a
  V3<S> t;                          // a/|a|
};

template <class S>
struct Response {
  V3<S> Fr, Fa, Fb;
  M3<S> Jrr, Jra, Jaa, Jab, Jbb;
};

/// Properties of an element, per unstretched length; the same numbers at all its points.
template <class S>
struct Properties {
  S length;                          // m
  S EA, EI, axial_damping;           // N, N m2, N s
  S mass, weight;                    // kg/m, N/m (down)
  S drag_normal, drag_tangential;    // kg/m2: 1/2 rho Cdn d, 1/2 rho Cdt pi d
  S added_normal, added_tangential;  // kg/m
  S least_tension;                   // N: floor of the geometric stiffness (theory 7.2); very negative: none
};

/// The weights of the tangent as the kernels read them.
struct Weights {
  double k, c, m;
  bool gauss_newton;  // bending by its positive semidefinite part
};

/// Generalized force and tangent wanted, or the force alone.
enum class Want { force, tangent };

template <class S>
HAWSER_INLINE void set_tangent(Point<S>& p) {
  p.alpha = dot(p.a, p.a);
  p.lambda = square_root(p.alpha);
  p.inverse_lambda = S(1.0) / p.lambda;
  p.t = p.inverse_lambda * p.a;
}

}  // namespace hawser
