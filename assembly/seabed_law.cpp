#include "assembly/seabed_law.hpp"

#include <cmath>

namespace hawser {
namespace {

/// The bed at a place: normal e and its derivative, gradient of the penetration.
struct Normal {
  Vec3 e, gap_gradient;
  Mat3 de = Mat3::Zero();

  explicit Normal(const SurfacePoint<double>& bed) : e(-bed.slope[0], -bed.slope[1], 1.0), gap_gradient(bed.gradient[0], bed.gradient[1], -1.0) {
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) de(i, j) = -bed.curvature[i][j];
  }

  /// (x, y) lifted along the bed, and its derivatives with (x, y) and with the place.
  Vec3 lifted(const Vec3& h) const { return {h[0], h[1], -e[0] * h[0] - e[1] * h[1]}; }
  Mat3 lift() const {
    Mat3 T = Mat3::Identity();
    T.row(2) << -e[0], -e[1], 0.0;
    return T;
  }
  Mat3 lift_by_place(const Vec3& h) const {
    Mat3 d = Mat3::Zero();
    d.row(2) = -(h[0] * de.row(0) + h[1] * de.row(1));
    return d;
  }

  /// h without its part along e, and its derivative where h moves with the place.
  Vec3 projected(const Vec3& h) const { return h - e.dot(h) / e.squaredNorm() * e; }
  Mat3 projected_by_place(const Vec3& h) const {
    const double ee = e.squaredNorm(), part = e.dot(h) / ee;
    return Mat3::Identity() - part * de - e * (e + de.transpose() * (h - 2.0 * part * e)).transpose() / ee;
  }
};

void add_friction(const SeabedLaw& law, const Normal& bed, double N, double dN, const Vec3& h, const Vec3& a, FrictionTangent kind,
                  ContactForce& out) {
  const double size = bed.e.norm(), difference = law.friction_axial - law.friction_lateral;
  const Vec3 u = bed.projected(h), along = bed.lifted(a);
  const Mat3 du = bed.projected_by_place(h);
  const double m = sliding_length(law, u.squaredNorm()), slope = sliding_length_slope(law, u.squaredNorm()),
               length = std::sqrt(along.squaredNorm() + upright_slope * upright_slope);
  const Vec3 t = along / length;
  const Vec3 w = law.friction_lateral * u + difference * t.dot(u) * t;
  Mat3 dw = law.friction_lateral * du + difference * t * (t.transpose() * du);
  out.force -= N * size / m * w;
  if (kind == FrictionTangent::frozen) {
    const double lateral = std::sqrt(law.friction_lateral), tt = t.squaredNorm();
    const double more = tt > 0.0 ? (std::sqrt(law.friction_lateral + difference * tt) - lateral) / tt : 0.0;
    const Mat3 plane = Mat3::Identity() - bed.e * bed.e.transpose() / bed.e.squaredNorm(),
               root = (lateral * Mat3::Identity() + more * t * t.transpose()) * plane;
    out.d_r -= N * size / m * root.transpose() * (Mat3::Identity() - slope / m * u * u.transpose()) * root;
    return;
  }
  if (kind == FrictionTangent::exact) {
    const Mat3 across = (Mat3::Identity() - t * t.transpose()) / length;
    const auto turned = [&](const Mat3& dt) -> Mat3 { return difference * (t.dot(u) * dt + t * (u.transpose() * dt)); };
    dw += turned(across * bed.lift_by_place(a));
    out.d_a -= N * size / m * turned(across * bed.lift());
    out.d_r -= w / m * (dN * size * bed.gap_gradient + N / size * bed.de.transpose() * bed.e).transpose();
  }
  if (kind != FrictionTangent::secant) dw -= slope / m * w * (u.transpose() * du);
  out.d_r -= N * size / m * dw;
}

}  // namespace

ContactForce contact_tangent(const SeabedLaw& law, const SurfacePoint<double>& surface, const Vec3& r, const Vec3& a, const Vec3& v, const Vec3* lay,
                             FrictionTangent friction) {
  ContactForce out;
  const double g = surface.height - r[2];
  if (!(g > 0.0)) return out;
  const Normal bed(surface);
  const double N = contact_pressure(law, g), dN = contact_stiffness(law, g), c = law.damping, rate = -bed.e.dot(v);
  const bool toe = g < law.smoothing;
  const double phi = toe ? g / law.smoothing : 1.0, dphi = toe ? 1.0 / law.smoothing : 0.0;
  const double F = N + c * phi * rate;
  if (F > 0.0) {
    out.force = F * bed.e;
    out.d_r = bed.e * ((dN + c * dphi * rate) * bed.gap_gradient - c * phi * bed.de.transpose() * v).transpose() + F * bed.de;
    out.d_v = -c * phi * bed.e * bed.e.transpose();
    if (friction == FrictionTangent::frozen) out.d_r = -dN * bed.e * bed.e.transpose() + 0.5 * F * (bed.de + bed.de.transpose());
  }
  if (lay) add_friction(law, bed, N, dN, r - *lay, a, friction, out);
  return out;
}

}  // namespace hawser
