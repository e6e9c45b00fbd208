// Drag, Morison with the independence principle, per unstretched length (theory 5.1; the paper leaves F of (13) open).
//
//   w = u - r_dot,  sigma = w.t,  w_n = P w,  mu = |w_n|,  kn = 1/2 rho Cdn d,  kt = 1/2 rho Cdt pi d
//   phi = kn mu w_n + kt |sigma| sigma t                         (external force: the residual takes -phi)
//   phi_w = kn (mu P + w_n w_n^T/mu) + 2 kt |sigma| t t^T        phi_v = -phi_w,  phi_r = phi_w du/dz e_z^T
//   phi_a = 1/lambda { -kn [sigma (mu P + w_n w_n^T/mu) + mu t w_n^T] + kt |sigma| [2 t w_n^T + sigma P] }
// w_n w_n^T/mu -> 0 with mu: below 1e-12 m/s it is taken as zero. Points: three Gauss points.
#pragma once

#include "assembly/point.hpp"

namespace hawser {

struct Drag {
  template <Want want, class S>
  HAWSER_INLINE static void add(const Point<S>& p, const Properties<S>& e, const Weights& w, Response<S>& out) {
    const V3<S> flow = p.current - p.velocity;
    const S sigma = dot(flow, p.t);
    const V3<S> normal = flow - sigma * p.t;
    const S mu = square_root(dot(normal, normal));
    const S normal_force = e.drag_normal * mu;
    const S tangential_force = e.drag_tangential * magnitude(sigma);
    add_scaled(out.Fr, -normal_force, normal);
    add_scaled(out.Fr, -(tangential_force * sigma), p.t);
    if constexpr (want == Want::tangent) {
      const S inverse_mu = select(mu > S(1.0e-12), S(1.0) / mu, S(0.0));
      const S ring = e.drag_normal * inverse_mu;
      const V3<S> gradient = S(w.k) * p.current_gradient;
      const S c = S(w.c);
      // phi_w = normal_force I + ring n n^T + (2 tangential_force - normal_force) t t^T
      const S along = S(2.0) * tangential_force - normal_force;
      add_identity(out.Jrr, c * normal_force);
      add_outer(out.Jrr, c * ring, normal, normal);
      add_outer(out.Jrr, c * along, p.t, p.t);
      const S ng = ring * dot(normal, gradient), tg = along * dot(p.t, gradient);
      for (int i = 0; i < 3; ++i) out.Jrr(i, 2) = out.Jrr(i, 2) - (normal_force * gradient[i] + ng * normal[i] + tg * p.t[i]);
      // -phi_a
      const S f = S(w.k) * p.inverse_lambda;
      const S isotropic = f * sigma * (normal_force - tangential_force);
      add_identity(out.Jra, isotropic);
      add_outer(out.Jra, S(1.0), p.t, f * (normal_force - S(2.0) * tangential_force) * normal - isotropic * p.t);
      add_outer(out.Jra, f * sigma * ring, normal, normal);
    }
  }
};

}  // namespace hawser
