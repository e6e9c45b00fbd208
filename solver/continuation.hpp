// Pseudo-arclength continuation: points on a branch of R(q, p) = 0, also where it turns back in p (a fold).
//
// The branch is followed in its arclength s, with q' = dq/ds, p' = dp/ds and <., .> a weighted product of motions,
//
//   predictor   (q, p) + h (q', p')
//   corrector   R(q, p) = 0,   <q', q - q0> + m p' (p - p0) = 0,      (q0, p0) the predicted point,
//   unit        <q', q'> + m p'^2 = 1,      m: a unit of p weighs like the motion it causes on the whole.
//
// Newton on both needs [T R_p; q' m p']. The tangent T is singular at a fold, the bordered matrix is not. The textbook's block
// elimination solves with T alone; near a fold it loses the digits that T loses. Here a spring k on one unknown j stiffens T first,
//
//   K = T + k e_j e_j^T,      K a = -R,   K b = -R_p,   K c = k e_j,
//   d = a + b dp + c y,       y = d_j,                                          (y undoes the spring: T d = -R - R_p dp, exactly)
//
// and two equations remain for dp and y: the constraint and (c_j - 1) y + b_j dp = -a_j. j is the unknown that moves most along the branch and
// k its diagonal entry of T: the null vector of T at a fold is q', so a spring on its largest entry makes K as regular as T is elsewhere.
// K keeps the pattern of T: one factorization and three solves with the chain solver. What is prescribed and moves with p (an end of a
// line) moves by a shift s(p); R_p is the derivative of R along the shift, and the motion with p is b + s'.
//
// The step grows and shrinks with the iterations of the corrector and with the angle between tangents. A fold, p' = 0, is found between two points
// of opposite p' by Hermite interpolation in s, corrected until p' vanishes: p is then exact to second order in what is left of p'.
// Where the number of negative pivots changes between two points without a fold, another branch crosses (a bifurcation): the place is found by
// bisection between them, because the bordered matrix is singular there too. The branch that crosses is met at a distance h along the mode phi whose
// stiffness vanishes there:
//   R(q, p) = 0,   <phi, q - q0> = h,      (q0, p0) the bifurcation.
//
// E. Allgower, K. Georg, Introduction to Numerical Continuation Methods, 1990; T. Chan, SIAM J. Numer. Anal. 21 (1984) 738 (deflation).
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace hawser {

constexpr std::size_t no_spring = std::numeric_limits<std::size_t>::max();

/// Scaled residual of a point; below which it counts as solved; what rounding may hold up; what it is compared with in reports.
struct BranchResidual {
  double value = 0.0, wanted = 0.0, rounding = 0.0, reference = 1.0;
};

/// The solutions of one factorization, in the unknowns q; `spring` is zero without one.
struct BranchResponse {
  std::vector<double> residual, parameter, spring;  // a, b, c
  std::vector<double> shift;                        // s'
};

/// What continuation asks of a problem.
class BranchSystem {
 public:
  virtual ~BranchSystem() = default;

  /// Goes to p and shifts what p prescribes in q; false: there is no problem at p.
  virtual bool move_to(double p, std::vector<double>& q) = 0;

  // All that follows at the p of the last move_to.
  virtual BranchResidual residual(std::span<const double> q) = 0;
  virtual bool respond(std::span<const double> q, std::size_t spring, BranchResponse& response) = 0;
  virtual int negative_pivots(std::span<const double> q) = 0;

  /// <a, b>, of motions; a motion of size 1 is a large one.
  virtual double product(std::span<const double> a, std::span<const double> b) const = 0;

  /// The free unknown that moves most in a motion.
  virtual std::size_t strongest(std::span<const double> motion) const = 0;
};

struct BranchPoint {
  enum class Kind { step, stop, fold, bifurcation };
  Kind kind = Kind::step;
  double p = 0.0;
  std::vector<double> q;
  std::vector<double> q_rate;  // q'
  double p_rate = 0.0;         // p'
  int negative_pivots = 0;     // of the system; at a fold one is about to change its sign, at a bifurcation one or more
  double residual = 0.0;       // of the reference
  int factorizations = 0;      // since the point before
};

struct ContinuationOptions {
  std::vector<double> stops;           // values of p at which points are wanted, ascending; the branch is followed between the first and the last
  double target = 0.0;                 // it ends where p passes this, on the way on which it set out
  double first_step = 1.0;             // in p
  double motion_by_p = 0.0;            // sqrt(m), from what is known of the branch already; 0: |dq/dp| where it is entered (too much next to a fold)
  int most_steps = 400;                // in all, and
  int steps_to_fold = 40;              // as long as no fold was met
  bool folds_change_stability = true;  // there is a potential: at a fold the number of negative pivots changes, and elsewhere only at a bifurcation
};

enum class ContinuationEnd {
  reached,     // the target; the last point is there
  left_range,  // p passed the first or the last stop
  stuck,       // no step is short enough: the branch ends, or is not smooth
  too_long,
  not_unique,  // it turned back where no direction gained or lost stability: a continuum of solutions, no fold
};

struct ContinuationReport {
  ContinuationEnd end = ContinuationEnd::stuck;
  std::vector<BranchPoint> points;  // in the order of s, without the first
  int folds = 0, bifurcations = 0, factorizations = 0;
};

/// Follows the branch from its point (q, p) towards the target.
ContinuationReport follow_branch(BranchSystem& system, double p, std::vector<double> q, const ContinuationOptions& options);

/// A point of the branch that crosses this one at a bifurcation, at the distance `size` along the mode (of any length); nothing where none is found.
std::optional<BranchPoint> cross_branch(BranchSystem& system, const BranchPoint& bifurcation, std::span<const double> mode, double size,
                                        int& factorizations);

}  // namespace hawser
