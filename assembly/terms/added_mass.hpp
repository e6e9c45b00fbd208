// Added mass, Morison, per unstretched length in a steady current (theory 5.2).
//
//   f = m_n P r_ddot + m_t t t^T r_ddot,   m = rho C_a pi d^2/4
//   d(P q)/da = -1/lambda [(t.q) P + t (P q)^T],   d(t t^T q)/da = +1/lambda [...]
// Morison's usual simplification: no terms from the time derivative of t. Points: three Gauss points.
#pragma once

#include "assembly/point.hpp"

namespace hawser {

struct AddedMass {
  template <Want want, class S>
  HAWSER_INLINE static void add(const Point<S>& p, const Properties<S>& e, const Weights& w, Response<S>& out) {
    const S along = dot(p.t, p.acceleration);
    const V3<S> normal = p.acceleration - along * p.t;
    add_scaled(out.Fr, e.added_normal, normal);
    add_scaled(out.Fr, e.added_tangential * along, p.t);
    if constexpr (want == Want::tangent) {
      const S difference = e.added_tangential - e.added_normal;
      add_identity(out.Jrr, S(w.m) * e.added_normal);
      add_outer(out.Jrr, S(w.m) * difference, p.t, p.t);
      const S f = S(w.k) * p.inverse_lambda * difference;
      add_identity(out.Jra, f * along);
      add_outer(out.Jra, f, p.t, normal - along * p.t);
    }
  }
};

}  // namespace hawser
