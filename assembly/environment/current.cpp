#include <algorithm>
#include <cmath>

#include "assembly/model.hpp"

namespace hawser {

Vec3 Current::at(double depth_z) const {
  if (z.empty()) return Vec3::Zero();
  const auto above = std::upper_bound(z.begin(), z.end(), depth_z);
  if (above == z.begin()) return {ux.front(), uy.front(), 0.0};
  if (above == z.end()) return {ux.back(), uy.back(), 0.0};
  const std::size_t k = above - z.begin() - 1;
  const double f = (depth_z - z[k]) / (z[k + 1] - z[k]);
  return {ux[k] + f * (ux[k + 1] - ux[k]), uy[k] + f * (uy[k + 1] - uy[k]), 0.0};
}

double Current::fastest() const {
  double speed = 0.0;
  for (std::size_t k = 0; k < z.size(); ++k) speed = std::max(speed, std::hypot(ux[k], uy[k]));
  return speed;
}

}  // namespace hawser
