// modes: from the nodes of an element to its Gauss points, through the modes of families.hpp.
#pragma once

#include <utility>

#include "assembly/families.hpp"

namespace hawser {

/// Nodal vectors of an element: position-like quantities x = r, r_dot or r_ddot of both nodes. Slopes are unused by the bar.
template <class S>
struct Nodal {
  V3<S> r0, s0, r1, s1;
};

template <class S>
struct ElementState {
  Nodal<S> q, v, a;
};

/// Steady current, component-wise linear in z between rows, constant beyond; rows ascending in z.
struct CurrentTable {
  int rows = 0;
  const double *z = nullptr, *ux = nullptr, *uy = nullptr;
};

/// The rows that decide between two depths. A profile has many rows, a panel of elements lies between two or three.
HAWSER_INLINE CurrentTable rows_between(const CurrentTable& table, double low, double high) {
  int first = 0, last = table.rows - 1;
  while (first + 1 < last && table.z[first + 1] <= low) ++first;
  while (last - 1 > first && table.z[last - 1] >= high) --last;
  return {last - first + 1, table.z + first, table.ux + first, table.uy + first};
}

template <class S>
HAWSER_INLINE void current_at(const CurrentTable& table, const S& z, V3<S>& u, V3<S>& gradient) {
  u = zero_vector<S>();
  gradient = zero_vector<S>();
  if (table.rows == 0) return;
  u[0] = S(table.ux[0]);
  u[1] = S(table.uy[0]);
  for (int k = 0; k + 1 < table.rows; ++k) {
    const double dz = table.z[k + 1] - table.z[k];
    const S depth = z - S(table.z[k]);
    const S inside = minimum(maximum(depth, S(0.0)), S(dz));
    const S slope_x((table.ux[k + 1] - table.ux[k]) / dz), slope_y((table.uy[k + 1] - table.uy[k]) / dz);
    u[0] = u[0] + slope_x * inside;
    u[1] = u[1] + slope_y * inside;
    const S on = select(depth > S(0.0), select(depth < S(dz), S(1.0), S(0.0)), S(0.0));
    gradient[0] = gradient[0] + slope_x * on;
    gradient[1] = gradient[1] + slope_y * on;
  }
}

template <int n, class F>
HAWSER_INLINE void static_for(F&& f) {
  [&]<int... i>(std::integer_sequence<int, i...>) __attribute__((always_inline)) { (f(std::integral_constant<int, i>{}), ...); }
  (std::make_integer_sequence<int, n>{});
}

/// Component i of the modes of a nodal quantity.
template <class Shape, class S>
HAWSER_INLINE void to_modes(const Nodal<S>& n, const S& inverse_l, int i, S (&y)[Shape::modes]) {
  y[0] = S(0.5) * (n.r0[i] + n.r1[i]);
  y[1] = inverse_l * (n.r1[i] - n.r0[i]);
  if constexpr (Shape::node_vectors == 2) {
    y[2] = S(0.5) * (n.s0[i] + n.s1[i]) - y[1];
    y[3] = S(0.5) * (n.s1[i] - n.s0[i]);
  }
}
template <class Shape, class S>
HAWSER_INLINE void to_modes(const Nodal<S>& n, const S& inverse_l, V3<S>* y) {
  for (int i = 0; i < 3; ++i) {
    S component[Shape::modes];
    to_modes<Shape>(n, inverse_l, i, component);
    for (int j = 0; j < Shape::modes; ++j) y[j][i] = component[j];
  }
}

/// The Gauss points of an element: a component of r, r' or l r'' at all three, from that component of the modes. The outer pair takes the even part
/// with and without the odd one.
template <class Shape, class S>
class GaussPoints {
 public:
  HAWSER_INLINE explicit GaussPoints(const S& l) {
    static_for<Shape::modes - 1>([&](auto i) __attribute__((always_inline)) { r_[i + 1] = S(outer<Channel::r, i + 1>) * l; });
    if constexpr (Shape::modes == 4) r_middle_ = S(Shape::coefficient(Channel::r, 3, 0.0)) * l;
  }
  HAWSER_INLINE void r(const S (&y)[Shape::modes], S (&x)[gauss_points]) const {
    S even = y[0], odd = r_[1] * y[1];
    x[1] = even;
    if constexpr (Shape::modes == 4) {
      x[1] = even + r_middle_ * y[3];
      even = even + r_[3] * y[3];
      odd = odd + r_[2] * y[2];
    }
    set_pair(even, odd, x);
  }
  HAWSER_INLINE static void a(const S (&y)[Shape::modes], S (&x)[gauss_points]) {
    x[0] = x[1] = x[2] = y[1];
    if constexpr (Shape::modes == 4) {
      x[1] = y[1] + S(Shape::coefficient(Channel::a, 2, 0.0)) * y[2];
      set_pair(y[1] + S(outer<Channel::a, 2>) * y[2], S(outer<Channel::a, 3>) * y[3], x);
    }
  }
  HAWSER_INLINE static void b(const S (&y)[Shape::modes], S (&x)[gauss_points]) {
    x[1] = S(outer<Channel::b, 3>) * y[3];
    set_pair(x[1], S(outer<Channel::b, 2>) * y[2], x);
  }

 private:
  template <Channel channel, int j>
  static constexpr double outer = Shape::coefficient(channel, j, gauss_eta[2]);

  HAWSER_INLINE static void set_pair(const S& even, const S& odd, S (&x)[gauss_points]) {
    x[0] = even - odd;
    x[2] = even + odd;
  }

  S r_[Shape::modes], r_middle_;  // coefficients of r times l
};

/// What an element's state is at its Gauss points, as far as the family reads it.
template <class Family, class S>
struct PointKinematics {
  Point<S> at[gauss_points];
  V3<S> middle_slope_dot;   // r'_dot in the middle
  V3<S> skew_acceleration;  // mode e of r_ddot

  /// Component by component: few numbers are on their way at a time.
  HAWSER_INLINE PointKinematics(const ElementState<S>& x, const S& l, const S& inverse_l) {
    using Shape = typename Family::Shape;
    const GaussPoints<Shape, S> points(l);
    S y[Shape::modes], value[gauss_points];
    for (int i = 0; i < 3; ++i) {
      const auto set = [&](V3<S> Point<S>::*member) __attribute__((always_inline)) {
        for (int k = 0; k < gauss_points; ++k) (at[k].*member)[i] = value[k];
      };
      to_modes<Shape>(x.q, inverse_l, i, y);
      points.a(y, value), set(&Point<S>::a);
      if constexpr (Family::bends) points.b(y, value), set(&Point<S>::b);
      if (Family::wet && i == 2) {
        points.r(y, value);
        for (int k = 0; k < gauss_points; ++k) at[k].z = value[k];
      }
      to_modes<Shape>(x.v, inverse_l, i, y);
      if constexpr (Family::wet) points.r(y, value), set(&Point<S>::velocity);
      points.a(y, value), middle_slope_dot[i] = value[1];
      to_modes<Shape>(x.a, inverse_l, i, y);
      points.r(y, value), set(&Point<S>::acceleration);
      if constexpr (Shape::modes == 4) skew_acceleration[i] = y[2];
    }
  }
};

}  // namespace hawser
