#include "solver/continuation.hpp"

#include <algorithm>
#include <cmath>

#include "solver/newton.hpp"

namespace hawser {
namespace {

constexpr int most_corrections = 8;
constexpr int wanted_corrections = 4;      // the step is chosen for these
constexpr double least_step = 1e-5;        // of the first one
constexpr double most_step = 64.0;         // of the first one
constexpr double least_cosine = 0.85;      // between the tangents of two points
constexpr double increment_small = 1e-7;   // of a last correction, in the norm of motions
constexpr double fold_rate = 1e-7;         // p' at a fold, of the p' along which the branch was entered
constexpr int most_fold_corrections = 12;  // points tried for one fold
constexpr int bifurcation_halvings = 24;   // of a step; to 1e-7 of it
constexpr double correction_limit = 0.5;   // of the step: a corrector that goes further is on its way to another branch
constexpr double stop_tolerance = 1e-9;    // relative to the spacing of stops: p is there already

using Vector = std::vector<double>;

void add(Vector& q, double factor, std::span<const double> d) {
  for (std::size_t i = 0; i < q.size(); ++i) q[i] += factor * d[i];
}

/// The last equation of the bordered system: <q, dq> + p dp = right.
struct Constraint {
  Vector q;
  double p = 0.0;
};

/// One following of a branch.
class Follower {
 public:
  Follower(BranchSystem& system, const ContinuationOptions& options) : system_(system), options_(options) {}

  ContinuationReport run(double p, Vector q);
  bool cross(BranchPoint& point, std::span<const double> mode, double size);
  int factorizations() const { return report_.factorizations; }

 private:
  struct Step {
    double dp = 0.0;
    Vector dq;
  };

  bool enter(BranchPoint& start);
  bool advance(const BranchPoint& from, double h, BranchPoint& to);
  bool correct(const Constraint& constraint, BranchPoint& point, double reach);
  bool turn_tangent(BranchPoint& point, const Constraint& along);
  Step solve_bordered(const Constraint& constraint, bool with_residual, double right) const;

  double norm(std::span<const double> dq, double dp) const { return std::sqrt(system_.product(dq, dq) + mass_ * dp * dp); }
  double distance(const BranchPoint& a, const BranchPoint& b) const;
  Constraint tangent_of(const BranchPoint& point) const { return {point.q_rate, mass_ * point.p_rate}; }
  BranchPoint between(const BranchPoint& a, const BranchPoint& b, double h, double x) const;
  bool find_fold(BranchPoint a, BranchPoint b, BranchPoint& fold);
  bool find_bifurcation(const BranchPoint& a, const BranchPoint& b, BranchPoint& found);
  bool take_stops(const BranchPoint& a, const BranchPoint& b);
  bool record(const BranchPoint& a, const BranchPoint& b);
  void keep(BranchPoint point, BranchPoint::Kind kind);

