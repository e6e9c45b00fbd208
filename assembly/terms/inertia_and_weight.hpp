// Inertia and wet weight, per unstretched length (paper (12), (13), (16)).
//
//   f = m r_ddot + w e_z
// Points: three Gauss points, exact but for one product of the consistent mass (kernel.hpp adds what they miss).
#pragma once

#include "assembly/point.hpp"

namespace hawser {

struct InertiaAndWeight {
  template <Want want, class S>
  HAWSER_INLINE static void add(const Point<S>&, const Properties<S>& e, const Weights& w, Transverse<S>& out) {
    out.F_q = out.F_q + e.mass;
    out.F_z = out.F_z + e.weight;
    if constexpr (want == Want::tangent) out.rr = out.rr + S(w.m) * e.mass;
  }
};

}  // namespace hawser
