// kernel: residual and weighted tangent of one element (S = double, AD) or of W consecutive ones (S = Pack<W>).
//
// At every Gauss point the family's terms fill a Response; the chain rule through y = (r0, d, r0', r1') (families.hpp) then
// gives generalized forces g_j = sum_q w_q (R_j Fr + A_j Fa + B_j/l Fb), R_0 = 1, R_j = l rho_j, and their blocks. One routine,
// nodal(), turns y into the nodal coordinates. Inertia and weight enter in closed form (theory 2.1):
//   consistent mass with the factors l that the paper's (28) lacks, and Q^g = w (l/2, l^2/12, l/2, -l^2/12).
#pragma once

#include <type_traits>

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

/// y_j, j >= 1, of a nodal quantity.
template <class Shape, class S>
HAWSER_INLINE void reduced(const Nodal<S>& n, const S& inverse_length, V3<S>* y) {
  y[0] = n.r0;
  y[1] = inverse_length * (n.r1 - n.r0);
  if constexpr (Shape::node_vectors == 2) {
    y[2] = n.s0;
    y[3] = n.s1;
  }
}

template <class Shape, class S>
HAWSER_INLINE V3<S> combine(double (*coefficient)(int, double), double xi, const V3<S>* y) {
  V3<S> x = S(coefficient(1, xi)) * y[1];
  for (int j = 2; j < Shape::vectors; ++j) add_scaled(x, S(coefficient(j, xi)), y[j]);
  return x;
}

/// Generalized forces and blocks conjugate to y.
template <class Shape, class S>
struct Accumulated {
  V3<S> g[Shape::vectors];
  M3<S> G[Shape::vectors][Shape::vectors];
};

template <class Family, Want want, class S>
HAWSER_INLINE void add_point(int q, const Properties<S>& e, const Response<S>& at, const S& inverse_length, Accumulated<typename Family::Shape, S>& sum) {
  using Shape = typename Family::Shape;
  constexpr int n = Shape::vectors;
  const double xi = gauss_xi[q];
  const S weight = S(gauss_weight[q]) * e.length;
  S R[n], A[n], B[n];
  R[0] = weight;
  A[0] = B[0] = S(0.0);
  for (int j = 1; j < n; ++j) {
    R[j] = weight * e.length * S(Shape::rho(j, xi));
    A[j] = weight * S(Shape::A(j, xi));
    B[j] = weight * inverse_length * S(Shape::B(j, xi));
  }
  for (int i = 0; i < n; ++i) {
    if constexpr (Family::wet) add_scaled(sum.g[i], R[i], at.Fr);
    if (i > 0) add_scaled(sum.g[i], A[i], at.Fa);
    if constexpr (Family::bends) add_scaled(sum.g[i], B[i], at.Fb);
  }
  if constexpr (want == Want::tangent) {
    // Columns: the change of (Fr, Fa, Fb) with y_j.
    for (int j = 0; j < n; ++j) {
      const S r = j == 0 ? S(1.0) : e.length * S(Shape::rho(j, xi));
      const S a(j == 0 ? 0.0 : Shape::A(j, xi)), b = inverse_length * S(Shape::B(j, xi));
      for (int c = 0; c < 9; ++c) {
        const int transposed = 3 * (c % 3) + c / 3;
        S dFr, dFa, dFb;
        if constexpr (Family::wet) dFr = r * at.Jrr.m[c] + a * at.Jra.m[c];
        dFa = a * at.Jaa.m[c];
        if constexpr (Family::bends) {
          dFa = dFa + b * at.Jab.m[c];
          dFb = a * at.Jab.m[transposed] + b * at.Jbb.m[c];
        }
        for (int i = 0; i < n; ++i) {
          S& target = sum.G[i][j].m[c];
          if constexpr (Family::wet) target = target + R[i] * dFr;
          if (i > 0 && j > 0) {
            target = target + A[i] * dFa;
            if constexpr (Family::bends) target = target + B[i] * dFb;
          }
        }
      }
    }
  }
}