  BranchSystem& system_;
  const ContinuationOptions& options_;
  ContinuationReport report_;
  BranchResponse response_;
  std::size_t spring_ = no_spring;
  double mass_ = 1.0;        // m
  double direction_ = 1.0;   // of p towards the target
  double entry_rate_ = 1.0;  // |p'| where the branch was entered
  double spacing_ = 1.0;     // of the stops
  int corrections_ = 0;      // of the last corrector
  int counted_ = 0;          // factorizations that a point already carries
  bool reached_ = false;
};

Follower::Step Follower::solve_bordered(const Constraint& constraint, bool with_residual, double right) const {
  Vector motion = response_.parameter;  // with p
  add(motion, 1.0, response_.shift);
  const bool sprung = spring_ != no_spring;
  const double a_row = with_residual ? system_.product(constraint.q, response_.residual) : 0.0;
  const double a_j = with_residual && sprung ? response_.residual[spring_] : 0.0;
  const double b_j = sprung ? response_.parameter[spring_] : 0.0, c_j = sprung ? response_.spring[spring_] : 0.0;
  const double along_p = system_.product(constraint.q, motion) + constraint.p, along_y = system_.product(constraint.q, response_.spring);
  const double determinant = along_p * (c_j - 1.0) - along_y * b_j;
  Step step;
  step.dp = ((right - a_row) * (c_j - 1.0) + along_y * a_j) / determinant;
  const double y = (-along_p * a_j - (right - a_row) * b_j) / determinant;
  step.dq.assign(motion.size(), 0.0);
  if (with_residual) step.dq = response_.residual;
  add(step.dq, step.dp, motion);
  add(step.dq, y, response_.spring);
  return step;
}

/// Newton on R = 0 and the constraint, which the point given satisfies. `reach`: how far corrections may go.
bool Follower::correct(const Constraint& constraint, BranchPoint& point, double reach) {
  const Vector q0 = point.q;
  const double p0 = point.p;
  double last = HUGE_VAL;
  for (corrections_ = 0; corrections_ <= most_corrections; ++corrections_) {
    if (!system_.move_to(point.p, point.q)) return false;
    const BranchResidual residual = system_.residual(point.q);
    point.residual = residual.reference > 0.0 ? residual.value / residual.reference : residual.value;
    if (!std::isfinite(residual.value)) return false;
    const bool solved =
        residual.value <= residual.wanted || (corrections_ >= wanted_corrections && residual.value <= rounding_margin * residual.rounding);
    if (solved && last <= increment_small) return true;
    ++report_.factorizations;
    if (corrections_ == most_corrections || !system_.respond(point.q, spring_, response_)) return false;
    Vector gone = point.q;
    add(gone, -1.0, q0);
    const double left = -(system_.product(constraint.q, gone) + constraint.p * (point.p - p0));
    Step step = solve_bordered(constraint, true, left);
    last = norm(step.dq, step.dp);
    if (!(norm(gone, point.p - p0) + last <= reach)) return false;
    add(step.dq, -step.dp, response_.shift);  // move_to brings it
    add(point.q, 1.0, step.dq);
    point.p += step.dp;
  }
  return false;
}

/// The unit tangent at a solved point, on the side of `along`.
bool Follower::turn_tangent(BranchPoint& point, const Constraint& along) {
  ++report_.factorizations;
  if (!system_.move_to(point.p, point.q) || !system_.respond(point.q, spring_, response_)) return false;
  const Step step = solve_bordered(along, false, 1.0);
  const double size = norm(step.dq, step.dp);
  if (!std::isfinite(size) || size == 0.0) return false;
  point.p_rate = step.dp / size;
  point.q_rate.assign(point.q.size(), 0.0);
  add(point.q_rate, 1.0 / size, step.dq);
  return true;
}

/// The first tangent, by p; and with it what p weighs.
bool Follower::enter(BranchPoint& start) {
  ++report_.factorizations;
  if (!system_.move_to(start.p, start.q) || !system_.respond(start.q, no_spring, response_)) return false;
  Vector motion = response_.parameter;
  add(motion, 1.0, response_.shift);
  mass_ = options_.motion_by_p > 0.0 ? options_.motion_by_p * options_.motion_by_p : system_.product(motion, motion);
  if (!std::isfinite(mass_)) return false;
  if (mass_ == 0.0) mass_ = 1.0;
  const double size = norm(motion, 1.0);
  start.p_rate = direction_ / size;
  entry_rate_ = 1.0 / size;
  start.q_rate.assign(start.q.size(), 0.0);
  add(start.q_rate, start.p_rate, motion);
  spring_ = system_.strongest(start.q_rate);
  start.negative_pivots = system_.negative_pivots(start.q);
  return true;
}

bool Follower::advance(const BranchPoint& from, double h, BranchPoint& to) {
  to = from;
  add(to.q, h, from.q_rate);
  to.p += h * from.p_rate;
  spring_ = system_.strongest(from.q_rate);
  // The prediction moves what p prescribes as the tangent says; move_to puts it where p says.
  if (!system_.move_to(to.p, to.q) || !correct(tangent_of(from), to, correction_limit * h) || !turn_tangent(to, tangent_of(from))) return false;
  to.negative_pivots = system_.negative_pivots(to.q);
  return system_.product(from.q_rate, to.q_rate) + mass_ * from.p_rate * to.p_rate >= least_cosine;
}

double Follower::distance(const BranchPoint& a, const BranchPoint& b) const {
  Vector gone = b.q;
  add(gone, -1.0, a.q);
  return norm(gone, b.p - a.p);
}

/// Cubic Hermite interpolation at x h, x in [0, 1].
BranchPoint Follower::between(const BranchPoint& a, const BranchPoint& b, double h, double x) const {
  const double value_b = x * x * (3.0 - 2.0 * x), value_a = 1.0 - value_b, rate_a = h * x * (1.0 - x) * (1.0 - x), rate_b = -h * x * x * (1.0 - x);
  const double slope = 6.0 * x * (1.0 - x) / h, turn_a = (1.0 - x) * (1.0 - 3.0 * x), turn_b = x * (3.0 * x - 2.0);
  BranchPoint point = a;
  point.p = value_a * a.p + value_b * b.p + rate_a * a.p_rate + rate_b * b.p_rate;
  point.p_rate = slope * (b.p - a.p) + turn_a * a.p_rate + turn_b * b.p_rate;
  for (std::size_t i = 0; i < a.q.size(); ++i) {
    point.q[i] = value_a * a.q[i] + value_b * b.q[i] + rate_a * a.q_rate[i] + rate_b * b.q_rate[i];
    point.q_rate[i] = slope * (b.q[i] - a.q[i]) + turn_a * a.q_rate[i] + turn_b * b.q_rate[i];
  }
  const double size = norm(point.q_rate, point.p_rate);
  for (double& rate : point.q_rate) rate /= size;
  point.p_rate /= size;
  return point;
}

/// The point of p' = 0 between a and b, whose p' differ in sign.
bool Follower::find_fold(BranchPoint a, BranchPoint b, BranchPoint& fold) {
  for (int tries = 0; tries < most_fold_corrections; ++tries) {
    const double h = distance(a, b);
    double low = 0.0, high = 1.0;
    for (int i = 0; i < 60; ++i) {
      const double x = 0.5 * (low + high);
      (std::signbit(between(a, b, h, x).p_rate) == std::signbit(a.p_rate) ? low : high) = x;
    }
    fold = between(a, b, h, 0.5 * (low + high));
    const Constraint along = tangent_of(fold);
    if (!correct(along, fold, correction_limit * h) || !turn_tangent(fold, along)) return false;
    if (std::abs(fold.p_rate) <= fold_rate * entry_rate_) return true;
    (std::signbit(fold.p_rate) == std::signbit(a.p_rate) ? a : b) = fold;
  }
  return true;
}

/// Where the number of negative pivots changes between a and b.
bool Follower::find_bifurcation(const BranchPoint& a, const BranchPoint& b, BranchPoint& found) {
  const double h = distance(a, b);
  double low = 0.0, high = 1.0;
  for (int i = 0; i < bifurcation_halvings; ++i) {
    const double x = 0.5 * (low + high);
    found = between(a, b, h, x);
    if (!correct(tangent_of(found), found, correction_limit * h)) return false;
    (system_.negative_pivots(found.q) == a.negative_pivots ? low : high) = x;
  }
  return true;
}

void Follower::keep(BranchPoint point, BranchPoint::Kind kind) {
  point.kind = kind;
  if (kind != BranchPoint::Kind::step && system_.move_to(point.p, point.q)) point.negative_pivots = system_.negative_pivots(point.q);
  point.factorizations = report_.factorizations - counted_;
  counted_ = report_.factorizations;
  report_.points.push_back(std::move(point));
}

/// Points at the stops that p passes from a to b, on a piece without a fold; the last one is the target where p passes it onwards.
bool Follower::take_stops(const BranchPoint& a, const BranchPoint& b) {
  std::vector<double> passed;
  const double early = stop_tolerance * spacing_;
  const bool up = b.p > a.p;
  for (const double stop : options_.stops) {
    if (up ? stop > a.p + early && stop <= b.p + early : stop < a.p - early && stop >= b.p - early) passed.push_back(stop);
  }
  if (!up) std::reverse(passed.begin(), passed.end());
  const double h = distance(a, b);
  for (const double stop : passed) {
    double low = 0.0, high = 1.0;
    for (int i = 0; i < 60; ++i) {
      const double x = 0.5 * (low + high);
      ((between(a, b, h, x).p < stop) == up ? low : high) = x;
    }
    BranchPoint point = between(a, b, h, 0.5 * (low + high));
    point.p = stop;
    const Constraint by_p{Vector(point.q.size(), 0.0), 1.0};
    const Constraint along = tangent_of(point);
    if (!correct(by_p, point, correction_limit * h) || !turn_tangent(point, along)) return false;
    point.p = stop;
    keep(std::move(point), BranchPoint::Kind::stop);
    if (up == (direction_ > 0.0) && std::abs(stop - options_.target) <= early) {
      reached_ = true;
      return true;
    }
  }
  return true;
}

/// What lies between two steps, and the second one; false where a point between them could not be solved.
bool Follower::record(const BranchPoint& a, const BranchPoint& b) {
  const bool turns = std::signbit(a.p_rate) != std::signbit(b.p_rate);
  const bool changes = options_.folds_change_stability && a.negative_pivots != b.negative_pivots;
  if (turns && options_.folds_change_stability && !changes) {
    report_.end = ContinuationEnd::not_unique;
    return true;
  }
  if (turns || changes) {
    BranchPoint special;
    if (!(turns ? find_fold(a, b, special) : find_bifurcation(a, b, special)) || !take_stops(a, special)) return false;
    if (reached_) return true;
    ++(turns ? report_.folds : report_.bifurcations);
    keep(special, turns ? BranchPoint::Kind::fold : BranchPoint::Kind::bifurcation);
    if (!take_stops(special, b)) return false;
  } else if (!take_stops(a, b)) {
    return false;
  }
  if (!reached_) keep(b, BranchPoint::Kind::step);
  return true;
}

ContinuationReport Follower::run(double p, Vector q) {
  direction_ = options_.target >= p ? 1.0 : -1.0;
  spacing_ = (options_.stops.back() - options_.stops.front()) / std::max<double>(1.0, static_cast<double>(options_.stops.size()) - 1.0);
  BranchPoint here;
  here.p = p;
  here.q = std::move(q);
  if (!enter(here)) return report_;
  const double first = options_.first_step / entry_rate_;
  double h = first;
  for (int steps = 0; steps < (report_.folds > 0 ? options_.most_steps : options_.steps_to_fold);) {
    BranchPoint next;
    const std::size_t kept = report_.points.size();
    const int folds = report_.folds, bifurcations = report_.bifurcations;
    const bool advanced = advance(here, h, next);
    const int corrections = corrections_;
    if (!advanced || !record(here, next)) {
      report_.points.resize(kept);  // what was taken on a step that did not hold is taken again
      report_.folds = folds;
      report_.bifurcations = bifurcations;
      h *= 0.5;
      if (h < least_step * first) return report_;
      continue;
    }
    ++steps;
    if (reached_) {
      report_.end = ContinuationEnd::reached;
      return report_;
    }
    if (report_.end == ContinuationEnd::not_unique) return report_;
    if (next.p < options_.stops.front() || next.p > options_.stops.back()) {
      report_.end = ContinuationEnd::left_range;
      return report_;
    }
    h = std::min(h * std::clamp(std::exp2(0.5 * (wanted_corrections - corrections)), 0.5, 2.0), most_step * first);
    here = std::move(next);
  }
  report_.end = ContinuationEnd::too_long;
  return report_;
}

/// From a bifurcation to the branch that crosses there.
bool Follower::cross(BranchPoint& point, std::span<const double> mode, double size) {
  mass_ = 0.0;  // p is free
  Constraint across{Vector(mode.begin(), mode.end()), 0.0};
  const double length = std::sqrt(system_.product(mode, mode));
  for (double& x : across.q) x /= length;
  spring_ = system_.strongest(across.q);
  add(point.q, size, across.q);
  return correct(across, point, correction_limit * size);
}

}  // namespace

ContinuationReport follow_branch(BranchSystem& system, double p, std::vector<double> q, const ContinuationOptions& options) {
  return Follower(system, options).run(p, std::move(q));
}

std::optional<BranchPoint> cross_branch(BranchSystem& system, const BranchPoint& bifurcation, std::span<const double> mode, double size,
                                        int& factorizations) {
  const ContinuationOptions options;
  Follower follower(system, options);
  BranchPoint point = bifurcation;
  point.kind = BranchPoint::Kind::step;
  const bool met = follower.cross(point, mode, size);
  factorizations = follower.factorizations();
  return met ? std::optional(std::move(point)) : std::nullopt;
}

}  // namespace hawser
