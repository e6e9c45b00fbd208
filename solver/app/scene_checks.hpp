// Rules that need more than one key: names that must exist, ends and loads that must fit, motions that must agree.
// Each fault is reported at the key that a user would change. Unreadable values are NaN and trip nothing here.
#pragma once

#include <string>

#include "assembly/scene.hpp"
#include "solver/app/toml_document.hpp"

namespace hawser {

/// Every check of a scene.
void check_scene(const Scene& scene, Document& document);

/// Names, ends, sections, loads, stations and start files (scene_checks.cpp).
void check_structure(const Scene& scene, Document& document);

/// Lines joined at points: that something holds them, and that held points are not too far apart for the lines between (scene_network_checks.cpp).
void check_network(const Scene& scene, Document& document);

/// Positions and motions: strain at t = 0, straight starts, towing, ends and the seabed (scene_motion_checks.cpp).
void check_motion(const Scene& scene, Document& document);

/// Null where no such name exists.
const PointSpec* find_point(const Scene& scene, const std::string& name);
const LineType* find_line_type(const Scene& scene, const std::string& name);

/// Between held points at t = 0 a line, or lines joined at free points, may stretch by so much.
inline constexpr double largest_strain = 0.5;

/// Position [m] at t = 0; NaN where it is not known.
Vec3 place_at_start(const PointSpec& point);

/// Unstretched length [m]; NaN where a section has none.
double length_of(const LineSpec& line);

}  // namespace hawser
