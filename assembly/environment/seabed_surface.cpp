#include "assembly/environment/seabed_surface.hpp"

#include <cassert>
#include <limits>

namespace hawser {
namespace {

/// Derivative at row k of values at these places: central, one-sided at both ends.
template <class Value>
double difference(const std::vector<double>& rows, std::size_t k, Value value) {
  const std::size_t a = k > 0 ? k - 1 : k, b = k + 1 < rows.size() ? k + 1 : k;
  return (value(b) - value(a)) / (rows[b] - rows[a]);
}

}  // namespace

SeabedSurface::SeabedSurface(const BathymetryGrid& grid) : grid_(grid) {
  const std::size_t nx = grid.x.size(), ny = grid.y.size();
  assert(nx >= 2 && ny >= 2 && grid.z.size() == nx * ny);
  for (std::size_t j = 0; j < ny; ++j)
    for (std::size_t i = 0; i < nx; ++i) {
      p_.push_back(difference(grid.x, i, [&](std::size_t k) { return grid.z[j * nx + k]; }));
      q_.push_back(difference(grid.y, j, [&](std::size_t k) { return grid.z[k * nx + i]; }));
    }
  highest_ = *std::max_element(grid.z.begin(), grid.z.end());
}

SeabedSurface::Corner SeabedSurface::corner(std::size_t i, std::size_t j) const {
  const std::size_t k = j * grid_.x.size() + i;
  return {grid_.z[k], p_[k], q_[k]};
}

std::size_t SeabedSurface::cell(const std::vector<double>& rows, double at) {
  const auto above = std::upper_bound(rows.begin() + 1, rows.end() - 1, at);
  return static_cast<std::size_t>(above - rows.begin()) - 1;
}

double SeabedSurface::highest_within(double x0, double x1, double y0, double y1) const {
  if (level()) return highest_;
  const std::size_t i0 = cell(grid_.x, x0), i1 = cell(grid_.x, x1), j0 = cell(grid_.y, y0), j1 = cell(grid_.y, y1);
  double highest = -std::numeric_limits<double>::infinity();
  // A bilinear height is greatest at a corner of the part of each cell that the rectangle covers; beyond the grid that corner lies outside.
  for (std::size_t j = j0; j <= j1; ++j)
    for (std::size_t i = i0; i <= i1; ++i)
      for (double x : {i == i0 ? x0 : grid_.x[i], i == i1 ? x1 : grid_.x[i + 1]})
        for (double y : {j == j0 ? y0 : grid_.y[j], j == j1 ? y1 : grid_.y[j + 1]}) highest = std::max(highest, height(x, y));
  return highest;
}

std::optional<double> SeabedSurface::grid_line(int axis, double from, double to) const {
  const std::vector<double>& rows = axis == 0 ? grid_.x : grid_.y;
  if (level()) return std::nullopt;
  const std::size_t a = cell(rows, from), b = cell(rows, to);
  if (a == b) return std::nullopt;
  return rows[a < b ? a + 1 : a];
}

}  // namespace hawser
