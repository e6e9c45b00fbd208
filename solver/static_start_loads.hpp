// Loads of one line at rest or in a steady tow, t = 0, for the first guesses of a static shape.
//
//   density q = weight + drag [N/m of unstretched length],   drag as in theory 5.1 with w = current(z) - tow:
//   1/2 rho Cdn d |w_n| w_n + 1/2 rho Cdt pi d |w_t| w_t
#pragma once

#include <vector>

#include "assembly/model.hpp"

namespace hawser {

/// Drag on an element with this direction (either sign) at height z.
Vec3 drag_density(const Model& model, int element, const Vec3& tangent, double z);

/// Force of a body of the line at height z: wet weight, applied force, drag.
Vec3 body_force(const Model& model, const Body& body, double z);

struct LineLoads {
  std::vector<Vec3> density;  // N/m, per element of the line
  std::vector<Vec3> point;    // N, per node of the line
  Vec3 total(const Model& model, const Line& line) const;
};

/// Weight, spread loads and bodies, but those of points where lines meet; the bodies' drag at height z.
LineLoads dry_loads(const Model& model, int line, double z);

/// Upper estimate of the whole load on a line [N]: |weight| + |drag across the line| + |bodies|, in the fastest flow.
double load_scale(const Model& model, int line);

/// The scale of forces: the largest load of a line, or where nothing loads them what buckles one between clamps, (2 pi/L)^2 EI.
double largest_load(const Model& model);

}  // namespace hawser
