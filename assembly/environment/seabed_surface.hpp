// SeabedSurface: height and normal of the seabed at a place (x, y).
//
//   level:   z = -depth
//   grid:    z bilinear between the soundings; beyond the grid the outermost cells go on, so that 2 x 2 soundings are a sloping plane
//
// The slopes (p, q) that give the normal (-p, -q, 1) are NOT the derivatives of the bilinear height, which jump from cell to cell:
// they are the differences of the soundings (central inside, one-sided at the rim), interpolated bilinearly and constant beyond the
// grid. The force of the bed is therefore continuous, and a line may rest in a valley along a grid line. On a plane both are the same.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "assembly/scene.hpp"
#include "assembly/small.hpp"

namespace hawser {

/// The bed below (or above) a place. Index 0: x, 1: y.
template <class S>
struct SurfacePoint {
  S height;                // m
  S slope[2];              // p, q
  double gradient[2];      // derivatives of the height
  double curvature[2][2];  // derivatives of slope[i] with x, y
};

class SeabedSurface {
 public:
  SeabedSurface() = default;
  explicit SeabedSurface(double z) : highest_(z) {}
  explicit SeabedSurface(const BathymetryGrid& grid);

  bool level() const { return grid_.z.empty(); }
  double highest() const { return highest_; }  // m, of the soundings

  /// S: double, or an automatic-differentiation number (the derivatives in the result are those at its value).
  template <class S>
  SurfacePoint<S> at(const S& x, const S& y) const;

  double height(double x, double y) const { return level() ? highest_ : at(x, y).height; }

  /// No part of the bed within this rectangle is higher.
  double highest_within(double x0, double x1, double y0, double y1) const;

  /// The line of the grid between two places on an axis (0: x, 1: y), where the height has a kink: the one next to `from`, if there is any.
  std::optional<double> grid_line(int axis, double from, double to) const;

 private:
  struct Corner {
    double z, p, q;
  };
  Corner corner(std::size_t i, std::size_t j) const;
  static std::size_t cell(const std::vector<double>& rows, double at);

  BathymetryGrid grid_;
  std::vector<double> p_, q_;  // slopes at the soundings
  double highest_ = 0.0;
};

inline double value_of(double x) { return x; }
template <class S>
double value_of(const S& x) {
  return x.v;
}

template <class S>
SurfacePoint<S> SeabedSurface::at(const S& x, const S& y) const {
  if (level()) return {S(highest_), {S(0.0), S(0.0)}, {0.0, 0.0}, {{0.0, 0.0}, {0.0, 0.0}}};
  const std::size_t i = cell(grid_.x, value_of(x)), j = cell(grid_.y, value_of(y));
  const double dx = grid_.x[i + 1] - grid_.x[i], dy = grid_.y[j + 1] - grid_.y[j];
  const S u = (x - S(grid_.x[i])) / S(dx), v = (y - S(grid_.y[j])) / S(dy);
  const S uc = minimum(maximum(u, S(0.0)), S(1.0)), vc = minimum(maximum(v, S(0.0)), S(1.0));
  const Corner c[2][2] = {{corner(i, j), corner(i, j + 1)}, {corner(i + 1, j), corner(i + 1, j + 1)}};
  const auto between = [&](double Corner::*k, const S& a, const S& b) {
    return (S(1.0) - a) * ((S(1.0) - b) * S(c[0][0].*k) + b * S(c[0][1].*k)) + a * ((S(1.0) - b) * S(c[1][0].*k) + b * S(c[1][1].*k));
  };
  const auto along_x = [&](double Corner::*k, double b) { return ((1.0 - b) * (c[1][0].*k - c[0][0].*k) + b * (c[1][1].*k - c[0][1].*k)) / dx; };
  const auto along_y = [&](double Corner::*k, double a) { return ((1.0 - a) * (c[0][1].*k - c[0][0].*k) + a * (c[1][1].*k - c[1][0].*k)) / dy; };
  const double a = value_of(uc), b = value_of(vc);
  const double in_x = value_of(u) == a ? 1.0 : 0.0, in_y = value_of(v) == b ? 1.0 : 0.0;  // the normal is constant beyond the grid
  return {between(&Corner::z, u, v),
          {between(&Corner::p, uc, vc), between(&Corner::q, uc, vc)},
          {along_x(&Corner::z, value_of(v)), along_y(&Corner::z, value_of(u))},
          {{in_x * along_x(&Corner::p, b), in_y * along_y(&Corner::p, a)}, {in_x * along_x(&Corner::q, b), in_y * along_y(&Corner::q, a)}}};
}

}  // namespace hawser
