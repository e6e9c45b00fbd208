// Where the free points at which lines meet are in the first guess of a static: the balance of the lines' end forces there.
//
//   sum over the ends at a hub of F(h) + load of the hub = 0,     Newton with  dF = -K dh,   K = C^-1,   C = int ( (I - t t^T)/T + I/EA ) ds
//
// Each line takes the shape of its own first guess between its ends (catenary, on the bed, marching from a free end). For dead loads the
// potential energy is a convex function of h (a catenary's force is the gradient of the Legendre transform of Psi, static_start_catenary.hpp): a
// step is shortened while the energy rises along it again, so that the iteration ends from any place. On the bed K is measured by differences.
#pragma once

#include <vector>

#include "assembly/model.hpp"

namespace hawser {

/// Position of every point at t = 0: of hubs the balanced one, of other points the one in the scene [m].
std::vector<Vec3> balanced_positions(const Model& model);

}  // namespace hawser
