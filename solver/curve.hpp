// StaticCurve: static equilibria while one parameter p of a scene varies, each started from those before it.
//
// The first guess is the polynomial through the last m <= 4 equilibria of the same mesh, at the new p (Lagrange; m = 1: the last one):
//
//   q0(p) = sum_j w_j q_j,   w_j = prod_{k != j} (p - p_k)/(p_j - p_k),
//
// whose error is of order (step in p)^m. What is then left of the way of a held end, u [m], is spread linearly along its line,
// r += u_from (1 - s/L) + u_to s/L and r' += (u_to - u_from)/L; a line with a free end is shifted.
// A first guess that does not lead to a stable equilibrium within a few factorizations is given up for a cold start: a curve
// never ends where a single static would not.
#pragma once

#include <deque>
#include <vector>

#include "solver/statics.hpp"

namespace hawser {

struct CurveReport {
  StaticReport statics;  // iterations and stages: of the warm and of the cold start together
  bool warm = false;     // found from the equilibria before it
};

class StaticCurve {
 public:
  /// As solve_static, at the parameter p (different from those before). `options.start`, and `state` where that is `given`, are
  /// the cold start: used where no equilibrium of this mesh is known yet, and where the warm start fails.
  CurveReport next(const Assembler& assembler, double p, const StaticOptions& options, State& state);

 private:
  struct Known {
    double p;
    std::vector<double> q;
  };

  State predicted(const Model& model, double p) const;

  std::vector<int> layout_;  // of the states in known_
  std::deque<Known> known_;  // on one branch, oldest first
};

}  // namespace hawser
