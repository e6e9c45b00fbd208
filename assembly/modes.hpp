// modes: an element in its symmetric and antisymmetric modes (families.hpp), and back to its nodes.
//
// Kinematics at a Gauss point are sums over modes, split into parts even and odd in eta. The outer pair of points enters
// through the sum and the difference of what the terms answer there: block (i, j) of the tangent takes, for each pair of
// channels, the one that its coefficients' product leaves (even or odd).
#pragma once

#include <type_traits>
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

/// Forces on and tangent between the node vectors, in the order r0, s0, r1, s1 (bar: r0, r1).
template <class Shape, class S>
struct ElementResult {
  static constexpr int vectors = 2 * Shape::node_vectors;
  V3<S> f[vectors];
  M3<S> K[vectors][vectors];
};

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

/// The modes of a nodal quantity.
template <class Shape, class S>
HAWSER_INLINE void to_modes(const Nodal<S>& n, V3<S>* y) {
  y[0] = n.r0 + n.r1;
  y[1] = n.r1 - n.r0;
  if constexpr (Shape::node_vectors == 2) {
    y[2] = n.s0 + n.s1;
    y[3] = n.s1 - n.s0;
  }
}

/// R_j, A_j, B_j at one eta, with their powers of l.
template <class Shape, class S>
struct Coefficients {
  S at[3][Shape::modes];
  HAWSER_INLINE const S* operator[](Channel channel) const { return at[static_cast<int>(channel)]; }

  HAWSER_INLINE Coefficients(double eta, const S& l, const S& inverse_l) {
    for (int k = 0; k < 3; ++k)
      for (int j = 0; j < Shape::modes; ++j) {
        const Channel channel = static_cast<Channel>(k);
        const S c(Shape::coefficient(channel, j, eta));
        const int power = length_power(channel, j);
        at[k][j] = power == 1 ? c * l : power == 0 ? c : power == -1 ? c * inverse_l : c * inverse_l * inverse_l;
      }
  }
};

/// The part of sum_j c_j y_j that is even (or odd) in eta.
template <class Shape, Channel channel, bool even, class S>
HAWSER_INLINE V3<S> mode_sum(const Coefficients<Shape, S>& c, const V3<S>* y) {
  V3<S> x = zero_vector<S>();
  for (int j = channel == Channel::r ? 0 : 1; j < Shape::modes; ++j)
    if (is_even<Shape>(channel, j) == even) add_scaled(x, c[channel][j], y[j]);
  return x;
}

/// What the terms answer at the Gauss points, weighted: outer pair as a sum (for even products of coefficients) and a difference
/// (for odd ones), and the middle.
template <class S>
struct Responses {
  Response<S> sum, middle, difference;
};

/// Calls f with every member of Response that a family fills.
template <class Family, Want want, class S, class F>
HAWSER_INLINE void for_members(F&& f) {
  if constexpr (Family::wet) f(&Response<S>::Fr);
  f(&Response<S>::Fa);
  if constexpr (Family::bends) f(&Response<S>::Fb);
  if constexpr (want == Want::tangent) {
    f(&Response<S>::Jaa);
    if constexpr (Family::wet) f(&Response<S>::Jrr);
    if constexpr (Family::wet) f(&Response<S>::Jra);
    if constexpr (Family::bends) f(&Response<S>::Jab);
    if constexpr (Family::bends) f(&Response<S>::Jbb);
  }
}

/// From the responses at +eta (in `sum`) and -eta (in `difference`) to their weighted sum and difference; the middle is weighted.
template <class Family, Want want, class S>
HAWSER_INLINE void weigh(Responses<S>& at, const S& outer_weight, const S& middle_weight) {
  for_members<Family, want, S>([&](auto member) __attribute__((always_inline)) {
    constexpr int count = sizeof(at.sum.*member) / sizeof(S);
    S* plus = reinterpret_cast<S*>(&(at.sum.*member));
    S* minus = reinterpret_cast<S*>(&(at.difference.*member));
    S* middle = reinterpret_cast<S*>(&(at.middle.*member));
#pragma GCC unroll 1
    for (int c = 0; c < count; ++c) {
      const S p = plus[c], m = minus[c];
      plus[c] = outer_weight * (p + m);
      minus[c] = outer_weight * (p - m);
      middle[c] = middle_weight * middle[c];
    }
  });
}

inline constexpr int transposed_index[9] = {0, 3, 6, 1, 4, 7, 2, 5, 8};

template <int n, class F>
HAWSER_INLINE void static_for(F&& f) {
  [&]<int... i>(std::integer_sequence<int, i...>) __attribute__((always_inline)) { (f(std::integral_constant<int, i>{}), ...); }
  (std::make_integer_sequence<int, n>{});
}

