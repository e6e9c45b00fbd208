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

/// The modes of a nodal quantity.
template <class Shape, class S>
HAWSER_INLINE void to_modes(const Nodal<S>& n, const S& inverse_l, V3<S>* y) {
  y[0] = S(0.5) * (n.r0 + n.r1);
  y[1] = inverse_l * (n.r1 - n.r0);
  if constexpr (Shape::node_vectors == 2) {
    y[2] = S(0.5) * (n.s0 + n.s1) - y[1];
    y[3] = S(0.5) * (n.s1 - n.s0);
  }
}

/// Kinematics of an element in its modes.
template <class Shape, class S>
struct ModeState {
  V3<S> q[Shape::modes], v[Shape::modes], a[Shape::modes];
};

/// The coefficients at the Gauss points, to be read in a loop over them.
template <class Shape>
struct GaussTable {
  double at[gauss_points][3][Shape::modes];

  constexpr GaussTable() : at{} {
    for (int k = 0; k < gauss_points; ++k)
      for (int channel = 0; channel < 3; ++channel)
        for (int j = 0; j < Shape::modes; ++j) at[k][channel][j] = Shape::coefficient(static_cast<Channel>(channel), j, gauss_eta[k]);
  }
};
template <class Shape>
inline constexpr GaussTable<Shape> gauss_table{};

/// Values at Gauss point k. Products with R_0 = 1, A_0 = 0, A_1 = 1, B_0 = B_1 = 0 are left out.
template <class Shape, class S>
struct GaussPoint {
  const double (&c)[3][Shape::modes];
  S position[Shape::modes];  // R_j l

  HAWSER_INLINE GaussPoint(int k, const S& l) : c(gauss_table<Shape>.at[k]) {
    static_for<Shape::modes - 1>([&](auto i) __attribute__((always_inline)) { position[i + 1] = S(c[0][i + 1]) * l; });
  }
  HAWSER_INLINE S r(const V3<S>* y, int i) const {
    S x = y[0][i] + position[1] * y[1][i];
    if constexpr (Shape::modes == 4) x = x + position[2] * y[2][i] + position[3] * y[3][i];
    return x;
  }
  HAWSER_INLINE S a(const V3<S>* y, int i) const {
    S x = y[1][i];
    if constexpr (Shape::modes == 4) x = x + S(c[1][2]) * y[2][i] + S(c[1][3]) * y[3][i];
    return x;
  }
  HAWSER_INLINE S b(const V3<S>* y, int i) const { return S(c[2][2]) * y[2][i] + S(c[2][3]) * y[3][i]; }

  HAWSER_INLINE V3<S> r(const V3<S>* y) const { return {{r(y, 0), r(y, 1), r(y, 2)}}; }
  HAWSER_INLINE V3<S> a(const V3<S>* y) const { return {{a(y, 0), a(y, 1), a(y, 2)}}; }
  HAWSER_INLINE V3<S> b(const V3<S>* y) const { return {{b(y, 0), b(y, 1), b(y, 2)}}; }
};

}  // namespace hawser
