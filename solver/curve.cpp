#include "solver/curve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solver/norms.hpp"
#include "solver/stability.hpp"

namespace hawser {
namespace {

constexpr std::size_t most_known = 4;     // cubic: a higher degree follows the kinks of a touchdown no better
constexpr int warm_iterations = 15;       // factorizations; a guess that needs more is no better than a cold start
constexpr double difference_step = 1e-3;  // of the spacing of values: for dR/dp
constexpr double first_share = 0.25;      // of the way to p: the first step along a branch
constexpr double small_jump = 1e-4;       // of the length: nearer to the guess an equilibrium is on its branch
constexpr double large_miss = 0.5;        // of the way from the last equilibrium to the guess
constexpr double unlike = 3.0;            // ratio of two tangents, and
constexpr double like_cosine = 0.8;       // angle between them, and
constexpr double like_chord = 0.3;        // what the chord misses their mean by: beyond these two equilibria are not joined without a look
constexpr double first_crossing = 0.02;   // of the length, mean motion: how far along its mode a crossing branch is met, and
constexpr double least_crossing = 1e-4;   // how near to the bifurcation at least
constexpr double large_move = 2.5;        // of what the last step lets expect

/// Mean distance of the nodes of two states, of the longest line.
double mean_distance(const Model& model, std::span<const double> a, std::span<const double> b) {
  double sum = 0.0, longest = 0.0;
  for (int index = 0; index < static_cast<int>(model.lines.size()); ++index) {
    longest = std::max(longest, model.lines[index].length);
    for (int i = 0; i < model.lines[index].nodes; ++i) {
      const std::size_t r = model.dof(index, i);
      sum += (Eigen::Map<const Vec3>(&a[r]) - Eigen::Map<const Vec3>(&b[r])).squaredNorm();
    }
  }
  return std::sqrt(sum / model.total_nodes()) / longest;
}

double spacing(const std::vector<double>& values) {
  return (values.back() - values.front()) / std::max<double>(1.0, static_cast<double>(values.size()) - 1.0);
}

const char* describe(ContinuationEnd end) {
  switch (end) {
    case ContinuationEnd::reached:
      return "reached the value";
    case ContinuationEnd::left_range:
      return "turned back and left the range";
    case ContinuationEnd::stuck:
      return "could not be followed further";
    case ContinuationEnd::too_long:
      return "was given up after too many steps";
    case ContinuationEnd::not_unique:
      return "turned back without a change of stability: its states are not unique";
  }
  return "";
}

/// Whether a push dies away. Drag has no potential: in a flow the whole tangent decides, and the elastic one only where that is singular.
bool holds(const Model& model, const State& state, int negative_pivots, double reference_force) {
  if (!flows(model)) return negative_pivots == 0;
  const std::optional<double> decay = slowest_decay(model, state, reference_force / std::pow(longest_line(model), 2));
  return decay ? *decay > 0.0 : negative_pivots == 0;
}

/// Folds, bifurcations and the equilibria at the values, but the answer itself.
std::vector<PassedPoint> passed_points(ModelBranch& branch, const ContinuationReport& way, bool arrived) {
  using Kind = BranchPoint::Kind;
  std::vector<PassedPoint> passed;
  int iterations = 0;
  for (const BranchPoint& point : way.points) {
    iterations += point.factorizations;
    if (point.kind == Kind::step || (arrived && &point == &way.points.back())) continue;
    std::vector<double> q = point.q;
    if (!branch.move_to(point.p, q)) continue;
    PassedPoint& at = passed.emplace_back();
    at.p = point.p;
    at.fold = point.kind == Kind::fold;
    at.bifurcation = point.kind == Kind::bifurcation;
    at.state = branch.state_of(q);
    at.stable = point.kind == Kind::stop && holds(branch.model(), at.state, point.negative_pivots, branch.residual(q).reference);
    at.negative_pivots = point.negative_pivots;
    at.iterations = iterations;
    at.residual = point.residual;
    iterations = 0;
  }
  return passed;
}

}  // namespace

StaticCurve::StaticCurve(CurveWay way) : way_(std::move(way)) { std::sort(way_.values.begin(), way_.values.end()); }

State StaticCurve::predicted(const Model& model, double p) const {
  State state = static_start(model, StaticStart::straight);
  const State resting = state;  // or under tow: a static knows no other velocities of the supports
  state.q.assign(state.q.size(), 0.0);
  for (const Known& known : known_) {
    double weight = 1.0;
    for (const Known& other : known_)
      if (&other != &known) weight *= (p - other.p) / (known.p - other.p);
    for (std::size_t i = 0; i < state.q.size(); ++i) state.q[i] += weight * known.q[i];
  }
  follow_supports(model, state);
  state.v = resting.v;
  state.a = resting.a;
  return state;
}

/// The warm start may have jumped to another branch: it ended far from its guess, or moved much more than the step before.
bool StaticCurve::off_the_branch(const Model& model, const State& guess, const State& found, double p) const {
  const Known& last = known_.back();
  const double missed = mean_distance(model, guess.q, found.q);
  if (missed <= small_jump) return false;
  if (missed > large_miss * mean_distance(model, guess.q, last.q)) return true;
  if (known_.size() < 2) return false;
  const Known& before = known_[known_.size() - 2];
  const double expected = mean_distance(model, last.q, before.q) * std::abs((p - last.p) / (last.p - before.p));
  return mean_distance(model, found.q, last.q) > large_move * expected;
}

/// The stable equilibrium nearest to the prediction, in `found`; true if it is the one the branch leads to.
bool StaticCurve::warm_start(const Assembler& assembler, double p, const StaticOptions& options, State& found, CurveReport& report) const {
  StaticOptions warm = options;
  warm.start = StaticStart::given;
  warm.max_iterations = std::min(warm_iterations, options.max_iterations);
  const State guess = predicted(assembler.model(), p);
  found = guess;
  report.statics = solve_static(assembler, warm, found);
  return report.statics.converged && !(way_.model_at && off_the_branch(assembler.model(), guess, found, p));
}

/// Whether a state gives way (solver/model_branch.hpp), as what statics takes for stable may. Then it is no longer called stable.
bool StaticCurve::gives_way(const Model& model, const State& state, StaticReport& statics) const {
  if (!way_.model_at || flows(model) || statics.slowest_decay) return false;
  const int directions = directions_that_give_way(model, state, statics.reference_force);
  if (directions == 0) return false;
  statics.stable = false;
  statics.negative_pivots = directions;
  return true;
}

/// Two equilibria whose tangents dq/dp fit the chord between them lie on one smooth piece of a branch; next to a fold they do not.
bool StaticCurve::joined(ModelBranch& branch, double p, const State& found, StaticReport& statics) const {
  const Known& last = known_.back();
  const auto tangent = [&](double at, std::vector<double> q, std::vector<double>& rate) {
    BranchResponse response;
    ++statics.iterations;
    if (!branch.move_to(at, q) || !branch.respond(q, no_spring, response)) return false;
    rate = std::move(response.parameter);
    for (std::size_t i = 0; i < rate.size(); ++i) rate[i] += response.shift[i];
    return true;
  };
  std::vector<double> a, b, missed = found.q;
  if (!tangent(last.p, last.q, a) || !tangent(p, found.q, b)) return false;
  for (std::size_t i = 0; i < missed.size(); ++i) missed[i] -= last.q[i];
  const double chord = std::sqrt(branch.product(missed, missed));
  for (std::size_t i = 0; i < missed.size(); ++i) missed[i] -= 0.5 * (p - last.p) * (a[i] + b[i]);
  const double aa = branch.product(a, a), bb = branch.product(b, b), ab = branch.product(a, b);
  return ab >= like_cosine * std::sqrt(aa * bb) && std::max(aa, bb) <= unlike * unlike * std::min(aa, bb) &&
         std::sqrt(branch.product(missed, missed)) <= like_chord * chord;
}

ContinuationOptions StaticCurve::options_to(double p, const Model& model, const ModelBranch& branch, const std::vector<double>* answer) const {
  ContinuationOptions follow;
  follow.stops = way_.values;
  follow.target = p;
  follow.folds_change_stability = !flows(model);
  follow.first_step = first_share * std::abs(p - known_.back().p);
  // What the last step moved says how a unit of p weighs; at first what the next one would move.
  const bool second = known_.size() > 1;
  if (!second && !answer) return follow;
  const std::vector<double>& other = second ? known_[known_.size() - 2].q : *answer;
  const double step = second ? known_.back().p - known_[known_.size() - 2].p : p - known_.back().p;
  std::vector<double> motion = known_.back().q;
  for (std::size_t i = 0; i < motion.size(); ++i) motion[i] -= other[i];
  follow.motion_by_p = std::sqrt(branch.product(motion, motion)) / std::abs(step);
  return follow;
}

/// Makes an end of a branch at its model's p the answer.
void StaticCurve::answer_with(ModelBranch& branch, const BranchPoint& end, bool stable, State& state, CurveReport& report) const {
  std::vector<double> q = end.q;
  branch.move_to(end.p, q);
  const BranchResidual residual = branch.residual(q);
  state = branch.state_of(q);
  StaticReport& statics = report.statics;
  statics.converged = true;
  statics.stable = stable;
  statics.negative_pivots = end.negative_pivots;
  statics.residual_force = residual.value;
  statics.reference_force = residual.reference;
  statics.roundoff_floor = residual.rounding;
  statics.residual = end.residual;
  statics.failure = {};
  report.warm = true;
}

/// Follows the branch that crosses at a bifurcation, along its softest mode, to p; true where that leads to a stable equilibrium, now the answer.
bool StaticCurve::cross_over(ModelBranch& branch, const BranchPoint& bifurcation, double p, State& state, CurveReport& report) const {
  std::vector<double> q = bifurcation.q;
  if (!branch.move_to(bifurcation.p, q)) return false;
  const std::optional<StabilityMode> mode = softest_mode(branch.model(), branch.state_of(q), branch.residual(q).reference);
  if (!mode) return false;
  ContinuationOptions along;
  along.stops = way_.values;
  along.target = p;
  for (double size = first_crossing; size >= least_crossing; size *= 0.25) {
    along.motion_by_p = size / std::abs(p - bifurcation.p);
    int factorizations = 0;
    const std::optional<BranchPoint> start = cross_branch(branch, bifurcation, mode->shape, size, factorizations);
    report.statics.iterations += factorizations;
    const double gone = start ? (start->p - bifurcation.p) / (p - bifurcation.p) : 2.0;
    if (gone >= 1.0) continue;
    if (gone <= 0.0) return false;  // it sets out to the other side
    along.first_step = first_share * std::abs(p - start->p);
    const ContinuationReport way = follow_branch(branch, start->p, start->q, along);
    report.statics.iterations += way.factorizations;
    if (way.end != ContinuationEnd::reached || way.points.back().negative_pivots > 0) return false;
    answer_with(branch, way.points.back(), true, state, report);
    return true;
  }
  return false;
}

/// Follows the branch from the last equilibrium to p; true if it leads to a stable equilibrium there, which is then the answer. Where it lost its
/// stability in a bifurcation, the answer is on the branch that crosses there; and an unstable one where nothing stable is known.
bool StaticCurve::follow(ModelBranch& branch, const Assembler& assembler, double p, const StaticOptions& options, State& state, CurveReport& report) {
  const Model& model = assembler.model();
  StaticReport& statics = report.statics;
  const ContinuationOptions follow = options_to(p, model, branch, statics.converged ? &state.q : nullptr);
  const ContinuationReport way = follow_branch(branch, known_.back().p, known_.back().q, follow);
  statics.stages.push_back(fmt::format("along the branch: it {} after {} factorizations, {} folds and {} bifurcations", describe(way.end),
                                       way.factorizations, way.folds, way.bifurcations));
  if (options.log) options.log(statics.stages.back());

  const bool reached = way.end == ContinuationEnd::reached;
  bool stable = false, arrived = false;
  if (reached) {
    std::vector<double> q = way.points.back().q;
    branch.move_to(p, q);
    stable = holds(model, branch.state_of(q), way.points.back().negative_pivots, branch.residual(q).reference);
    const auto last =
        std::find_if(way.points.rbegin(), way.points.rend(), [](const BranchPoint& at) { return at.kind == BranchPoint::Kind::bifurcation; });
    const bool left = !stable && last != way.points.rend() && cross_over(branch, *last, p, state, report);
    arrived = stable || (!left && statics.converged && !statics.stable);
  }
  if (way.folds + way.bifurcations > 0) report.passed = passed_points(branch, way, arrived);
  statics.iterations += way.factorizations;
  for (const PassedPoint& point : report.passed) statics.iterations -= point.iterations;
  if (!arrived) return false;

  answer_with(branch, way.points.back(), stable, state, report);
  keep_last(way);
  return true;
}

/// What the next prediction uses: past a fold only the equilibria behind it, at the values alone; nearer points would predict from too little.
void StaticCurve::keep_last(const ContinuationReport& way) {
  for (const BranchPoint& point : way.points) {
    if (point.kind == BranchPoint::Kind::fold) known_.clear();
    const bool other = known_.empty() || known_.back().p != point.p;
    if (other && point.kind == BranchPoint::Kind::stop && &point != &way.points.back()) known_.push_back({point.p, point.q});
    if (known_.size() > most_known) known_.pop_front();
  }
}

CurveReport StaticCurve::next(const Assembler& assembler, double p, const StaticOptions& options, State& state) {
  const Model& model = assembler.model();
  std::vector<int> layout = layout_of(model);
  if (layout != layout_) known_.clear();
  layout_ = std::move(layout);

  CurveReport report;
  bool connected = false;
  if (!known_.empty()) {
    State found;
    connected = warm_start(assembler, p, options, found, report);
    report.warm = report.statics.converged;
    if (report.warm) state = std::move(found);
  }
  if (!report.warm) {
    const StaticReport tried = std::move(report.statics);
    report.statics = solve_static(assembler, options, state);
    report.statics.iterations += tried.iterations;
    report.statics.stages.insert(report.statics.stages.begin(), tried.stages.begin(), tried.stages.end());
  }
  const bool gave_way = report.statics.converged && gives_way(model, state, report.statics) && stable_;  // somewhere on the way
  if (gave_way) connected = false;
  if (!connected && way_.model_at && !known_.empty() && !ended_) {
    ModelBranch branch(way_.model_at, model, difference_step * spacing(way_.values), options);
    connected = report.statics.converged && !gave_way && joined(branch, p, state, report.statics);
    if (!connected) connected = follow(branch, assembler, p, options, state, report);
    ended_ = !connected;
  }
  if (!report.statics.converged) return report;
  if (!connected) {
    known_.clear();
    ++branches_;
    if (branches_ > 1 && flows(model)) report.statics.stable = holds(model, state, report.statics.negative_pivots, report.statics.reference_force);
  }
  report.branch = branches_;
  ended_ = false;
  stable_ = report.statics.stable;
  known_.push_back({p, state.q});
  if (known_.size() > most_known) known_.pop_front();
  return report;
}

}  // namespace hawser
