// Axial: exact strain with Kelvin-Voigt damping, N = EA eps + c eps_dot, eps = |r'| - 1 (theory 2.2, paper (18), (19)).
//
//   F = N t,   dF/dr' = EA [t t^T + eps P/|r'|] + c/|r'| [t (P r'_dot)^T + eps_dot P],   dF/dr'_dot = c t t^T
// Points: the three Lobatto points (both nodes and the middle); any other rule locks or leaves zero-energy modes (theory 3.4).
// The floor replaces N = EA eps by max(EA eps, floor) in the geometric part of the tangent only.
#pragma once

#include "assembly/point.hpp"

namespace hawser {

struct Axial {
  /// F and J = k dF/dr' + c dF/dr'_dot.
  template <Want want, class S>
  HAWSER_INLINE static void evaluate(const V3<S>& slope, const V3<S>& slope_dot, const Properties<S>& e, const Weights& w, V3<S>& F, M3<S>& J) {
    const S square = dot(slope, slope);
    const S inverse = inverse_square_root(square);
    const S stretch = square * inverse;
    const V3<S> t = inverse * slope;
    // |r'| - 1 loses digits to cancellation where the strain is small; (r'.r' - 1)/(|r'| + 1) does not.
    const S tension = e.EA * ((square - S(1.0)) / (stretch + S(1.0)));
    const S rate = dot(t, slope_dot);
    F = (tension + e.axial_damping * rate) * t;
    if constexpr (want == Want::tangent) {
      const S damping = S(w.k) * e.axial_damping * inverse;
      const S geometric = S(w.k) * maximum(tension, e.least_tension) * inverse + damping * rate;
      const S material = S(w.k) * e.EA + S(w.c) * e.axial_damping;
      V3<S> beside = (material - geometric - damping * rate) * t;
      add_scaled(beside, damping, slope_dot);
      J = isotropic_matrix(geometric);
      add_outer(J, t, beside);
    }
  }
};

}  // namespace hawser
