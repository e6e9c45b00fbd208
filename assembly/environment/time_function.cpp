#include "assembly/environment/time_function.hpp"

#include <gsl/gsl_spline.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hawser {

/// Three interpolants over one time axis: piecewise linear, or natural cubic splines (C2).
class Interpolant {
 public:
  explicit Interpolant(const TimeTable& table) {
    const std::size_t n = table.time.size();
    const bool cubic = table.interpolation == TimeTable::Interpolation::cubic && n >= gsl_interp_type_min_size(gsl_interp_cspline);
    std::vector<double> values(n);
    for (int c = 0; c < 3; ++c) {
      std::transform(table.value.begin(), table.value.end(), values.begin(), [c](const Vec3& v) { return v[c]; });
      spline_[c].reset(gsl_spline_alloc(cubic ? gsl_interp_cspline : gsl_interp_linear, n));
      gsl_spline_init(spline_[c].get(), table.time.data(), values.data(), n);
    }
    begin_ = table.time.front();
    end_ = table.time.back();
  }

  bool covers(double t) const { return t >= begin_ && t <= end_; }
  double clamp(double t) const { return std::clamp(t, begin_, end_); }

  Vec3 value(double t) const { return each(t, gsl_spline_eval); }
  Vec3 first_derivative(double t) const { return each(t, gsl_spline_eval_deriv); }
  Vec3 second_derivative(double t) const { return each(t, gsl_spline_eval_deriv2); }

 private:
  Vec3 each(double t, double (*evaluate)(const gsl_spline*, double, gsl_interp_accel*)) const {
    return {evaluate(spline_[0].get(), t, nullptr), evaluate(spline_[1].get(), t, nullptr), evaluate(spline_[2].get(), t, nullptr)};
  }

  struct Free {
    void operator()(gsl_spline* s) const { gsl_spline_free(s); }
  };
  std::unique_ptr<gsl_spline, Free> spline_[3];
  double begin_ = 0.0, end_ = 0.0;
};

TimeFunction::TimeFunction(const TimeForce& spec) : spec_(spec) {
  if (spec.table) table_ = std::make_shared<const Interpolant>(*spec.table);
}

Vec3 TimeFunction::operator()(double t) const {
  Vec3 f = spec_.constant;
  if (table_ && table_->covers(t)) f += table_->value(t);
  if (spec_.pulse && t >= 0.0 && t <= spec_.pulse->duration) {
    const double s = std::sin(std::numbers::pi * t / spec_.pulse->duration);
    f += s * s * spec_.pulse->force;
  }
  return f;
}

Motion::Motion(const Vec3& position, const std::optional<MotionSpec>& spec) : position_(position), spec_(spec) {
  if (spec && spec->file) table_ = std::make_shared<const Interpolant>(*spec->file);
}

std::optional<Vec3> Motion::steady_velocity() const {
  if (!spec_ || table_ || spec_->ramp > 0.0 || !spec_->harmonics.empty()) return std::nullopt;
  return spec_->velocity;
}

Kinematics Motion::operator()(double t) const {
  if (!spec_) return {position_, Vec3::Zero(), Vec3::Zero()};
  if (table_) {
    Kinematics k;
    k.r = table_->value(table_->clamp(t));
    if (table_->covers(t)) {
      k.v = table_->first_derivative(t);
      k.a = table_->second_derivative(t);
    }
    return k;
  }
  const double T = spec_->ramp;
  const bool ramping = T > 0.0 && t < T;
  const double ramp = ramping ? t / T : 1.0, ramp_rate = ramping ? 1.0 / T : 0.0;
  const double travelled = ramping ? 0.5 * t * t / T : t - 0.5 * T;
  Kinematics k{position_ + travelled * spec_->velocity, ramp * spec_->velocity, ramp_rate * spec_->velocity};
  for (const Harmonic& h : spec_->harmonics) {
    const double omega = 2.0 * std::numbers::pi / h.period;
    const double s = std::sin(omega * t + h.phase), c = std::cos(omega * t + h.phase);
    const Vec3 d = h.amplitude * h.direction;
    k.r += ramp * s * d;
    k.v += (ramp * omega * c + ramp_rate * s) * d;
    k.a += (-ramp * omega * omega * s + 2.0 * ramp_rate * omega * c) * d;
  }
  return k;
}

}  // namespace hawser
