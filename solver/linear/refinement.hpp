// refinement: one step of iterative refinement with the factors at hand, A being the matrix that was factorized.
//
//   r = b - A x,   A d = r,   x <- x + d
//   omega(x) = max_i |b - A x|_i / (|A| |x| + |b|)_i      the least relative change of every entry of A and b for which x is exact
//                                                         (Oettli & Prager 1964), 0/0 = 0
//
// One step in working precision brings omega down to a few units of roundoff where elimination lost digits but the condition of A allows it
// (Skeel 1980; Higham, Accuracy and Stability of Numerical Algorithms, 2nd ed., section 12.2). Elimination of a well-posed tangent is there without
// it. A step costs one product with A and |A| and one solve, some four tenths of factorize and solve, and the judgement of what came of it another
// product.
#pragma once

#include <span>
#include <vector>

#include "solver/linear/linear_solver.hpp"

namespace hawser {

/// omega(x), see above; every row counts for itself, no large one hides a small one.
double backward_error(const BlockTridiagonal& matrix, std::span<const double> x, std::span<const double> b);

class Refinement {
 public:
  /// Takes the memory that a step needs.
  explicit Refinement(const BlockTridiagonal& pattern);

  struct BackwardErrors {
    double before = 0.0, after = 0.0;  // omega
  };

  /// `factorized` holds factors of `matrix`, x = A^-1 b by it. A step that does not lower omega is not taken: after <= before.
  BackwardErrors improve(const BlockTridiagonal& matrix, LinearSolver& factorized, std::span<const double> b, std::span<double> x);

 private:
  std::vector<double> residual_, size_, improved_;
};

}  // namespace hawser
