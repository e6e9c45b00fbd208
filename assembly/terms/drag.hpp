// Drag, Morison with the independence principle, per unstretched length (theory 5.1; the paper leaves F of (13) open).
//
//   w = u - r_dot,  sigma = w.t,  n = P w,  mu = |n|,  kn = 1/2 rho Cdn d,  kt = 1/2 rho Cdt pi d
//   phi = kn mu n + kt |sigma| sigma t                           (external force: the residual takes -phi)
//   phi_w = kn (mu P + n n^T/mu) + 2 kt |sigma| t t^T            phi_v = -phi_w,  phi_r = phi_w du/dz e_z^T
//   phi_a = 1/|a| { -kn [sigma (mu P + n n^T/mu) + mu t n^T] + kt |sigma| [2 t n^T + sigma P] }
// n n^T/mu -> 0 with mu: below 1e-12 m/s both are taken as zero. Points: three Gauss points.
#pragma once

#include "assembly/point.hpp"

namespace hawser {

struct Drag {
  template <Want want, class S>
  HAWSER_INLINE static void add(const Point<S>& p, const Properties<S>& e, const Weights& w, Transverse<S>& out) {
    const V3<S> flow = p.current - p.velocity;
    const S sigma = dot(flow, p.t);
    const V3<S> normal = flow - sigma * p.t;
    const S square = dot(normal, normal);
    const S inverse_mu = select(square > S(1.0e-24), inverse_square_root(square), S(0.0));
    const S mu = square * inverse_mu;
    const S normal_force = e.drag_normal * mu;
    const S tangential_force = e.drag_tangential * magnitude(sigma);
    out.n = normal;
    out.F_n = out.F_n - normal_force;
    out.F_t = out.F_t - tangential_force * sigma;
    if constexpr (want == Want::tangent) {
      const S ring = e.drag_normal * inverse_mu;
      // phi_w = normal_force I + ring n n^T + along t t^T
      const S along = S(2.0) * tangential_force - normal_force;
      const S c(w.c);
      out.rr = out.rr + c * normal_force;
      out.rr_tt = out.rr_tt + c * along;
      out.rr_nn = c * ring;
      if (p.sheared) {
        const V3<S> gradient = S(w.k) * p.current_gradient;
        out.rr_z = -normal_force * gradient;
        add_scaled(out.rr_z, -(ring * dot(normal, gradient)), normal);
        add_scaled(out.rr_z, -(along * dot(p.t, gradient)), p.t);
      }
      // -phi_a
      const S f = S(w.k) * p.inverse_length;
      const S isotropic = f * sigma * (normal_force - tangential_force);
      out.ra = out.ra + isotropic;
      out.ra_n = out.ra_n + f * (normal_force - S(2.0) * tangential_force);
      out.ra_t = out.ra_t - isotropic;
      out.ra_nn = f * sigma * ring;
    }
  }
};

}  // namespace hawser
