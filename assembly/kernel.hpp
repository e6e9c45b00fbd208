// kernel: residual and weighted tangent of one element (S = double, AD) or of W consecutive ones (S = Pack<W>).
//
// At every Gauss point the family's terms fill a Response. The chain rule through the modes y_j (families.hpp) gives
//   g_j = sum_q w_q (R_j Fr + A_j Fa + B_j Fb),   G_ij = sum_q w_q (R_i Jrr R_j + R_i Jra A_j + A_i Jaa A_j + A_i Jab B_j + ...)
// from the middle point and the sum (even products) or difference (odd products) of the outer pair. With the chord d and the S e of
// families.hpp, r1 - r0 takes 2/l (g_d - g_e) as half difference of the nodes, and the nodes take
//   r0: (g_0 - g_1)/2,   r1: (g_0 + g_1)/2,   r0': (g_2 - g_3)/2,   r1': (g_2 + g_3)/2,
// and blocks the same from both sides. The weights w_q enter through the properties, and so does the half of the rows; that of the columns
// is in the weights of the tangent. The axial term joins at the middle here, at the nodes where the element meets its neighbour.
#pragma once

#include "assembly/modes.hpp"

namespace hawser {

/// Forces on and tangent between the node vectors, in the order r0, s0, r1, s1 (bar: r0, r1).
template <class Shape, class S>
struct ElementResult {
  static constexpr int vectors = 2 * Shape::node_vectors;
  V3<S> f[vectors];
  M3<S> K[vectors][vectors];
};

/// Everything that is integrated over an element: responses at the Gauss points, the axial term of the middle.
template <class Family, class S>
struct Integrand {
  Response<S> at[gauss_points];
  V3<S> axial;          // conjugate to r' in the middle
  M3<S> axial_tangent;  // its tangent
  V3<S> missed;         // force on mode e that three Gauss points miss
  S missed_tangent;     // times the identity
  S length, inverse_length;
};

/// Properties with the weight of a Gauss point and the half of the rows.
template <class S>
HAWSER_INLINE Properties<S> weighted(const Properties<S>& e, const S& inverse_l, double weight) {
  Properties<S> p = e;
  const S share = S(0.5 * weight) * e.length;
  p.EI = S(0.5 * weight) * inverse_l * e.EI;  // EI/l^2 belongs to the variable l r''
  p.mass = share * e.mass;
  p.weight = share * e.weight;
  p.drag_normal = share * e.drag_normal;
  p.drag_tangential = share * e.drag_tangential;
  p.added_normal = share * e.added_normal;
  p.added_tangential = share * e.added_tangential;
  return p;
}

/// Jrr and Jra from their coefficients.
template <class S>
HAWSER_INLINE void form_dyads(const Transverse<S>& x, const Point<S>& p, Response<S>& out) {
  Symmetric3<S> Jrr = isotropic_symmetric(x.rr);
  add_outer(Jrr, p.t, x.rr_tt * p.t);
  add_outer(Jrr, x.n, x.rr_nn * x.n);
  for (int c = 0; c < 9; ++c) out.Jrr.m[c] = Jrr.m[symmetric_index[c]];
  if (p.sheared)
    for (int i = 0; i < 3; ++i) out.Jrr(i, 2) = out.Jrr(i, 2) + x.rr_z[i];
  V3<S> beside_t = x.ra_q * p.acceleration;
  add_scaled(beside_t, x.ra_t, p.t);
  add_scaled(beside_t, x.ra_n, x.n);
  M3<S> Jra = isotropic_matrix(x.ra);
  add_outer(Jra, p.t, beside_t);
  add_outer(Jra, x.n, x.ra_nn * x.n);
  out.Jra = Jra;
}

/// What the terms answer at a Gauss point whose kinematics are set.
template <class Family, Want want, class S>
HAWSER_INLINE void respond(Point<S> p, const Properties<S>& e, const Weights& w, const CurrentTable& current, Response<S>& out) {
  if constexpr (Family::bends || Family::wet) set_tangent(p);
  if constexpr (Family::bends) Family::template add_elastic<want>(p, e, w, out);
  Transverse<S> x;
  x.n = x.rr_z = zero_vector<S>();
  x.F_q = x.F_t = x.F_n = x.F_z = x.rr = x.rr_tt = x.rr_nn = x.ra = x.ra_q = x.ra_t = x.ra_n = x.ra_nn = S(0.0);
  if constexpr (Family::wet) {
    current_at(current, p.z, p.current, p.current_gradient);
    p.sheared = current.rows > 1;
  }
  Family::template add_loads<want>(p, e, w, x);
  V3<S> F = x.F_q * p.acceleration;
  F[2] = F[2] + x.F_z;
  if constexpr (Family::wet) {
    add_scaled(F, x.F_t, p.t);
    add_scaled(F, x.F_n, x.n);
  }
  out.Fr = F;
  if constexpr (want == Want::tangent) {
    out.Jrr.m[0] = x.rr;  // all of it where nothing but inertia acts
    if constexpr (Family::wet) form_dyads(x, p, out);
  }
}

template <class Family, Want want, class S>
HAWSER_INLINE void integrate(const ElementState<S>& x, const Properties<S>& e, const Weights& weights, const CurrentTable& current,
                             Integrand<Family, S>& in) {
  using Shape = typename Family::Shape;
  in.length = e.length;
  in.inverse_length = S(1.0) / e.length;
  const PointKinematics<Family, S> kinematics(x, in.length, in.inverse_length);
  const Weights w{0.5 * weights.k, 0.5 * weights.c, 0.5 * weights.m, weights.gauss_newton};  // the half of the columns
  // A loop, not three copies: the terms are most of the code, and it must stay in the instruction cache.
#pragma GCC unroll 1
  for (int k = 0; k < gauss_points; ++k)
    respond<Family, want>(kinematics.at[k], weighted(e, in.inverse_length, gauss_weight[k]), w, current, in.at[k]);

  const S share = S(0.5 * Shape::middle_weight) * e.length;
  V3<S> axial;
  M3<S> J;
  Axial::evaluate<want>(kinematics.at[1].a, kinematics.middle_slope_dot, e, w, axial, J);
  in.axial = share * axial;
  if constexpr (want == Want::tangent)
    for (int c = 0; c < 9; ++c) in.axial_tangent.m[c] = share * J.m[c];
  if constexpr (Shape::node_vectors == 2) {
    const S missed = S(0.5 * Shape::missed_mass) * e.mass * e.length * e.length * e.length;
    in.missed = missed * kinematics.skew_acceleration;
    in.missed_tangent = S(w.m) * missed;
  }
}

/// The number that belongs to a product of coefficients: even in eta the sum of the outer pair, odd their difference.
template <class S>
struct Pair {
  S sum, difference;
  HAWSER_INLINE Pair(const S& minus, const S& plus) : sum(plus + minus), difference(plus - minus) {}
  template <bool even>
  HAWSER_INLINE const S& part() const {
    if constexpr (even)
      return sum;
    else
      return difference;
  }
};

template <class Shape, Channel channel, int j>
inline constexpr double outer = Shape::coefficient(channel, j, gauss_eta[2]);
template <class Shape, Channel channel, int j>
inline constexpr double centre = Shape::coefficient(channel, j, 0.0);

template <class Shape, Channel channel, int j>
inline constexpr bool is_even = Shape::even(j) != (channel == Channel::a);

/// The force on mode j, component c.
template <class Family, int j, class S>
HAWSER_INLINE S mode_force(const Integrand<Family, S>& in, int c) {
  using Shape = typename Family::Shape;
  const auto part = [&]<Channel channel>(V3<S> Response<S>::*member) __attribute__((always_inline)) {
    const Pair<S> pair((in.at[0].*member)[c], (in.at[2].*member)[c]);
    S f = S(outer<Shape, channel, j>) * pair.template part<is_even<Shape, channel, j>>();
    if constexpr (centre<Shape, channel, j> != 0.0) f = f + S(centre<Shape, channel, j>) * (in.at[1].*member)[c];
    return f;
  };
  S elastic(0.0);
  if constexpr (Family::bends && j > 0) elastic = part.template operator()<Channel::a>(&Response<S>::Fa);
  if constexpr (Family::bends && j > 1) elastic = elastic + part.template operator()<Channel::b>(&Response<S>::Fb);
  if constexpr (centre<Shape, Channel::a, j> != 0.0) elastic = elastic + S(centre<Shape, Channel::a, j>) * in.axial[c];
  if constexpr (j == 2) elastic = elastic + in.missed[c];
  const S position = part.template operator()<Channel::r>(&Response<S>::Fr);
  if constexpr (j == 0)
    return position;
  else
    return in.length * position + elastic;
}

/// From the modes' share of a row or column to the nodes', in the order r0, s0, r1, s1 (bar: r0, r1); without the half.
template <class Shape, class S>
HAWSER_INLINE void to_nodes(const S* g, S* f) {
  constexpr int n = Shape::node_vectors;
  for (int i = 0; i < n; ++i) {
    f[i] = g[2 * i] - g[2 * i + 1];
    f[n + i] = g[2 * i] + g[2 * i + 1];
  }
}

/// The force on the node vectors.
template <class Family, class S>
HAWSER_INLINE void nodal_force(const Integrand<Family, S>& in, V3<S>* f) {
  using Shape = typename Family::Shape;
  for (int c = 0; c < 3; ++c) {
    S g[Shape::modes], nodal[Shape::modes];
    static_for<Shape::modes>([&](auto j) __attribute__((always_inline)) { g[j] = mode_force<Family, j>(in, c); });
    if constexpr (Shape::modes == 4) g[1] = g[1] - g[2];
    g[1] = S(2.0) * in.inverse_length * g[1];
    to_nodes<Shape>(g, nodal);
    for (int i = 0; i < Shape::modes; ++i) f[i][c] = nodal[i];
  }
}

inline constexpr int transposed_index[9] = {0, 3, 6, 1, 4, 7, 2, 5, 8};
inline constexpr double identity_components[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};

/// Adds component c of what acts at the middle through r', and of the mass that three Gauss points miss: formed for d and e, where A_1 = 1.
template <class Family, class S>
HAWSER_INLINE void add_middle_component(const Integrand<Family, S>& in, int c, S (*G)[Family::Shape::modes]) {
  using Shape = typename Family::Shape;
  const S per_y = S(2.0) * in.inverse_length;
  const S axial = in.axial_tangent.m[c];
  if constexpr (Shape::modes == 2) {
    G[1][1] = G[1][1] + per_y * per_y * axial;
  } else {
    constexpr double A2 = centre<Shape, Channel::a, 2>;
    const S ee = S(A2 * A2) * axial + in.missed_tangent * S(identity_components[c]);
    const S de = per_y * (S(A2) * axial - ee);
    G[1][1] = G[1][1] + per_y * (per_y * (S(1.0 - A2) * axial) - de);
    G[1][2] = G[1][2] + de;
    G[2][1] = G[2][1] + de;
    G[2][2] = G[2][2] + ee;
  }
}

/// Component c of the blocks of bending: formed for d, e and f, where A_1 = 1 and B_1 = 0, then for the half sums and differences.
template <class Family, class S>
HAWSER_INLINE void bending_component(const Integrand<Family, S>& in, int c, S (*G)[Family::Shape::modes]) {
  using Shape = typename Family::Shape;
  const S per_y = S(2.0) * in.inverse_length;
  constexpr double A2 = outer<Shape, Channel::a, 2>, A2c = centre<Shape, Channel::a, 2>;
  constexpr double A3 = outer<Shape, Channel::a, 3>, B2 = outer<Shape, Channel::b, 2>, B3 = outer<Shape, Channel::b, 3>;
  const int t = transposed_index[c], s = symmetric_index[c];
  const Response<S>* at = in.at;
  const Pair<S> aa(at[0].Jaa.m[s], at[2].Jaa.m[s]), bb(at[0].Jbb.m[s], at[2].Jbb.m[s]);
  const Pair<S> ab(at[0].Jab.m[c], at[2].Jab.m[c]), ba(at[0].Jab.m[t], at[2].Jab.m[t]);
  const S middle = at[1].Jaa.m[s], ab1 = at[1].Jab.m[c], ba1 = at[1].Jab.m[t], both = ab.difference + ba.difference;
  const S dd = middle + aa.sum;
  const S de0 = S(A2c) * middle + S(A2) * aa.sum, de = de0 + S(B2) * ab.difference, ed = de0 + S(B2) * ba.difference;
  const S ee = S(A2c * A2c) * middle + S(A2 * A2) * aa.sum + S(A2 * B2) * both + S(B2 * B2) * bb.sum;
  const S df0 = S(A3) * aa.difference, df = df0 + S(B3) * (ab.sum + ab1), fd = df0 + S(B3) * (ba.sum + ba1);
  const S ef0 = S(A2 * A3) * aa.difference + S(B2 * B3) * bb.difference;
  const S ef = ef0 + S(A2 * B3) * ab.sum + S(A2c * B3) * ab1 + S(B2 * A3) * ba.sum;
  const S fe = ef0 + S(A2 * B3) * ba.sum + S(A2c * B3) * ba1 + S(B2 * A3) * ab.sum;
  const S ff = S(A3 * A3) * aa.sum + S(A3 * B3) * both + S(B3 * B3) * (bb.sum + at[1].Jbb.m[s]);
  G[1][1] = per_y * per_y * (dd - de - ed + ee);
  G[1][2] = per_y * (de - ee);
  G[2][1] = per_y * (ed - ee);
  G[2][2] = ee;
  G[1][3] = per_y * (df - ef);
  G[3][1] = per_y * (fd - fe);
  G[2][3] = ef;
  G[3][2] = fe;
  G[3][3] = ff;
}

/// Coefficients of r and r' for the half sums and differences of the nodes, in the outer points and in the middle.
template <class Shape, class S>
struct PairCoefficients {
  S r[Shape::modes], a[Shape::modes], r_centre[Shape::modes], a_centre[Shape::modes];

