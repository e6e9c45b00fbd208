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

template <class Family, Want want, class S>
HAWSER_INLINE void integrate(const ElementState<S>& x, const Properties<S>& e, const Weights& w, const CurrentTable& current,
                             Accumulated<typename Family::Shape, S>& sum) {
  using Shape = typename Family::Shape;
  const S inverse_length = S(1.0) / e.length;
  ModeState<Shape, S> y;
  to_modes<Shape>(x.q, y.q);
  to_modes<Shape>(x.v, y.v);
  to_modes<Shape>(x.a, y.a);
  const Coefficients<Shape, S> centre(0.0, e.length, inverse_length), outer(gauss_eta, e.length, inverse_length);
  Response<S> middle;
  middle_response<Family, want>(make_point<Family, true>(y, centre, 0.0, current), e, w, middle);
  PairOf<S> pair;
  if constexpr (Family::wet || Family::bends) {
    Response<S> at[2];
#pragma GCC unroll 1
    for (int k = 0; k < 2; ++k) {
      clear<want>(at[k]);
      Family::template add_terms<want>(make_point<Family, false>(y, outer, k == 0 ? 1.0 : -1.0, current), e, w, at[k]);
    }
    sum_and_difference<Family, want>(at[0], at[1], S(gauss_outer_weight) * e.length, pair);
  }
  static_for<Shape::modes>([&](auto j) __attribute__((always_inline)) {
    sum.g[j] = zero_vector<S>();
    mode_force<Family, j>(outer, centre, pair, middle, sum.g[j]);
  });
  if constexpr (want == Want::tangent)
    static_for<Shape::modes>([&](auto i) __attribute__((always_inline)) {
      static_for<Shape::modes>([&](auto j) __attribute__((always_inline)) {
        mode_block<Family, i, j>(outer, centre, pair, middle, sum.G[i][j]);
      });
    });
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

template <class Shape, Want want, class S>
HAWSER_INLINE void add_inertia_and_weight(const ElementState<S>& x, const Properties<S>& e, const Weights& w, ElementResult<Shape, S>& out) {
  constexpr int n = 2 * Shape::node_vectors;
  const V3<S>* a[4] = {&x.a.r0, Shape::node_vectors == 2 ? &x.a.s0 : &x.a.r1, &x.a.r1, &x.a.s1};
  const S ml = e.mass * e.length;
  for (int i = 0; i < n; ++i) {
    const bool slope_i = Shape::node_vectors == 2 && i % 2 == 1;
    const S scale_i = slope_i ? e.length : S(1.0);
    for (int j = 0; j < n; ++j) {
      const bool slope_j = Shape::node_vectors == 2 && j % 2 == 1;
      const S mij = S(mass_factor<Shape>(i, j)) * ml * scale_i * (slope_j ? e.length : S(1.0));
      add_scaled(out.f[i], mij, *a[j]);
      if constexpr (want == Want::tangent) add_identity(out.K[i][j], S(w.m) * mij);
    }
    out.f[i][2] = out.f[i][2] + S(weight_factor<Shape>(i)) * e.weight * e.length * scale_i;
  }
}

/// All of an element but the axial terms at its nodes (which neighbours share).
template <class Family, Want want, class S>
HAWSER_INLINE void interior(const ElementState<S>& x, const Properties<S>& e, const Weights& w, const CurrentTable& current,
                            ElementResult<typename Family::Shape, S>& out) {
  using Shape = typename Family::Shape;
  Accumulated<Shape, S> sum;
  integrate<Family, want>(x, e, w, current, sum);
  nodal<Shape, want>(sum, out);
  add_inertia_and_weight<Shape, want>(x, e, w, out);
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
  interior<Family, want>(x, e, w, current, out);
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
