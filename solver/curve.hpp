// StaticCurve: static equilibria while one parameter p of a scene varies, each started from those before it.
//
// The first guess is the polynomial through the last m <= 4 equilibria of the same mesh, at the new p (Lagrange; m = 1: the last one):
//
//   q0(p) = sum_j w_j q_j,   w_j = prod_{k != j} (p - p_k)/(p_j - p_k),
//
// whose error is of order (step in p)^m. The held ends then go where p has them, the lines with them (solver/model_branch.hpp).
// A first guess that does not lead to a stable equilibrium within a few factorizations is given up for a cold start: a curve
// never ends where a single static would not.
//
// With the means to make a model at any p the curve stays on its branch. Where the warm start failed, ended far from its first guess or moved much
// more than the step before, the new equilibrium must show that it is joined to the last one: the tangents dq/dp at both are alike and fit the chord.
// If not, the branch is followed in its arclength (solver/continuation.hpp) from the last equilibrium to p, past its folds; what it meets on the way
// is reported. Where it does not lead to a stable equilibrium at p, the answer belongs to another branch.
#pragma once

#include <deque>
#include <vector>

#include "solver/model_branch.hpp"
#include "solver/statics.hpp"

namespace hawser {

/// A point of the branch that was passed on the way: a fold, a bifurcation, or an equilibrium at one of the values.
struct PassedPoint {
  double p = 0.0;
  bool fold = false, bifurcation = false;
  bool stable = false;  // in a flow every push dies away (stability.hpp), else no negative pivot; false at a fold or bifurcation
  int negative_pivots = 0;
  int iterations = 0;     // factorizations since the point before
  double residual = 0.0;  // relative to the reference force
  State state;
};

struct CurveReport {
  StaticReport statics;             // iterations and stages: of all that was tried at p
  bool warm = false;                // found from the equilibria before it
  int branch = 0;                   // number of the branch, from 1: equal where the way is known; 0 where there is no equilibrium
  std::vector<PassedPoint> passed;  // between the equilibrium before it and this one, in their order on the branch
};

/// How a curve may follow a branch: a model at any p, and the values that are asked for, ascending or descending.
struct CurveWay {
  ModelAt model_at;
  std::vector<double> values;
};

class StaticCurve {
 public:
  StaticCurve() = default;
  explicit StaticCurve(CurveWay way);

  /// As solve_static, at the parameter p (different from those before). `options.start`, and `state` where that is `given`, are
  /// the cold start: used where no equilibrium of this mesh is known yet, and where the branch does not lead to p.
  CurveReport next(const Assembler& assembler, double p, const StaticOptions& options, State& state);

 private:
  struct Known {
    double p;
    std::vector<double> q;
  };

  State predicted(const Model& model, double p) const;
  bool warm_start(const Assembler& assembler, double p, const StaticOptions& options, State& found, CurveReport& report) const;
  bool gives_way(const Model& model, const State& state, StaticReport& statics) const;
  bool joined(ModelBranch& branch, double p, const State& found, StaticReport& statics) const;
  ContinuationOptions options_to(double p, const Model& model, const ModelBranch& branch, const std::vector<double>* answer) const;
  bool follow(ModelBranch& branch, const Assembler& assembler, double p, const StaticOptions& options, State& state, CurveReport& report);
  bool cross_over(ModelBranch& branch, const BranchPoint& bifurcation, double p, State& state, CurveReport& report) const;
  void answer_with(ModelBranch& branch, const BranchPoint& end, bool stable, State& state, CurveReport& report) const;
  void keep_last(const ContinuationReport& way);
  bool off_the_branch(const Model& model, const State& guess, const State& found, double p) const;

  CurveWay way_;
  std::vector<int> layout_;  // of the states in known_
  std::deque<Known> known_;  // on one branch, oldest first
  bool ended_ = false;       // followed from the last of them in vain: once is enough
  int branches_ = 0;         // met so far
  bool stable_ = true;       // the last of them
};

}  // namespace hawser