  HAWSER_INLINE PairCoefficients(const S& l, const S& inverse_l) {
    fill<Channel::r>(gauss_eta[2], l, S(1.0), r);
    fill<Channel::r>(0.0, l, S(1.0), r_centre);
    fill<Channel::a>(gauss_eta[2], S(1.0), inverse_l, a);
    fill<Channel::a>(0.0, S(1.0), inverse_l, a_centre);
  }

 private:
  template <Channel channel>
  HAWSER_INLINE static void fill(double eta, const S& slopes, const S& chord, S* out) {
    const auto c = [&](int j) __attribute__((always_inline)) { return Shape::coefficient(channel, j, eta); };
    out[0] = S(c(0));
    if constexpr (Shape::modes == 2) {
      out[1] = S(2.0 * c(1)) * chord;
    } else {
      out[1] = S(2.0 * (c(1) - c(2))) * chord;
      out[2] = S(c(2)) * slopes;
      out[3] = S(c(3)) * slopes;
    }
  }
};

/// Adds component c of the blocks that act through the position: rows R_i of the sums over the points of Jrr R_j + Jra A_j. R_0 = 1.
template <class Family, class S>
HAWSER_INLINE void add_transverse_component(const Integrand<Family, S>& in, const PairCoefficients<typename Family::Shape, S>& of, int c,
                                            S (*G)[Family::Shape::modes]) {
  using Shape = typename Family::Shape;
  constexpr Channel r = Channel::r, a = Channel::a;
  const Response<S>* at = in.at;
  const auto jrr = [&](int k) __attribute__((always_inline)) {
    if constexpr (Family::wet)
      return at[k].Jrr.m[c];
    else
      return at[k].Jrr.m[0] * S(identity_components[c]);
  };
  const S rr_middle = jrr(1);
  const Pair<S> rr(jrr(0), jrr(2));
  const Pair<S> ra = Family::wet ? Pair<S>(at[0].Jra.m[c], at[2].Jra.m[c]) : rr;  // read only where wet
  static_for<Shape::modes>([&](auto j) __attribute__((always_inline)) {
    constexpr bool even_r = is_even<Shape, r, j>, even_a = is_even<Shape, a, j>;
    constexpr bool in_sum = Family::wet || even_r, in_difference = Family::wet || !even_r;  // the difference of equal Jrr is zero
    constexpr bool in_middle = centre<Shape, r, j> != 0.0 || (Family::wet && centre<Shape, a, j> != 0.0);
    S sum = rr.template part<even_r>(), difference = rr.template part<!even_r>(), middle = rr_middle;
    if constexpr (j > 0) {
      sum = of.r[j] * sum;
      difference = of.r[j] * difference;
      if constexpr (centre<Shape, r, j> != 0.0) middle = of.r_centre[j] * middle;
    }
    if constexpr (Family::wet && j > 0) {
      sum = sum + of.a[j] * ra.template part<even_a>();
      difference = difference + of.a[j] * ra.template part<!even_a>();
      const S ra_middle = at[1].Jra.m[c];
      if constexpr (centre<Shape, a, j> != 0.0)
        middle = centre<Shape, r, j> != 0.0 ? middle + of.a_centre[j] * ra_middle : of.a_centre[j] * ra_middle;
    }
    if constexpr (in_middle && in_sum) G[0][j] = G[0][j] + (sum + middle);
    if constexpr (!in_middle && in_sum) G[0][j] = G[0][j] + sum;
    if constexpr (in_difference) G[1][j] = G[1][j] + of.r[1] * difference;
    if constexpr (Shape::modes == 4) {
      if constexpr (in_difference) G[2][j] = G[2][j] + of.r[2] * difference;
      if constexpr (in_sum) G[3][j] = G[3][j] + of.r[3] * sum;
      if constexpr (in_middle) G[3][j] = G[3][j] + of.r_centre[3] * middle;
    }
  });
}

/// The bending part of component c, from mode 1 on. It is symmetric: component (j, i) is (i, j) transposed, which came first and was kept.
template <class Family, class S>
HAWSER_INLINE void symmetric_component(const Integrand<Family, S>& in, int c, S (*kept)[Family::Shape::modes][Family::Shape::modes],
                                       S (*G)[Family::Shape::modes]) {
  constexpr int n = Family::Shape::modes;
  const int row = c % 3, column = c / 3, pair = row + column - 1;
  if (row < column) {
    for (int i = 1; i < n; ++i)
      for (int j = 1; j < n; ++j) G[i][j] = kept[pair][j][i];
  } else {
    bending_component<Family>(in, c, G);
    if (row == column) return;
    for (int i = 1; i < n; ++i)
      for (int j = 1; j < n; ++j) kept[pair][i][j] = G[i][j];
  }
}

/// The tangent between node vectors, handed on component by component: sink(c, K) gets component c of all blocks, K[i][j] between node
/// vectors in the order r0, s0, r1, s1 (bar: r0, r1). One loop over the components: everything in between stays in registers.
template <class Family, class S, class Sink>
HAWSER_INLINE void nodal_tangent(const Integrand<Family, S>& in, Sink&& sink) {
  using Shape = typename Family::Shape;
  constexpr int n = Shape::modes;
  const PairCoefficients<Shape, S> of(in.length, in.inverse_length);
  S kept[3][n][n];
#pragma GCC unroll 1
  for (int c = 0; c < 9; ++c) {
    S G[n][n], half[n][n], K[n][n];
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) G[i][j] = S(0.0);
    if constexpr (Family::bends) symmetric_component<Family>(in, c, kept, G);
    add_middle_component<Family>(in, c, G);
    add_transverse_component<Family>(in, of, c, G);
    for (int i = 0; i < n; ++i) to_nodes<Shape>(G[i], half[i]);
    for (int j = 0; j < n; ++j) {
      S at_column[n], nodal[n];
      for (int i = 0; i < n; ++i) at_column[i] = half[i][j];
      to_nodes<Shape>(at_column, nodal);
      for (int i = 0; i < n; ++i) K[i][j] = nodal[i];
    }
    sink(c, K);
  }
}

