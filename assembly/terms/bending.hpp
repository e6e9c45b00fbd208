// Bending, isotropic section: energy EI/2 kappa^2 with the material curvature kappa = |r' x r''|/|r'|^2 (theory 3.1, 3.2;
// the paper's (22) divides by |r'|^3, which falsifies EI of a stretched line).
//
// With alpha = a.a, beta = a.b, p = b - (beta/alpha) a, W = p.p/alpha the densities and their derivatives are closed forms
// without cross products or roots, regular for every alpha > 0 (also straight). Points: three Gauss points.
// The Gauss-Newton part (theory 3.3) is EI (k_a, k_b)^T (k_a, k_b), k = a x b/alpha: positive semidefinite.
#pragma once

#include "assembly/point.hpp"

namespace hawser {

struct Bending {
  template <Want want, class S>
  HAWSER_INLINE static void add(const Point<S>& point, const Properties<S>& e, const Weights& w, Response<S>& out) {
    const V3<S>&a = point.a, &b = point.b;
    const S i = point.inverse_lambda * point.inverse_lambda;  // 1/alpha
    const S beta = dot(a, b) * i;                             // (a.b)/alpha
    const V3<S> p = b - beta * a;
    const S W = dot(p, p) * i;
    const S ei = e.EI * i;  // EI/2 of the energy times the 2 of every derivative, over alpha
    add_scaled(out.Fb, ei, p);
    const V3<S> Wa = S(-1.0) * (W * a + beta * p);  // W_a alpha/2
    add_scaled(out.Fa, ei, Wa);
    if constexpr (want == Want::tangent) {
      const S k = S(w.k) * ei;
      add_identity(out.Jbb, k);
      add_outer(out.Jbb, -k * i, a, a);
      if (w.gauss_newton)
        add_gauss_newton(a, b, p, i, beta, W, k, out);
      else
        add_exact(a, b, p, Wa, i, beta, W, k, out);
    }
  }

 private:
  template <class S>
  HAWSER_INLINE static void add_exact(const V3<S>& a, const V3<S>& b, const V3<S>& p, const V3<S>& Wa, const S& i, const S& beta, const S& W,
                                      const S& k, Response<S>& out) {
    const S ki = k * i;
    // Every dyad starts with a or p: the second vectors are summed first.
    add_identity(out.Jab, -k * beta);
    add_outer(out.Jab, ki, a, beta * a - S(2.0) * p);
    add_outer(out.Jab, -ki, p, a);
    add_identity(out.Jaa, k * (beta * beta - W));
    add_outer(out.Jaa, ki, a, beta * b + S(2.0) * ((W - beta * beta) * a - Wa));
    add_outer(out.Jaa, ki, p, S(4.0) * beta * a - b);
  }

  // k_a^T k_a and k_a^T k_b with c = a x b expanded: |c|^2 = alpha^2 W, [b]^T[b] = b.b I - b b^T, [b]^T c = -b x c, c x a = alpha p.
  template <class S>
  HAWSER_INLINE static void add_gauss_newton(const V3<S>& a, const V3<S>& b, const V3<S>& p, const S& i, const S& beta, const S& W, const S& k,
                                             Response<S>& out) {
    const S ki = k * i;
    const V3<S> bxc = dot(b, b) * a - (beta / i) * b;
    add_identity(out.Jaa, ki * dot(b, b));
    add_outer(out.Jaa, -ki, b, b);
    add_outer(out.Jaa, S(-2.0) * ki * i, bxc, a);
    add_outer(out.Jaa, S(-2.0) * ki * i, a, bxc);
    add_outer(out.Jaa, S(4.0) * ki * W, a, a);
    add_identity(out.Jab, -k * beta);
    add_outer(out.Jab, ki, a, b);
    add_outer(out.Jab, S(-2.0) * ki, a, p);
  }
};

}  // namespace hawser
