// State: positions, velocities and accelerations of every unknown at one time. A plain copyable struct.
//
// Layout of q, v, a (Model::unknowns() entries each): the chain unknowns node by node (bar: r; cable and beam: r, r'),
// then the inner unknowns that the assembler eliminates element by element (slope jumps, architecture rule 8).
// Units: r m, r' dimensionless, and the same per s and s^2.
#pragma once

#include <vector>

namespace hawser {

struct State {
  double t = 0.0;
  std::vector<double> q, v, a;
};

/// A tangent is stiffness*dR/dq + damping*dR/dv + mass*dR/da. Statics {1,0,0}, mass matrix {0,0,1}, generalized-alpha {1,gamma',beta'}.
struct TangentWeights {
  double stiffness = 1.0;
  double damping = 0.0;
  double mass = 0.0;

  bool operator==(const TangentWeights&) const = default;
};

/// Globalisation of the tangent (theory 7.2); the residual never changes.
struct TangentFloor {
  double tension = 0.0;       // N: least tension used in the geometric stiffness; 0 with use = false: exact matrix
  bool use_minimum = false;   // keep Model::minimum_tension of each element where the tension itself vanishes
  bool gauss_newton = false;  // bending by its positive semidefinite part

  bool operator==(const TangentFloor&) const = default;
};

}  // namespace hawser
