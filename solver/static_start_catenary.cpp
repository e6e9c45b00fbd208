#include "solver/static_start_catenary.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace hawser {
namespace {

constexpr double tiny = 1e-10;  // of the tension: keeps H off zero where a vertical line folds

/// F split along and across the load, at both ends of a stretch of length s.
struct Split {
  Vec3 e = Vec3::UnitZ(), n = Vec3::UnitX();  // against the load; direction of H
  double H = 0.0, V0 = 0.0, V1 = 0.0, T0 = 0.0, T1 = 0.0, q = 0.0, s = 0.0;

  Split(const Vec3& load, const Vec3& F, double length) : q(load.norm()), s(length) {
    if (q > 0.0) e = -load / q;
    V0 = F.dot(e);
    V1 = V0 + q * s;
    Vec3 across = F - V0 * e;
    H = across.norm();
    const double least = tiny * (std::max(std::abs(V0), std::abs(V1)) + std::numeric_limits<double>::min());
    n = H > 0.0 ? Vec3(across / H) : e.unitOrthogonal();
    H = std::max(H, least);
    T0 = std::hypot(H, V0);
    T1 = std::hypot(H, V1);
  }

  /// A = int ds/T = (asinh(V1/H) - asinh(V0/H)) / q.
  double A() const {
    const double rise = slope_B();  // (T1 - T0)/(V1 - V0)
    // asinh is odd: write the logarithm on the side where V + T does not cancel.
    const double base = V0 + V1 >= 0.0 ? log_base(V0, T0) : log_base(-V1, T1);
    const double x = q * s * (1.0 + std::abs(rise)) / base;
    return x < 1e-9 ? s * (1.0 + std::abs(rise)) / base * (1.0 - 0.5 * x) : std::log1p(x) / q;
  }

  /// (T1 - T0)/(V1 - V0), between -1 and 1: B = s times this.
  double slope_B() const { return (V1 + V0) / (T1 + T0); }

  /// (1/T1 - 1/T0)/q and (V1/T1 - V0/T0)/q.
  double delta_inverse_T() const { return -s * slope_B() / (T0 * T1); }
  double delta_cosine() const {
    const double VV = V0 * V1, TT = T0 * T1;
    const double difference = VV > 0.0 ? H * H * (H * H + V0 * V0 + V1 * V1) / (TT + VV) : TT - VV;
    return s * (H * H + difference) / ((T1 + T0) * TT);
  }

 private:
  double log_base(double V, double T) const { return V >= 0.0 ? V + T : H * H / (T - V); }
};

/// Ends of the chain of segments: gap and compliance.
struct Sum {
  Vec3 gap;
  Mat3 compliance;
};

Sum sum_of(const std::vector<CatenarySegment>& segments, const Vec3& chord, Vec3 F, bool with_compliance) {
  Sum sum{-chord, Mat3::Zero()};
  for (const CatenarySegment& segment : segments) {
    sum.gap += catenary_span(segment, F, segment.length);
    if (with_compliance) sum.compliance += catenary_compliance(segment, F, segment.length);
    F -= segment.length * segment.load + segment.point;
  }
  return sum;
}

/// The end force of one catenary with the mean load and mean flexibility: theory 7.1 while it is slack. A line as long as
/// its chord carries T = (EA W^2 / 24)^(1/3) (elastic parabola): more than any slacker one, less than any tauter one.
Vec3 mean_catenary_force(const std::vector<CatenarySegment>& segments, const Vec3& chord) {
  double L = 0.0, flexibility = 0.0;
  Vec3 total = Vec3::Zero();
  for (const CatenarySegment& segment : segments) {
    L += segment.length;
    flexibility += segment.length / segment.EA;
    total += segment.length * segment.load + segment.point;
  }
  const double W = total.norm(), c = chord.norm();
  const Vec3 e = W > 0.0 ? Vec3(-total / W) : Vec3::UnitZ();
  const double level = std::cbrt(L / flexibility * W * W / 24.0);
  const double taut = std::max({(c - L) / flexibility, level, 1e-9 * L / flexibility});
  const Vec3 tight = taut * chord / std::max(c, tiny * L) - 0.5 * W * e;
  if (c >= L || W == 0.0) return tight;
  const double Z = chord.dot(e);
  const Vec3 across = chord - Z * e;
  const double X = std::max(across.norm(), 1e-3 * L);
  const double lambda = std::sqrt(3.0 * ((L * L - Z * Z) / (X * X) - 1.0));
  if (!(lambda > 0.0) || W * X / (2.0 * lambda * L) > level) return tight;
  const Vec3 n = across.norm() > 0.0 ? across.normalized() : e.unitOrthogonal();
  return W * X / (2.0 * lambda * L) * n + 0.5 * W / L * (Z / std::tanh(lambda) - L) * e;
}

}  // namespace

Vec3 catenary_span(const CatenarySegment& segment, const Vec3& F, double s) {
  const Split f(segment.load, F, s);
  const Vec3 mean = F - 0.5 * s * segment.load;
  return s / segment.EA * mean + f.A() * (F - f.V0 * f.e) + s * f.slope_B() * f.e;
}

Mat3 catenary_compliance(const CatenarySegment& segment, const Vec3& F, double s) {
  const Split f(segment.load, F, s);
  const double cosine = f.delta_cosine(), HA = f.H * f.delta_inverse_T();
  const Mat3 across = Mat3::Identity() - f.e * f.e.transpose();
  return s / segment.EA * Mat3::Identity() + f.A() * across - cosine * f.n * f.n.transpose() + HA * (f.n * f.e.transpose() + f.e * f.n.transpose()) +
         cosine * f.e * f.e.transpose();
}

EndForce solve_end_force(const std::vector<CatenarySegment>& segments, const Vec3& chord) {
  constexpr int max_iterations = 200;
  double L = 0.0;
  for (const CatenarySegment& segment : segments) L += segment.length;
  EndForce end;
  end.force = mean_catenary_force(segments, chord);
  Sum sum = sum_of(segments, chord, end.force, true);
  const double resolution = 4.0 * std::numeric_limits<double>::epsilon() * (L + chord.norm());
  for (end.iterations = 1; end.iterations <= max_iterations; ++end.iterations) {
    const Vec3 step = -sum.compliance.ldlt().solve(sum.gap);
    const double slope = sum.gap.dot(step);  // of Psi along the step: negative
    // Psi is convex along the step: go back while its slope has turned upward, by the secant, kept within [0.1, 0.5].
    double factor = 1.0, at_factor = sum_of(segments, chord, end.force + step, false).gap.dot(step);
    while (at_factor > -0.1 * slope && factor > 1e-9) {
      factor *= std::clamp(slope / (slope - at_factor), 0.1, 0.5);
      at_factor = sum_of(segments, chord, end.force + factor * step, false).gap.dot(step);
    }
    end.force += factor * step;
    sum = sum_of(segments, chord, end.force, true);
    end.gap = sum.gap.norm();
    const bool still = factor * step.norm() <= 1e-15 * end.force.norm();
    if (end.gap <= resolution || still) break;
  }
  end.converged = end.gap <= 1e-9 * (L + chord.norm());
  return end;
}

Vec3 catenary_slope(double EA, const Vec3& F) {
  const double T = F.norm();
  return T > 0.0 ? Vec3((1.0 / T + 1.0 / EA) * F) : Vec3(-Vec3::UnitZ());
}

}  // namespace hawser
