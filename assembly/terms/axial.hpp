// Axial: exact strain with Kelvin-Voigt damping, N = EA eps + c eps_dot, eps = |r'| - 1 (theory 2.2, paper (18), (19)).
//
//   Fa = N t,   dFa/da = EA [t t^T + eps P/lambda] + c/lambda [t (P a_dot)^T + eps_dot P],   dFa/da_dot = c t t^T
// Points: the three Lobatto points (both nodes and the middle); any other rule locks or leaves zero-energy modes (theory 3.4).
// The floor replaces N = EA eps by max(EA eps, floor) in the geometric part of the tangent only.
#pragma once

#include "assembly/point.hpp"

namespace hawser {

struct Axial {
  template <Want want, class S>
  HAWSER_INLINE static void add(const Point<S>& p, const Properties<S>& e, const Weights& w, Response<S>& out) {
    // |a| - 1 loses digits to cancellation where the strain is small; (a.a - 1)/(|a| + 1) does not.
    const S strain = (p.alpha - S(1.0)) / (p.lambda + S(1.0));
    const S rate = dot(p.t, p.velocity_a);
    const S tension = e.EA * strain;
    add_scaled(out.Fa, tension + e.axial_damping * rate, p.t);
    if constexpr (want == Want::tangent) {
      const S geometric = S(w.k) * (maximum(tension, e.least_tension) + e.axial_damping * rate) * p.inverse_lambda;
      const S material = S(w.k) * e.EA + S(w.c) * e.axial_damping;
      add_identity(out.Jaa, geometric);
      const V3<S> normal_rate = p.velocity_a - rate * p.t;
      add_outer(out.Jaa, S(1.0), p.t, (material - geometric) * p.t + S(w.k) * e.axial_damping * p.inverse_lambda * normal_rate);
    }
  }
};

}  // namespace hawser
