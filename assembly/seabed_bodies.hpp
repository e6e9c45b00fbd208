// seabed_bodies: contact of concentrated bodies with the seabed: points where lines meet, free ends, clumps.
//
//   R_r -= lambda f,      lambda = P/max(w, N(d/10)),      P = W + max(0, -F_z(0))
//
// f: force of the bed per length of line at the node (contact_force, seabed_law.hpp), N its pressure, W: wet weight of the body, F its force; w and
// d: the heaviest and the thickest of the line around it (at a point of every line that ends there). A scene knows neither the size nor the shape of
// a body, and the stiffness of a bed is one per length of line, chosen so that a line sinks about a tenth of its diameter (theory 5.4). So the bed
// takes a body for lambda metres of line in one place: what rests on its own sinks as deep as the line that lies around it, N(g) = w, and where that
// line weighs nothing, by a tenth of its diameter. A body that nothing presses down, or on a line without weight and thickness, does not feel the
// bed. Friction counts from where the line was laid, with the lateral coefficient in all directions. A point has such a place where one of its lines
// was laid, and only one: two would not agree on it.
#pragma once

#include <span>

#include "assembly/added_blocks.hpp"
#include "assembly/model.hpp"

namespace hawser {

void add_seabed_to_bodies(const Model& model, const State& state, std::span<double> r);
/// secant: the tangent of friction is positive (a floored tangent).
void add_seabed_to_bodies(const Model& model, const State& state, std::span<double> r, const TangentWeights& weights, bool secant,
                          AddedBlocks blocks);

/// Force of the bed on a body [N].
Vec3 seabed_force(const Model& model, const State& state, const Body& body);

/// The vertical part of it, of all bodies between the ends of a line.
double lift_of_bodies(const Model& model, const State& state, int line);

/// Energy of its normal part [J].
double seabed_energy(const Model& model, const State& state, const Body& body);

}  // namespace hawser
