// The seabed of a model from its scene: surface, law, and where the lines were laid for static friction (theory 5.4).
#pragma once

#include <optional>

#include "assembly/model.hpp"

namespace hawser {

/// Absent where the scene has no seabed. Lines, points and elements of the model must stand.
std::optional<Seabed> make_seabed(const Scene& scene, const Model& model);

/// How much of the bed every body feels, and from where its friction counts (seabed_bodies.hpp).
void put_bodies_on_seabed(Model& model);

/// The bed of an environment; absent where it has none.
std::optional<SeabedSurface> seabed_surface(const Environment& environment);

/// An end not higher above the bed than this [m] lies on it: the line's diameter.
double grounding_height(double diameter, double length);

/// How far a place is above the bed [m].
double height_above(const SeabedSurface& bed, const Vec3& r);

}  // namespace hawser
