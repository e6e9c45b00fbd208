// Prescribed functions of time: forces and moments F(t), and motions r(t) with velocity and acceleration.
//
//   force:   constant + table (zero outside it) + F sin^2(pi t/T) for 0 <= t <= T
//   motion:  r0 + V int_0^t rho + rho(t) sum_k A_k d_k sin(2 pi t/T_k + phi_k),   rho = min(1, t/ramp)
//            or a natural cubic spline (C2) through the rows of a file, constant velocity 0 beyond its ends.
// Units m, s, N. Evaluation is const and thread-safe.
#pragma once

#include <memory>

#include "assembly/scene.hpp"

namespace hawser {

class Interpolant;  // of a TimeTable

class TimeFunction {
 public:
  TimeFunction() = default;
  explicit TimeFunction(const TimeForce& spec);

  bool any() const { return spec_.any(); }
  Vec3 operator()(double t) const;

 private:
  TimeForce spec_;
  std::shared_ptr<const Interpolant> table_;
};

struct Kinematics {
  Vec3 r = Vec3::Zero(), v = Vec3::Zero(), a = Vec3::Zero();
};

class Motion {
 public:
  Motion() = default;
  Motion(const Vec3& position, const std::optional<MotionSpec>& spec);

  bool moves() const { return spec_.has_value(); }

  /// The constant velocity of a motion without ramp, harmonics or file; empty for any other motion.
  std::optional<Vec3> steady_velocity() const;

  Kinematics operator()(double t) const;

 private:
  Vec3 position_ = Vec3::Zero();
  std::optional<MotionSpec> spec_;
  std::shared_ptr<const Interpolant> table_;
};

}  // namespace hawser
