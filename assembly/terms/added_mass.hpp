// Added mass, Morison, per unstretched length in a steady current (theory 5.2).
//
//   f = m_n P r_ddot + m_t t t^T r_ddot,   m = rho C_a pi d^2/4
//   d(P q)/da = -1/|a| [(t.q) P + t (P q)^T],   d(t t^T q)/da = +1/|a| [...]
// Morison's usual simplification: no terms from the time derivative of t. Points: three Gauss points.
#pragma once

#include "assembly/point.hpp"

namespace hawser {

struct AddedMass {
  template <Want want, class S>
  HAWSER_INLINE static void add(const Point<S>& p, const Properties<S>& e, const Weights& w, Transverse<S>& out) {
    const S along = dot(p.t, p.acceleration);
    const S difference = e.added_tangential - e.added_normal;
    out.F_q = out.F_q + e.added_normal;
    out.F_t = out.F_t + difference * along;
    if constexpr (want == Want::tangent) {
      out.rr = out.rr + S(w.m) * e.added_normal;
      out.rr_tt = out.rr_tt + S(w.m) * difference;
      // (P q)^T - (t.q) t^T = q^T - 2 (t.q) t^T
      const S f = S(w.k) * p.inverse_length * difference;
      out.ra = out.ra + f * along;
      out.ra_q = out.ra_q + f;
      out.ra_t = out.ra_t - S(2.0) * f * along;
    }
  }
};

}  // namespace hawser
