// Dynamic relaxation: the static residual set in motion, with the floored tangent as its mass and kinetic damping.
//
//   K_f v' = -R(q),   q' = v,   v = 0 whenever the residual begins to resist:  v . R > 0
//
// in steps of one: v <- v - K_f^-1 R, q <- q + v. With the tangent as the mass every stiff motion (stretching) has the frequency one and the
// soft ones are slower, so that steps of one are stable. A point that is in equilibrium but not stable is left at once, whatever holds the
// line or drives it: nothing here needs an energy. It ends far from an exact answer; Newton goes on from there.
// (Kinetic damping: P. A. Cundall 1976; M. R. Barnes, Int. J. Space Structures 14 (1999) 89.)
#pragma once

#include "solver/newton.hpp"

namespace hawser {

struct RelaxationOptions {
  double length = 1.0;  // m, of the step cap
  double floor = 0.0;   // N, T_f of the mass
  double enough = 1e4;  // tolerances of the system: a residual at which it ends
  int max_steps = 1000;
};

/// Steps are counted as factorizations; `converged` where the residual fell below `enough`.
NewtonReport relax(NewtonSystem& system, const RelaxationOptions& options);

}  // namespace hawser
