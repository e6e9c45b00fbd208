// kernel: residual and weighted tangent of one element (S = double, AD) or of W consecutive ones (S = Pack<W>).
//
// At every Gauss point the family's terms fill a Response. The chain rule through the modes y_j (families.hpp) gives
//   g_j = sum_q w_q (R_j Fr + A_j Fa + B_j Fb),   G_ij = sum_q w_q (R_i Jrr R_j + R_i Jra A_j + A_i Jaa A_j + A_i Jab B_j + ...)
// from the middle point and the sum (even products) or difference (odd products) of the outer pair. One routine, nodal(),
// turns modes into nodal coordinates. Inertia and weight enter in closed form (theory 2.1): the consistent mass with the
// factors l that the paper's (28) lacks, and Q^g = w (l/2, l^2/12, l/2, -l^2/12).
#pragma once

#include "assembly/modes.hpp"

namespace hawser {

/// Everything that is integrated over an element, in its modes: responses at the Gauss points and the coefficients there.
template <class Family, class S>
struct Integrand {
  using Shape = typename Family::Shape;
  Coefficients<Shape, S> centre, outer;
  Responses<S> at;

  HAWSER_INLINE Integrand(const S& l, const S& inverse_l) : centre(0.0, l, inverse_l), outer(gauss_eta, l, inverse_l) {}
};

template <class Family, Want want, class S>
HAWSER_INLINE void integrate(const ElementState<S>& x, const Properties<S>& e, const Weights& w, const CurrentTable& current,
                             Integrand<Family, S>& integrand) {
  using Shape = typename Family::Shape;
  ModeState<Shape, S> y;
  to_modes<Shape>(x.q, y.q);
  to_modes<Shape>(x.v, y.v);
  to_modes<Shape>(x.a, y.a);
  const auto& [centre, outer, at] = integrand;
  clear<want>(integrand.at.middle);
  if constexpr (Family::wet || Family::bends) {
    Response<S>* points[gauss_points] = {&integrand.at.difference, &integrand.at.middle, &integrand.at.sum};
    // A loop, not three copies: the terms are most of the code, and it must stay in the instruction cache.
#pragma GCC unroll 1
    for (int k = 0; k < gauss_points; ++k) {
      clear<want>(*points[k]);
      Family::template add_terms<want>(make_point<Family>(y, k == 1 ? centre : outer, k - 1.0, current), e, w, *points[k]);
    }
    weigh<Family, want>(integrand.at, S(gauss_outer_weight) * e.length, S(gauss_middle_weight) * e.length);
  }
  add_middle_axial<Family, want>(y, centre, e, w, integrand.at.middle);
}

/// Consistent mass per unit mass and length: M_ij = m l mass_factor(i, j) l^(slopes among i, j), and the weight factors.
template <class Shape>
constexpr double mass_factor(int i, int j) {
  if constexpr (Shape::node_vectors == 1) return i == j ? 1.0 / 3.0 : 1.0 / 6.0;
  constexpr double M[4][4] = {{156, 22, 54, -13}, {22, 4, 13, -3}, {54, 13, 156, -22}, {-13, -3, -22, 4}};
  return M[i][j] / 420.0;
}
template <class Shape>
constexpr double weight_factor(int i) {
  if constexpr (Shape::node_vectors == 1) return 0.5;
  constexpr double Q[4] = {1.0 / 2.0, 1.0 / 12.0, 1.0 / 2.0, -1.0 / 12.0};
  return Q[i];
}

/// Inertia of node vector (end, k): sum over the element of M times the accelerations; and its weight.
template <class Shape, class S>
HAWSER_INLINE V3<S> inertia_and_weight(const ElementState<S>& x, const Properties<S>& e, int end, int k) {
  constexpr int n = Shape::node_vectors;
  const int i = n * end + k;
  const S scale = k == 1 ? e.length : S(1.0);
  const S ml = e.mass * e.length * scale, mll = ml * e.length;
  V3<S> f = S(mass_factor<Shape>(i, 0)) * ml * x.a.r0;
  add_scaled(f, S(mass_factor<Shape>(i, n)) * ml, x.a.r1);
  if constexpr (n == 2) {
    add_scaled(f, S(mass_factor<Shape>(i, 1)) * mll, x.a.s0);
    add_scaled(f, S(mass_factor<Shape>(i, 3)) * mll, x.a.s1);
  }
  f[2] = f[2] + S(weight_factor<Shape>(i)) * e.weight * e.length * scale;
  return f;
}

/// The force on the node vectors. Nodes from modes: r0 = y0 - y1, r1 = y0 + y1, r0' = y2 - y3, r1' = y2 + y3.
template <class Family, class S>
HAWSER_INLINE void nodal_force(const Integrand<Family, S>& in, const ElementState<S>& x, const Properties<S>& e, V3<S>* f) {
  using Shape = typename Family::Shape;
  constexpr int n = Shape::node_vectors;
  static_for<n>([&](auto k) __attribute__((always_inline)) {
    V3<S> even, odd;
    mode_force<Family, 2 * k>(in.outer, in.centre, in.at, even);
    mode_force<Family, 2 * k + 1>(in.outer, in.centre, in.at, odd);
    f[k] = even - odd + inertia_and_weight<Shape>(x, e, 0, k);
    f[n + k] = even + odd + inertia_and_weight<Shape>(x, e, 1, k);
  });
}

inline constexpr double identity_components[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};

/// The tangent between node vectors, handed on component by component: sink(i, j, c, K00, K01, K10, K11) gets component c of
/// the blocks between vector i of one node and vector j of the other, for the four pairs of nodes.
template <class Family, class S, class Sink>
HAWSER_INLINE void nodal_tangent(const Integrand<Family, S>& in, const Properties<S>& e, const Weights& w, Sink&& sink) {
  using Shape = typename Family::Shape;
  constexpr int n = Shape::node_vectors;
  static_for<n>([&](auto i) __attribute__((always_inline)) {
    static_for<n>([&](auto j) __attribute__((always_inline)) {
      M3<S> ee, eo, oe, oo;
      mode_block<Family, 2 * i, 2 * j>(in.outer, in.centre, in.at, ee);
      mode_block<Family, 2 * i, 2 * j + 1>(in.outer, in.centre, in.at, eo);
      mode_block<Family, 2 * i + 1, 2 * j>(in.outer, in.centre, in.at, oe);
      mode_block<Family, 2 * i + 1, 2 * j + 1>(in.outer, in.centre, in.at, oo);
      const S power = i + j == 2 ? e.length * e.length : i + j == 1 ? e.length : S(1.0);
      const S mass = S(w.m) * e.mass * e.length * power;
      S m[2][2];
      for (int a = 0; a < 2; ++a)
        for (int b = 0; b < 2; ++b) m[a][b] = S(mass_factor<Shape>(n * a + i, n * b + j)) * mass;
#pragma GCC unroll 1
      for (int c = 0; c < 9; ++c) {
        const S one(identity_components[c]);
        const S even = ee.m[c] + oo.m[c], odd = eo.m[c] + oe.m[c];
        const S even_difference = ee.m[c] - oo.m[c], odd_difference = eo.m[c] - oe.m[c];
        sink(i, j, c, even - odd + m[0][0] * one, even_difference + odd_difference + m[0][1] * one, even_difference - odd_difference + m[1][0] * one,
             even + odd + m[1][1] * one);
      }
    });
  });
}

/// The axial term at a node: force on r' and its block; `share` is the Lobatto weight, end_weight times the length [m].
template <Want want, class S>
HAWSER_INLINE void axial_at_node(const V3<S>& slope, const V3<S>& slope_dot, const Properties<S>& e, const S& share, const Weights& w, V3<S>& f,
                                 M3<S>& K) {
  Point<S> p;
  p.a = slope;
  p.velocity_a = slope_dot;
  set_tangent(p);
  Response<S> at;
  at.Fa = zero_vector<S>();
  if constexpr (want == Want::tangent) at.Jaa = zero_matrix<S>();
  Axial::add<want>(p, e, w, at);
  f = share * at.Fa;
  if constexpr (want == Want::tangent)
    for (int c = 0; c < 9; ++c) K.m[c] = share * at.Jaa.m[c];
}

/// A whole element on its own, nodes included: for joints, observables and tests.
template <class Family, Want want, class S>
HAWSER_INLINE void whole_element(const ElementState<S>& x, const Properties<S>& e, const Weights& w, const CurrentTable& current,
                                 ElementResult<typename Family::Shape, S>& out) {
  using Shape = typename Family::Shape;
  constexpr int n = Shape::node_vectors;
  Integrand<Family, S> in(e.length, S(1.0) / e.length);
  integrate<Family, want>(x, e, w, current, in);
  nodal_force(in, x, e, out.f);
  if constexpr (want == Want::tangent)
    nodal_tangent(
        in, e, w, [&](int i, int j, int c, const S& k00, const S& k01, const S& k10, const S& k11) __attribute__((always_inline)) {
          out.K[i][j].m[c] = k00;
          out.K[i][n + j].m[c] = k01;
          out.K[n + i][j].m[c] = k10;
          out.K[n + i][n + j].m[c] = k11;
        });
  if constexpr (Shape::node_vectors == 2) {
    const S share = S(Shape::end_weight) * e.length;
    V3<S> f;
    M3<S> K = zero_matrix<S>();
    for (int end = 0; end < 2; ++end) {
      const int i = 2 * end + 1;
      axial_at_node<want>(end ? x.q.s1 : x.q.s0, end ? x.v.s1 : x.v.s0, e, share, w, f, K);
      out.f[i] = out.f[i] + f;
      if constexpr (want == Want::tangent)
        for (int c = 0; c < 9; ++c) out.K[i][i].m[c] = out.K[i][i].m[c] + K.m[c];
    }
  }
}

}  // namespace hawser
