// Static equilibrium by KINSOL (SUNDIALS): an independent Newton behind the contract of solver/statics.hpp.
//
//   R(q) = 0,   q <- q + a d,   T d = -R,   a by KINSOL's line search on ||D_F R||, then a = 1
//
// Residual, tangent and the solver of T are ours, globalisation and stopping are KINSOL's. D_F turns residuals into forces and
// D_u increments into fractions of the longest line L (solver/norms.hpp): D_F = 1 and D_u = 1/L for r, D_F = 1/l and D_u = l/L for r',
// l = Model::node_length. A step moves the nodes by a tenth of L at most, in the mean. It stops at the tolerance of solver/README.md; a residual that
// stands still within the rounding of the coordinates counts as converged too, and the report says how large it is.
// A. Hindmarsh et al., SUNDIALS, ACM Trans. Math. Softw. 31 (2005) 363.
#pragma once

#include "solver/statics.hpp"

namespace hawser {

/// As solve_static, with its own stages: the start with line search, then without; where that was another one, the catenary likewise. The certificate
/// is the same: an unstable equilibrium is not converged. `linear_solver` must take unsymmetric matrices where the model has drag or friction.
StaticReport solve_static_kinsol(const Assembler& assembler, const StaticOptions& options, State& state);

}  // namespace hawser
