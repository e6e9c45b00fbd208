// Bending, isotropic section: energy EI/2 kappa^2 with the material curvature kappa = |r' x r''|/|r'|^2 (theory 3.1, 3.2;
// the paper's (22) divides by |r'|^3, which falsifies EI of a stretched line). With a = r' and b = l r'': |a x b|/|a|^2 = l kappa.
//
// With alpha = a.a, beta = a.b/alpha, p = b - beta a, W = p.p/alpha, all derivatives are closed forms in the dyads of a and p, without
// cross products or roots, regular for every alpha > 0 (also straight). Times alpha l^2/EI:
//   Fa = -(W a + beta p)     Fb = p     Jbb = I - a a^T/alpha
//   Jab = -beta I + [beta a a^T - (1 + s) a p^T - s p a^T]/alpha
//   Jaa = (beta^2 + (1 - 2 s) W) I + [(4 s W - beta^2) a a^T + (1 + 2 s) beta (a p^T + p a^T) - p p^T]/alpha
// s = 1: exact; s = 0: the Gauss-Newton part (theory 3.3), positive semidefinite. Points: three Gauss points.
#pragma once

#include "assembly/point.hpp"

namespace hawser {

struct Bending {
  template <Want want, class S>
  HAWSER_INLINE static void add(const Point<S>& point, const Properties<S>& e, const Weights& w, Response<S>& out) {
    const V3<S>&a = point.a, &b = point.b;
    const S i = point.inverse_length * point.inverse_length;  // 1/alpha
    const S beta = dot(a, b) * i;
    const V3<S> p = b - beta * a;
    const S W = dot(p, p) * i;
    const S ei = e.EI * i;
    out.Fb = ei * p;
    V3<S> Fa = -(ei * W) * a;
    add_scaled(Fa, -(ei * beta), p);
    out.Fa = Fa;
    if constexpr (want == Want::tangent) {
      const S k = S(w.k) * ei, ki = k * i, kib = ki * beta, beta2 = beta * beta;
      const double s = w.gauss_newton ? 0.0 : 1.0;
      const V3<S> minus_kia = -ki * a;
      Symmetric3<S> Jbb = isotropic_symmetric(k);
      add_outer(Jbb, a, minus_kia);
      out.Jbb = Jbb;

      V3<S> beside_a = kib * a;
      add_scaled(beside_a, S(-1.0 - s) * ki, p);
      M3<S> Jab = isotropic_matrix(-k * beta);
      add_outer(Jab, a, beside_a);
      if (!w.gauss_newton) add_outer(Jab, p, minus_kia);
      out.Jab = Jab;

      const S mixed = S(1.0 + 2.0 * s) * kib;
      V3<S> beside_p = mixed * a;
      add_scaled(beside_p, -ki, p);
      beside_a = (ki * (S(4.0 * s) * W - beta2)) * a;
      add_scaled(beside_a, mixed, p);
      Symmetric3<S> Jaa = isotropic_symmetric(k * (beta2 + S(1.0 - 2.0 * s) * W));
      add_outer(Jaa, a, beside_a);
      add_outer(Jaa, p, beside_p);
      out.Jaa = Jaa;
    }
  }
};

}  // namespace hawser
