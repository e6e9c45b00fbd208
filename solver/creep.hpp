// Creep: the line sinks to rest in a medium that resists every motion (pseudo-transient continuation).
//
//   c M q' = -R(q),    by implicit Euler:    R(q) + c_n M (q - q_n) = 0 for q = q_(n+1),    c_n = 1/h_n
//
// M: a unit mass per unstretched length, c [N/m^2]: force per metre of line and metre of a step. Each step is a Newton from q_n, a problem as well
// posed as c is large. c falls where that was easy and rises where it failed; towards rest the steps become those of Newton. Nothing needs an energy:
// drag and friction without a potential drive the motion as they are. What attracts it is stable with all loads (slowest_decay, stability.hpp).
//
// A step is solved when its residual is a tenth of what it began with, or its corrections are a twentieth of its way: an error along the way is made
// up by the next steps, while the residual of a line that hardly stretches says little about the place of its nodes. A step that is long beside the
// growth of an instability may end on a saddle as any Newton may: what is found must be certified. (C. T. Kelley, D. E. Keyes, SIAM J. Numer. Anal.
// 35 (1998) 508; here c follows Newton's iterations, not the residual.)
#pragma once

#include "solver/newton.hpp"

namespace hawser {

/// A system whose motion can be resisted.
class CreepingSystem : public NewtonSystem {
 public:
  /// From here on R holds c M (q - q_n) too, q_n the present point.
  virtual void resist(double c) = 0;

  /// Back to the last q_n.
  virtual void go_back() = 0;
};

struct CreepOptions {
  double length = 1.0;      // m, of the step cap
  double resistance = 1.0;  // N/m^2, c of the first step
  double enough = 1e4;      // tolerances of the system: a residual at which it ends
  int max_iterations = 1000;
};

/// `converged` where the residual without resistance fell below `enough`. The system is left without resistance.
NewtonReport creep(CreepingSystem& system, const CreepOptions& options);

}  // namespace hawser
