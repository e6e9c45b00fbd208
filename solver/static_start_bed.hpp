// Static shape of a line that rests on the seabed somewhere: suspended from its held ends, laid between them.
//
// In the vertical plane of the ends, with vertical loads only. H is the horizontal tension, a the suspended length at an end and h the
// height of that end above the bed where the line touches down. The suspended part starts level (V = 0) at the touchdown:
//   rise(a, H) = h   gives a,      x_from(H) + x_to(H) + (1 + T/EA) (length on the bed) = X   gives H,
// both monotone for a line that sinks: safeguarded one-dimensional roots, no first guess. On the bed the tension falls from the
// touchdown by friction, T = max(0, H - mu w s). A line longer than its way down and across (H -> 0) is laid in an arc.
#pragma once

#include <optional>

#include "solver/static_start_shape.hpp"

namespace hawser {

/// Nothing where the line cannot rest on the bed like this (a buoyant line, all of it suspended).
std::optional<LineShape> laid_shape(const Model& model, int line, const Vec3& from, const Vec3& to);

/// A place of the shape is below the bed by more than rounding of its length.
bool reaches_bed(const Model& model, const LineShape& shape);

/// Lifts what is below the bed onto it.
void lift_onto_bed(const Model& model, LineShape& shape);

}  // namespace hawser
