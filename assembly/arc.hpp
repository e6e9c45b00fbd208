// An arc of a circle of given length over a given chord: how a line longer than its way lies on the seabed.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "assembly/bracketed_root.hpp"

namespace hawser {

/// Places and directions (along the chord, across it to the left) at arc length s; straight where the chord is not shorter.
class Arc {
 public:
  Arc(double length, double chord) : length_(length) {
    const double ratio = std::clamp(chord / length, 0.0, 1.0);
    if (ratio > 1.0 - 1e-12) return;
    const auto f = [&](double x) { return std::sin(x) / x - ratio; };
    half_ = bracketed_root(f, 1e-7, std::numbers::pi, 1.0 - ratio, -ratio, 1e-14);
  }
  bool straight() const { return half_ == 0.0; }
  Eigen::Vector2d at(double s) const {
    if (half_ == 0.0) return {s, 0.0};
    const double R = 0.5 * length_ / half_, angle = half_ - s / R;
    return {R * (std::sin(half_) - std::sin(angle)), R * (std::cos(angle) - std::cos(half_))};
  }
  Eigen::Vector2d direction(double s) const {
    const double angle = half_ == 0.0 ? 0.0 : half_ * (1.0 - 2.0 * s / length_);
    return {std::cos(angle), std::sin(angle)};
  }

 private:
  double length_, half_ = 0.0;
};

}  // namespace hawser