/// Block (i, j) of the modes. Middle point: only coefficients even in eta are left. Outer pair: like parities take the sum, unlike
/// ones the difference. The loop over the nine components stays a loop: unrolled blocks outgrow the instruction cache.
template <class Family, int i, int j, class S>
HAWSER_INLINE void mode_block(const Coefficients<typename Family::Shape, S>& outer, const Coefficients<typename Family::Shape, S>& centre,
                              const Responses<S>& at, M3<S>& G) {
  using Shape = typename Family::Shape;
  constexpr bool Ri = Shape::even(i), Rj = Shape::even(j);  // A has the other parity, B the same
  constexpr bool slopes = i > 0 && j > 0, wet = Family::wet, bends = Family::bends && slopes;
  const Response<S>&same = Ri == Rj ? at.sum : at.difference, &other = Ri == Rj ? at.difference : at.sum, &middle = at.middle;
  const auto f = [&](const Coefficients<Shape, S>& c, Channel row, Channel column) __attribute__((always_inline)) {
    return c[row][i] * c[column][j];
  };
  const S o_rr = f(outer, Channel::r, Channel::r), o_ra = f(outer, Channel::r, Channel::a), o_aa = f(outer, Channel::a, Channel::a),
          o_ab = f(outer, Channel::a, Channel::b);
  const S o_ba = f(outer, Channel::b, Channel::a), o_bb = f(outer, Channel::b, Channel::b);
  const S m_rr = f(centre, Channel::r, Channel::r), m_ra = f(centre, Channel::r, Channel::a), m_aa = f(centre, Channel::a, Channel::a),
          m_ab = f(centre, Channel::a, Channel::b);
  const S m_ba = f(centre, Channel::b, Channel::a), m_bb = f(centre, Channel::b, Channel::b);
#pragma GCC unroll 1
  for (int c = 0; c < 9; ++c) {
    const int t = transposed_index[c];
    S y(0.0);
    if constexpr (wet) y = o_rr * same.Jrr.m[c];
    if constexpr (wet && j > 0) y = y + o_ra * other.Jra.m[c];
    if constexpr (bends) y = y + o_aa * same.Jaa.m[c] + o_bb * same.Jbb.m[c] + o_ab * other.Jab.m[c] + o_ba * other.Jab.m[t];
    if constexpr (wet && Ri && Rj) y = y + m_rr * middle.Jrr.m[c];
    if constexpr (wet && Ri && !Rj && j > 0) y = y + m_ra * middle.Jra.m[c];
    if constexpr (slopes && !Ri && !Rj) y = y + m_aa * middle.Jaa.m[c];
    if constexpr (bends && !Ri && Rj) y = y + m_ab * middle.Jab.m[c];
    if constexpr (bends && Ri && !Rj) y = y + m_ba * middle.Jab.m[t];
    if constexpr (bends && Ri && Rj) y = y + m_bb * middle.Jbb.m[c];
    G.m[c] = y;
  }
}

template <class Family, int j, class S>
HAWSER_INLINE void mode_force(const Coefficients<typename Family::Shape, S>& outer, const Coefficients<typename Family::Shape, S>& centre,
                              const Responses<S>& at, V3<S>& g) {
  constexpr bool even = Family::Shape::even(j);
  const Response<S>&same = even ? at.sum : at.difference, &other = even ? at.difference : at.sum, &middle = at.middle;
  g = zero_vector<S>();
  if constexpr (Family::wet) add_scaled(g, outer[Channel::r][j], same.Fr);
  if constexpr (Family::wet && even) add_scaled(g, centre[Channel::r][j], middle.Fr);
  if constexpr (j > 0 && !even) add_scaled(g, centre[Channel::a][j], middle.Fa);
  if constexpr (Family::bends && j > 0) {
    add_scaled(g, outer[Channel::a][j], other.Fa);
    add_scaled(g, outer[Channel::b][j], same.Fb);
    if constexpr (even) add_scaled(g, centre[Channel::b][j], middle.Fb);
  }
}

/// Kinematics of an element in its modes.
template <class Shape, class S>
struct ModeState {
  V3<S> q[Shape::modes], v[Shape::modes], a[Shape::modes];
};

/// The point at sign * eta of the coefficients; sign 0 for the middle, whose odd coefficients are zero.
template <class Family, class S>
HAWSER_INLINE Point<S> make_point(const ModeState<typename Family::Shape, S>& y, const Coefficients<typename Family::Shape, S>& c, double sign,
                                  const CurrentTable& current) {
  using Shape = typename Family::Shape;
  const auto at = [&]<Channel channel>(const V3<S>* modes) __attribute__((always_inline)) {
    V3<S> x = mode_sum<Shape, channel, true>(c, modes);
    add_scaled(x, S(sign), mode_sum<Shape, channel, false>(c, modes));
    return x;
  };
  Point<S> p;
  p.a = at.template operator()<Channel::a>(y.q);
  set_tangent(p);
  if constexpr (Family::bends) p.b = at.template operator()<Channel::b>(y.q);
  if constexpr (Family::wet) {
    current_at(current, at.template operator()<Channel::r>(y.q)[2], p.current, p.current_gradient);
    p.velocity = at.template operator()<Channel::r>(y.v);
    p.acceleration = at.template operator()<Channel::r>(y.a);
  }
  return p;
}

template <Want want, class S>
HAWSER_INLINE void clear(Response<S>& at) {
  at.Fr = at.Fa = at.Fb = zero_vector<S>();
  if constexpr (want == Want::tangent) at.Jrr = at.Jra = at.Jaa = at.Jab = at.Jbb = zero_matrix<S>();
}

/// Adds the axial term of the middle to a response that is already weighted: the Lobatto rule gives it 2/3 of the length (bar: all).
template <class Family, Want want, class S>
HAWSER_INLINE void add_middle_axial(const ModeState<typename Family::Shape, S>& y, const Coefficients<typename Family::Shape, S>& centre,
                                    const Properties<S>& e, const Weights& w, Response<S>& middle) {
  using Shape = typename Family::Shape;
  Point<S> p;
  p.a = mode_sum<Shape, Channel::a, true>(centre, y.q);
  p.velocity_a = mode_sum<Shape, Channel::a, true>(centre, y.v);
  set_tangent(p);
  Response<S> axial;
  axial.Fa = zero_vector<S>();
  if constexpr (want == Want::tangent) axial.Jaa = zero_matrix<S>();
  Axial::add<want>(p, e, w, axial);
  const S share = S(Shape::middle_weight) * e.length;
  add_scaled(middle.Fa, share, axial.Fa);
  if constexpr (want == Want::tangent)
    for (int c = 0; c < 9; ++c) middle.Jaa.m[c] = middle.Jaa.m[c] + share * axial.Jaa.m[c];
}

}  // namespace hawser
