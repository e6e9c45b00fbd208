// Observed: what a line shows at the two ends of an element, for one element (S = double) or W consecutive ones (S = Pack<W>).
//
//   tension    the end force conjugate to r, projected on the tangent (observables.hpp) [N]
//   curvature  |r' x r''|/|r'|^2 [1/m]
//   strain     EA (|r'| - 1) at the three Lobatto points [N]
#pragma once

#include "assembly/kernel.hpp"

namespace hawser {

template <class S>
struct Observed {
  S tension[2], curvature[2], strain_tension[3];
};
inline constexpr int observed_rows = 7;

template <class S>
HAWSER_INLINE V3<S> cross(const V3<S>& a, const V3<S>& b) {
  return {{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
}

/// left, right: the end forces conjugate to r.
template <class Shape, class S>
HAWSER_INLINE void observe(const Nodal<S>& q, const V3<S>& left, const V3<S>& right, const S& length, const S& EA, Observed<S>& out) {
  const S inverse_l = S(1.0) / length;
  V3<S> y[Shape::modes];
  to_modes<Shape>(q, inverse_l, y);
  V3<S> slope[3] = {y[1], y[1], y[1]};
  out.curvature[0] = out.curvature[1] = S(0.0);
  if constexpr (Shape::node_vectors == 2) {
    slope[0] = q.s0;
    add_scaled(slope[1], S(centre<Shape, Channel::a, 2>), y[2]);
    slope[2] = q.s1;
    for (int end = 0; end < 2; ++end) {
      const double eta = end - 0.5;
      V3<S> second = S(Shape::coefficient(Channel::b, 2, eta)) * y[2];
      add_scaled(second, S(Shape::coefficient(Channel::b, 3, eta)), y[3]);
      const V3<S>& a = slope[2 * end];
      const V3<S> normal = cross(a, second);
      out.curvature[end] = inverse_l * square_root(dot(normal, normal)) / dot(a, a);
    }
  }
  for (int k = 0; k < 3; ++k) {
    const S square = dot(slope[k], slope[k]), stretch = square_root(square);
    out.strain_tension[k] = EA * ((square - S(1.0)) / (stretch + S(1.0)));
    if (k == 0) out.tension[0] = -dot(left, slope[0]) / stretch;
    if (k == 2) out.tension[1] = dot(right, slope[2]) / stretch;
  }
}

}  // namespace hawser