/// A whole element on its own, nodes included: for joints, observables and tests.
template <class Family, Want want, class S>
HAWSER_INLINE void whole_element(const ElementState<S>& x, const Properties<S>& e, const Weights& w, const CurrentTable& current,
                                 ElementResult<typename Family::Shape, S>& out) {
  using Shape = typename Family::Shape;
  constexpr int n = Shape::modes;
  Integrand<Family, S> in;
  integrate<Family, want>(x, e, w, current, in);
  nodal_force(in, out.f);
  if constexpr (want == Want::tangent)
    nodal_tangent(
        in, [&](int c, const S(&K)[n][n]) __attribute__((always_inline)) {
          for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j) out.K[i][j].m[c] = K[i][j];
        });
  if constexpr (Shape::node_vectors == 2) {
    const S share = S(Shape::end_weight) * e.length;
    V3<S> f;
    M3<S> J;
    for (int end = 0; end < 2; ++end) {
      const int i = 2 * end + 1;
      Axial::evaluate<want>(end ? x.q.s1 : x.q.s0, end ? x.v.s1 : x.v.s0, e, w, f, J);
      add_scaled(out.f[i], share, f);
      if constexpr (want == Want::tangent)
        for (int c = 0; c < 9; ++c) out.K[i][i].m[c] = out.K[i][i].m[c] + share * J.m[c];
    }
  }
}

}  // namespace hawser
