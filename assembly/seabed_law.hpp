// The force of the seabed on a line, per unstretched length [N/m], at one place of the line (theory 5.4).
//
//   g = z_bed(x, y) - z          penetration of the centreline, vertical [m]
//   e = (-p, -q, 1)              normal of the bed, not of unit length (p, q: its slopes)
//   N(g) = 0 (g <= 0),  k g^2/2 delta (g < delta),  k (g - delta/2)
//   normal force    max(0, N - c phi e.v) e,   phi = min(g/delta, 1)
//   friction        -N |e| D u/m,   m = 8 d/(15 - 10 x^2 + 3 x^4), x = |u|/d (x < 1),  |u|,   D = mu_l I + (mu_a - mu_l) t t^T
//   energy          U(g) = int_0^g N:  k g^3/6 delta (g < delta),  k (g^2 - g delta + delta^2/3)/2      [J/m]
//
// On a level bed the force is k max(g, 0), upward; on a slope it has that vertical part and is normal to the bed. u is the displacement
// from where the line was laid, projected on the bed (a line that sinks normally to the bed does not slide); t the direction of the line along the
// bed; d the elastic slip: friction is a spring of 15/8 mu N/d for |u| << d and mu N beyond d, with two continuous derivatives. It depends on the
// state alone (statics): no velocity, no history. Theory 5.4 has m = sqrt(u.u + d^2) instead, which is never quite Coulomb: at the end of a line that
// friction holds, a tension T is off by mu w d EA/T with it and by 5/16 of that here: at d = 1e-3 m 1.9e-3 and 6e-4 of the anchor tension of the case
// that theory 5.4 measures.
//
// U is the energy of the normal force where e is the gradient of z - z_bed: on a level bed and on a plane. Over soundings that are no plane e is
// smoother than the bed (seabed_surface.hpp), so that the normal force has no exact potential; U is then what the penetration alone stores. Neither
// damping nor friction, whose force depends on N as well as on u, has one; U leaves both out.
#pragma once

#include <cmath>

#include "assembly/environment/seabed_surface.hpp"

namespace hawser {

struct SeabedLaw {
  double stiffness = 0.0;                               // k, N/m2
  double smoothing = 0.0;                               // delta, m
  double damping = 0.0;                                 // c, N s/m2
  double friction_axial = 0.0, friction_lateral = 0.0;  // mu_a, mu_l
  double slip = 1.0e-4;                                 // d, m

  bool rubs() const { return friction_axial > 0.0 || friction_lateral > 0.0; }
};

/// Softens the direction t of a line that stands upright on the bed: its part along the bed counts against this.
inline constexpr double upright_slope = 1.0e-3;

template <class S>
S contact_pressure(const SeabedLaw& law, const S& g) {
  if (!(value_of(g) > 0.0)) return S(0.0);
  if (value_of(g) < law.smoothing) return S(0.5 * law.stiffness / law.smoothing) * g * g;
  return S(law.stiffness) * (g - S(0.5 * law.smoothing));
}

/// U(g) [J/m].
inline double contact_energy(const SeabedLaw& law, double g) {
  if (!(g > 0.0)) return 0.0;
  if (g < law.smoothing) return law.stiffness * g * g * g / (6.0 * law.smoothing);
  return 0.5 * law.stiffness * (g * (g - law.smoothing) + law.smoothing * law.smoothing / 3.0);
}

/// dN/dg for g > 0.
inline double contact_stiffness(const SeabedLaw& law, double g) { return g < law.smoothing ? law.stiffness * g / law.smoothing : law.stiffness; }

/// m(u.u).
template <class S>
S sliding_length(const SeabedLaw& law, const S& uu) {
  const double dd = law.slip * law.slip;
  if (!(value_of(uu) < dd)) return square_root(uu);
  const S x = uu * S(1.0 / dd);
  return S(8.0 * law.slip) / (S(15.0) - x * (S(10.0) - S(3.0) * x));
}

/// (dm/d|u|)/|u|.
inline double sliding_length_slope(const SeabedLaw& law, double uu) {
  const double x = uu / (law.slip * law.slip), P = 15.0 - x * (10.0 - 3.0 * x);
  return x < 1.0 ? 8.0 * (20.0 - 12.0 * x) / (law.slip * P * P) : 1.0 / std::sqrt(uu);
}

/// Largest stiffness of friction per unit of normal force [1/m].
inline double friction_stiffness(const SeabedLaw& law) {
  return 1.875 * (law.friction_axial > law.friction_lateral ? law.friction_axial : law.friction_lateral) / law.slip;
}

/// a: r'; lay: where this place of the line was laid, null without friction.
template <class S>
V3<S> contact_force(const SeabedLaw& law, const SurfacePoint<S>& bed, const V3<S>& r, const V3<S>& a, const V3<S>& v, const Vec3* lay) {
  const S g = bed.height - r[2], N = contact_pressure(law, g);
  const S &p = bed.slope[0], &q = bed.slope[1];
  const V3<S> e{{-p, -q, S(1.0)}};
  const S phi = law.smoothing > 0.0 ? minimum(g / S(law.smoothing), S(1.0)) : S(1.0);
  V3<S> force = maximum(N - S(law.damping) * phi * dot(e, v), S(0.0)) * e;
  if (lay == nullptr) return force;
  const auto along_bed = [&](const S& x, const S& y) { return V3<S>{{x, y, p * x + q * y}}; };
  const V3<S> h{{r[0] - S((*lay)[0]), r[1] - S((*lay)[1]), r[2] - S((*lay)[2])}}, u = h - dot(e, h) / dot(e, e) * e, along = along_bed(a[0], a[1]);
  const V3<S> t = (S(1.0) / square_root(dot(along, along) + S(upright_slope * upright_slope))) * along;
  const S rub = N * square_root(dot(e, e)) / sliding_length(law, dot(u, u));
  add_scaled(force, S(-law.friction_lateral) * rub, u);
  add_scaled(force, S(law.friction_lateral - law.friction_axial) * rub * dot(t, u), t);
  return force;
}

/// The same force with its derivatives by r, r' and velocity.
struct ContactForce {
  Vec3 force = Vec3::Zero();
  Mat3 d_r = Mat3::Zero(), d_a = Mat3::Zero(), d_v = Mat3::Zero();
};

/// What a tangent of the bed holds.
enum class FrictionTangent {
  exact,
  /// For stability, where a part without potential says nothing: symmetric. The normal is that of the height too, which it is but for the
  /// smoothing of a grid; friction is N |e| sqrt(D) (I - (m'/m |u|) u u^T) sqrt(D)/m: that of the law where D is a number, u lies along or
  /// across the line, or the line sticks, and never negative (the symmetric part of D (I - (m'/m |u|) u u^T) is), without the change of N and t.
  frozen,
  secant  // N |e| D/m: positive also where the line slides, so that Newton does not overshoot from far away
};

ContactForce contact_tangent(const SeabedLaw& law, const SurfacePoint<double>& bed, const Vec3& r, const Vec3& a, const Vec3& v, const Vec3* lay,
                             FrictionTangent friction);

}  // namespace hawser
