// symmetry: where the tangent of statics, TangentWeights {1, 0, 0}, is known to be symmetric.
//
// It is the second derivative of an energy where every load has one: axial force, bending, weight, dead forces, a level bed. A floor of the tension
// and the Gauss-Newton part of bending (TangentFloor) keep that. These have none:
//   - drag where water moves past the line: it turns with the line;
//   - a moment, which turns the line about an axis of its own;
//   - friction on the bed, which depends on the normal force; the normal force over soundings (seabed_law.hpp);
//   - drag, added mass and damping of a state that moves.
// Symmetric is: to rounding. What is not known is `unknown`, never `symmetric`.
#pragma once

#include "assembly/model.hpp"

namespace hawser {

/// Of every state with the velocities and accelerations of this one.
Symmetry static_symmetry(const Model& model, const State& state);

}  // namespace hawser
