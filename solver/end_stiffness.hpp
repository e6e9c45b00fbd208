// End stiffness: how the force that holds an end of a line answers to a small motion of that end, the rest following in equilibrium.
//
//   K_end = K_ss - K_sf K_ff^-1 K_fs,     K = dR/dq at the equilibrium,  s: motions of the held end,  f: all that may move.
//
// Columns are unit displacements along x, y, z [m]; at a clamped end also unit rotations about x, y, z [rad] through the end, which
// turn the held direction: dr' = omega x r'. Rows are the force [N] and, at a clamped end, the moment M = r' x R_r' [N m] that the support
// must exert more. Units N/m, N, N, N m. Other held ends stay where they are, free points move; drag, seabed and friction answer as their tangents
// say.
// A line without torsion takes any rotation about its own tangent without a moment but M x omega (the moment turns with the end);
// K_end is symmetric where the loads have a potential and M = 0.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "assembly/model.hpp"
#include "assembly/state.hpp"

namespace hawser {

struct EndStiffness {
  int line = 0;
  bool at_from = true;    // the `from` end or the `to` end
  Eigen::MatrixXd value;  // 3 x 3; 6 x 6 at a clamped end; empty where the tangent is singular
};

/// One for every support of the model, in its order. `state` is an equilibrium.
std::vector<EndStiffness> end_stiffness(const Model& model, const State& state);

}  // namespace hawser
