// Point: kinematics at a quadrature point, and what the terms answer there (architecture rule 4).
//
// With a = r', b = l r'' (prime: per unstretched length; l: length of the element), t = a/|a|, a term adds to the generalized forces
// conjugate to (r, a, b) and to the weighted derivatives
//   Jrr = k dFr/dr + c dFr/dr_dot + m dFr/dr_ddot,   Jra = k dFr/da,
//   Jaa = k dFa/da,   Jab = k dFa/db (dFb/da is its transpose),   Jbb = k dFb/db          (k, c, m: TangentWeights).
// Inertia and the loads of a flow all lie in the acceleration q, the tangent t and the flow n across the line, and so do their derivatives:
//   Fr = F_q q + F_t t + F_n n + F_z e_z
//   Jrr = rr I + rr_tt t t^T + rr_nn n n^T + rr_z e_z^T,   Jra = ra I + t (ra_q q + ra_t t + ra_n n)^T + ra_nn n n^T:
// they add to these coefficients, and the dyads are formed once.
// Forces are residual contributions: internal and inertia positive, external negative. Units N, m, s.
#pragma once

#include "assembly/small.hpp"

namespace hawser {

template <class S>
struct Point {
  V3<S> a, b;                       // r', l r''
  V3<S> velocity, acceleration;     // r_dot, r_ddot
  S z;                              // of r
  V3<S> current, current_gradient;  // u(z), du/dz
  bool sheared;                     // the gradient is not zero everywhere
  S inverse_length;                 // 1/|a|
  V3<S> t;                          // a/|a|
};

/// Forces at a point, and the derivatives of the elastic ones.
template <class S>
struct Response {
  V3<S> Fr, Fa, Fb;
  M3<S> Jrr, Jra, Jab;
  Symmetric3<S> Jaa, Jbb;
};

/// Coefficients of Fr, Jrr and Jra.
template <class S>
struct Transverse {
  V3<S> n, rr_z;
  S F_q, F_t, F_n, F_z;
  S rr, rr_tt, rr_nn;
  S ra, ra_q, ra_t, ra_n, ra_nn;
};

/// Properties of an element, per unstretched length; at a Gauss point times the weight of the point [m].
template <class S>
struct Properties {
  S length;                          // m
  S EA, EI, axial_damping;           // N, N m2, N s
  S mass, weight;                    // kg/m, N/m (down)
  S drag_normal, drag_tangential;    // kg/m2: 1/2 rho Cdn d, 1/2 rho Cdt pi d
  S added_normal, added_tangential;  // kg/m
  S least_tension;                   // N: floor of the geometric stiffness (theory 7.2); very negative: none
};

inline constexpr int property_count = 11;  // in the order of the members above

/// The weights of the tangent as the kernels read them.
struct Weights {
  double k, c, m;
  bool gauss_newton;  // bending by its positive semidefinite part
};

/// Generalized force and tangent wanted, or the force alone.
enum class Want { force, tangent };

template <class S>
HAWSER_INLINE void set_tangent(Point<S>& p) {
  p.inverse_length = inverse_square_root(dot(p.a, p.a));
  p.t = p.inverse_length * p.a;
}

}  // namespace hawser