template <class Family, Want want, class S>
HAWSER_INLINE void integrate(const ElementState<S>& x, const Properties<S>& e, const Weights& w, const CurrentTable& current,
                             Accumulated<typename Family::Shape, S>& sum) {
  using Shape = typename Family::Shape;
  const S inverse_length = S(1.0) / e.length;
  V3<S> y[Shape::vectors], y_dot[Shape::vectors], y_ddot[Shape::vectors];
  reduced<Shape>(x.q, inverse_length, y);
  reduced<Shape>(x.v, inverse_length, y_dot);
  if constexpr (Family::wet) reduced<Shape>(x.a, inverse_length, y_ddot);
  for (int q = 0; q < gauss_points; ++q) {
    const double xi = gauss_xi[q];
    const bool middle = q == 1;
    if constexpr (!Family::wet && !Family::bends)
      if (!middle) continue;
    Point<S> p;
    p.a = combine<Shape>(&Shape::A, xi, y);
    set_tangent(p);
    if constexpr (Family::bends) p.b = inverse_length * combine<Shape>(&Shape::B, xi, y);
    p.velocity_a = middle ? combine<Shape>(&Shape::A, xi, y_dot) : zero_vector<S>();
    if constexpr (Family::wet) {
      const V3<S> offset = e.length * combine<Shape>(&Shape::rho, xi, y);
      current_at(current, y[0][2] + offset[2], p.current, p.current_gradient);
      p.velocity = y_dot[0] + e.length * combine<Shape>(&Shape::rho, xi, y_dot);
      p.acceleration = y_ddot[0] + e.length * combine<Shape>(&Shape::rho, xi, y_ddot);
    }
    Response<S> at;
    at.Fr = at.Fa = at.Fb = zero_vector<S>();
    if constexpr (want == Want::tangent) at.Jrr = at.Jra = at.Jaa = at.Jab = at.Jbb = zero_matrix<S>();
    if (middle) {
      Axial::add<want>(p, e, w, at);
      // The axial rule weighs the middle point by 2/3 of the element (bar: 1), the Gauss rule by 4/9.
      const S ratio(Shape::middle_weight / gauss_weight[1]);
      at.Fa = ratio * at.Fa;
      if constexpr (want == Want::tangent)
        for (int c = 0; c < 9; ++c) at.Jaa.m[c] = ratio * at.Jaa.m[c];
    }
    Family::template add_terms<want>(p, e, w, at);
    add_point<Family, want>(q, e, at, inverse_length, sum);
  }
}

/// Chain rule from y = (r0, d, r0', r1') to the nodal vectors: d = (r1 - r0)/l.
template <class Shape, Want want, class S>
HAWSER_INLINE void nodal(const S& inverse_length, const Accumulated<Shape, S>& sum, ElementResult<Shape, S>& out) {
  constexpr int n = Shape::vectors;
  // Position of y_j among the node vectors; d is spread over r0 (-1/l) and r1 (+1/l).
  constexpr int r1 = Shape::node_vectors;
  constexpr int place[4] = {0, r1, 1, 3};
  const V3<S> gd = inverse_length * sum.g[1];
  for (int j = 0; j < n; ++j)
    if (j != 1) out.f[place[j]] = sum.g[j];
  out.f[0] = out.f[0] - gd;
  out.f[r1] = gd;
  if constexpr (want == Want::tangent) {
    for (int c = 0; c < 9; ++c) {
      const S dd = inverse_length * inverse_length * sum.G[1][1].m[c];
      for (int i = 0; i < n; ++i) {
        if (i == 1) continue;
        for (int j = 0; j < n; ++j)
          if (j != 1) out.K[place[i]][place[j]].m[c] = sum.G[i][j].m[c];
        const S id = inverse_length * sum.G[i][1].m[c], di = inverse_length * sum.G[1][i].m[c];
        out.K[place[i]][r1].m[c] = id;
        out.K[r1][place[i]].m[c] = di;
        if (i == 0) continue;
        out.K[place[i]][0].m[c] = out.K[place[i]][0].m[c] - id;
        out.K[0][place[i]].m[c] = out.K[0][place[i]].m[c] - di;
      }
      const S d0 = inverse_length * sum.G[1][0].m[c], od = inverse_length * sum.G[0][1].m[c];
      out.K[0][0].m[c] = out.K[0][0].m[c] - d0 - od + dd;
      out.K[0][r1].m[c] = od - dd;
      out.K[r1][0].m[c] = d0 - dd;
      out.K[r1][r1].m[c] = dd;
    }
  }
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
  for (int i = 0; i < Shape::vectors; ++i) {
    sum.g[i] = zero_vector<S>();
    if constexpr (want == Want::tangent)
      for (int j = 0; j < Shape::vectors; ++j) sum.G[i][j] = zero_matrix<S>();
  }
  integrate<Family, want>(x, e, w, current, sum);
  nodal<Shape, want>(S(1.0) / e.length, sum, out);
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
