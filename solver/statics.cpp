#include "solver/statics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solver/relaxation.hpp"
#include "solver/stability.hpp"
#include "solver/static_continuation.hpp"
#include "solver/static_failure.hpp"
#include "solver/static_parts.hpp"
#include "solver/static_perturbation.hpp"
#include "solver/static_slip.hpp"
#include "solver/static_start_loads.hpp"
#include "solver/static_system.hpp"

namespace hawser {
namespace {

constexpr int unfloored_iterations = 30;   // of one stage; a good start needs a tenth of them
constexpr int floored_iterations = 150;    // of one stage; a straight start needs a quarter of them
constexpr int bowed_iterations = 50;       // of a state that is bowed sideways
constexpr double beam_exact_below = 1e-4;  // residual over reference force: near a solution
constexpr double loose_tolerance = 1e-6;   // theory 6.1, where the automatic one cannot be reached (slope of a bare end)
constexpr double loose_increment = 1e-4;   // of the length
constexpr double floor_share = 0.25;       // of the load: T_f = 0.25 w L (theory 7.2)
constexpr double guard_floor = 1e-5;       // of T_f, where a guarded Newton starts near a solution
constexpr int way_steps = 300;             // of a motion from one of the models on the way of a continuation to the next
constexpr int most_restless = 2;           // of these motions, that led to no equilibrium
constexpr double way_tolerance = 1e-7;     // of the models on the way of a continuation
constexpr double way_increment = 1e-5;     // of the length
constexpr double relaxation_floor = 1e-2;  // of T_f
constexpr int relaxation_steps = 1000;
constexpr int creep_iterations = 2000;
constexpr double creep_enough = 10.0;                 // tolerances
constexpr double creep_resistance = 100.0;            // of load/length^2: the load moves a line by a hundredth of its length in the first step
constexpr double same_place = 1e-4;                   // of the length, of two equilibria
constexpr double push = 1e-2;                         // of the length
constexpr int rounds_apart = 2;                       // of lines solved one by one
constexpr double loose_slips[] = {10.0, 1e-2, 1e-3};  // of the longest line: where the branches in the slip begin

/// How one Newton is run.
struct Attempt {
  double floor = 0.0;  // N, T_f at its start
  bool guarded = false;
  bool on_the_way = false;  // of a continuation: not so exact, and not reported
  int iterations = unfloored_iterations;
};

/// A state that was not accepted.
struct Found {
  State state;
  StaticReport report;
  Failure failure;
};

/// One run of solve_static: stages, each a Newton and a certificate.
class StaticSolver {
 public:
  StaticSolver(const Assembler& assembler, const StaticOptions& options, State& state, StaticReport& report)
      : assembler_(assembler),
        model_(assembler.model()),
        options_(options),
        state_(state),
        report_(report),
        linear_(make_linear_solver(options.linear_solver, options.threads)),
        load_(largest_load(model_)),
        limp_(*std::min_element(model_.element.EI.begin(), model_.element.EI.end()) == 0.0),
        hangs_(!model_.seabed && std::ranges::any_of(model_.lines, [](const Line& line) { return line.from_free || line.to_free; })),
        tolerance_(options.tolerance) {
    report_.linear_solver = linear_->name();
  }

  void run() {
    if (!solved()) keep_best();
  }

 private:
  bool solved() {
    if (options_.start != StaticStart::catenary) {
      const bool given = options_.start == StaticStart::given;
      const State start = given ? state_ : static_start(model_, options_.start);
      if (given && accepted("Newton from the start", start, unfloored())) return true;
      if (accepted("tension-floored Newton from the start", start, floored())) return true;
    }
    if (exhausted()) return false;
    const State start = static_start(model_, StaticStart::catenary);
    if (accepted("Newton from the catenary", start, unfloored())) return true;
    if (hangs_ && accepted("tension-floored Newton from the catenary", start, floored())) return true;
    if (by_continuation(start)) return true;
    if (!model_.hubs.empty() && by_parts(start)) return true;
    if (!hangs_ && accepted("tension-floored Newton from the catenary", start, floored())) return true;
    if (by_relaxation(start) || stable_with_all_loads()) return true;
    if (by_creep("where that left it", State(left_), creep_iterations / 2) || stable_with_all_loads()) return true;
    if (by_creep("the catenary", start, creep_iterations) || stable_with_all_loads() || by_slip() || by_push()) return true;
    if (options_.tolerance > 0.0) return false;
    tolerance_ = loose_tolerance;
    increment_tolerance_ = loose_increment;
    return accepted("tension-floored Newton from the catenary, to a looser tolerance", start, floored());
  }

  double first_floor() const { return floor_share * load_; }
  Attempt unfloored() const { return {}; }
  Attempt floored() const { return {first_floor(), false, false, floored_iterations}; }
  const char* verdict() const { return report_.stable ? "converged" : "converged, compressed or knotted"; }
  bool exhausted() const { return report_.iterations >= options_.max_iterations; }

  /// Solves from a start; true if the result is a stable equilibrium. An unstable one is bowed sideways and solved again.
  bool accepted(const std::string& name, const State& start, const Attempt& attempt) {
    if (exhausted()) return false;
    state_ = start;
    if (!converges(assembler_, name, attempt)) return false;
    if (report_.stable) return true;
    if (exhausted()) return false;
    bow_sideways(model_, state_);
    const Attempt again{first_floor(), false, false, bowed_iterations};
    if (!converges(assembler_, name + ", bowed sideways because the result was compressed or knotted", again)) return false;
    if (report_.stable || exhausted() || !draw_out_knots(model_, state_)) return report_.stable;
    return converges(assembler_, name + ", its knots drawn out", again) && report_.stable;
  }

  /// Every line on its own, then all together, the points where they meet moved by Newton's first increment (static_parts.hpp).
  bool by_parts(const State& start) {
    State state = start;
    for (int round = 0; round < rounds_apart && !exhausted(); ++round) {
      const LinesApart apart = solve_lines_apart(model_, options_, round > 0, state);
      report_.iterations += static_cast<int>(std::ceil(apart.factorizations));
      report(fmt::format("lines one by one: {} of {} not solved, {:.0f} factorizations", apart.unsolved, model_.lines.size(), apart.factorizations));
      if (accepted("Newton from these lines", state, unfloored())) return true;
      if (apart.unsolved > 0) return false;
      state_ = state;
      StaticSystem system(assembler_, *linear_, tolerance_, HUGE_VAL, state_);
      system.residual();
      if (!system.solve(0.0)) return false;
      system.advance(capped_step(system.increment(), longest_line(model_)));
      state = state_;
    }
    return false;
  }

  /// From an easier model to the real one (static_continuation.hpp).
  bool by_continuation(const State& start) {
    if (exhausted()) return false;
    StaticContinuation way(model_, load_);
    const int before = report_.iterations;
    const bool hangs_in_legs = folded(model_, start) && !model_.seabed;
    const bool arrived = first_on_the_way(way, hangs_in_legs ? open_start(model_) : start) && follow(way);
    report(fmt::format("continuation of the stiffnesses: {} after {} steps, {} factorizations{}", arrived ? verdict() : "no way on", way.steps(),
                       report_.iterations - before, arrived ? "" : ", at " + way.place()));
    return arrived && report_.stable;
  }

  bool first_on_the_way(const StaticContinuation& way, const State& start) {
    const Attempt attempts[] = {{first_floor(), false, true, 40}, {first_floor(), true, true, 150}};
    const Assembler first(way.model(), std::max(1, options_.threads));
    const auto found = [&](const State& from) { return reached(first, !way.at_end(), from, attempts); };
    if (!found(start)) return false;
    if (report_.stable) return true;
    bow_sideways(model_, state_);
    return found(State(state_));
  }

  bool follow(StaticContinuation& way) {
    const Attempt attempts[] = {{0.0, false, true, 15}, {guard_floor * first_floor(), true, true, 100}};
    int restless = hangs_ ? most_restless : 0;  // what is hard there no motion helps either
    while (!way.at_end()) {
      const State before = state_;
      way.advance();
      const Assembler next(way.model(), std::max(1, options_.threads));
      if (reached(next, !way.at_end(), before, attempts)) continue;
      if (restless < most_restless) {  // a branch of equilibria may have ended: the line jumps
        state_ = before;
        if (comes_to_rest(next, way_steps, !way.at_end())) continue;
        ++restless;
      }
      state_ = before;
      if (exhausted() || !way.retreat()) return false;
    }
    return true;
  }

  /// The equilibrium of the model on the way, by the plain Newton where that is stable, or else by the guarded one.
  bool reached(const Assembler& next, bool on_the_way, const State& from, const Attempt (&attempts)[2]) {
    for (Attempt attempt : attempts) {
      attempt.on_the_way = on_the_way;
      state_ = from;
      if (converges(next, "at the end of the continuation", attempt) && (attempt.guarded || report_.stable)) return true;
    }
    return false;
  }

  /// Set in motion from the start, bowed sideways, until it comes to rest (relaxation.hpp); then Newton.
  bool by_relaxation(const State& start) {
    if (exhausted()) return false;
    state_ = start;
    bow_sideways(model_, state_);
    return comes_to_rest(assembler_, relaxation_steps, false) && report_.stable;
  }

  /// Sinks to rest (creep.hpp); then Newton, or, where directions that nothing holds lead that astray, creep to the tolerance itself.
  bool by_creep(const std::string& from, const State& start, int iterations) {
    if (exhausted() || start.q.empty()) return false;
    state_ = start;
    const bool rests = creeps("creep from " + from, creep_enough, iterations);
    const State rest = state_;
    if (converges(assembler_, "Newton from where it came to rest", unfloored())) return report_.stable;
    if (!rests || exhausted()) return false;
    state_ = rest;
    return creeps("creep on to the tolerance, where Newton is led away", 1.0, creep_iterations / 4) && report_.stable;
  }

  /// True where it came to rest to so many tolerances.
  bool creeps(const std::string& name, double enough, int iterations) {
    const Model massive = with_unit_mass(model_);
    const Assembler assembler(massive, std::max(1, options_.threads));
    StaticSystem system(assembler, *linear_, tolerance_, HUGE_VAL, state_);
    CreepOptions motion;
    motion.length = longest_line(model_);
    motion.resistance = creep_resistance * load_ / (motion.length * motion.length);
    motion.enough = enough;
    motion.max_iterations = std::min(options_.max_iterations - report_.iterations, iterations);
    const NewtonReport result = creep(system, motion);
    record(system, result);
    report_.converged = result.converged() && enough <= 1.0;
    if (report_.converged) certify(model_, state_, report_);
    report(fmt::format("{}: {} after {} factorizations, residual {:.2g} N", name, result.converged() ? "at rest" : "in motion", result.factorizations,
                       result.residual));
    if (report_.converged && !report_.stable) remember(name, explain_failure(model_, state_, system, result, report_));
    return result.converged();
  }

  /// Along branches of equilibria from beds that hold the line later than the real one (static_slip.hpp).
  bool by_slip() {
    for (const double share : loose_slips) {
      if (exhausted() || !model_.rubs()) return false;
      const SlipBranch branch = follow_slip(model_, options_, share, options_.max_iterations - report_.iterations);
      report_.iterations += branch.factorizations;
      report(describe(branch));
      if (!branch.reached) continue;
      state_ = branch.state;
      if ((converges(assembler_, "Newton from there", unfloored()) && report_.stable) || stable_with_all_loads()) return true;
    }
    return false;
  }

  /// Pushed along their softest modes the unstable equilibria are left, to sink to rest elsewhere.
  bool by_push() {
    const double size = push * longest_line(model_);
    for (std::size_t k = 0, known = unstable_.size(); k < known; ++k) {  // creep may find more
      State pushed = unstable_[k].state;
      const std::optional<StabilityMode> mode = softest_mode(model_, pushed, unstable_[k].report.reference_force);
      if (!mode) continue;
      for (std::size_t i = 0; i < pushed.q.size(); ++i) pushed.q[i] += size * mode->shape[i];
      if (by_creep("an unstable equilibrium, pushed along its softest mode", pushed, creep_iterations / 4) || stable_with_all_loads()) return true;
    }
    return false;
  }

  /// Equilibria that are unstable without the loads that have no potential may be stable with them (stability.hpp): each is looked at once.
  bool stable_with_all_loads() {
    while (!has_potential(model_) && looked_at_ < unstable_.size()) {
      const Found& found = unstable_[looked_at_++];
      const std::optional<double> slowest = decay_with_all_loads(model_, found.state, found.report.reference_force);
      if (!slowest) continue;
      take(found);
      report_.stable = true;
      report_.slowest_decay = slowest;
      report(fmt::format("{}: stable with all loads, not without drag and friction; slowest decay {:.2g} N/m2", found.failure.stage, *slowest));
      return true;
    }
    return false;
  }

  /// Set in motion where it is until it comes to rest, then Newton; true at an equilibrium.
  bool comes_to_rest(const Assembler& assembler, int steps, bool on_the_way) {
    if (exhausted()) return false;
    StaticSystem system(assembler, *linear_, on_the_way ? way_tolerance : tolerance_, 0.0, state_);
    RelaxationOptions motion;
    motion.length = longest_line(model_);
    motion.floor = relaxation_floor * first_floor();
    motion.max_steps = std::min(options_.max_iterations - report_.iterations, steps);
    const NewtonReport result = relax(system, motion);
    report_.iterations += result.factorizations;
    if (!on_the_way)
      report(fmt::format("dynamic relaxation: {} after {} steps, residual {:.2g} N", result.converged() ? "at rest" : "in motion",
                         result.factorizations, result.residual));
    const State left = state_;
    if (!on_the_way) left_ = state_;
    if (converges(assembler, "Newton from where it was left", {0.0, false, on_the_way})) return true;
    state_ = left;
    return converges(assembler, "guarded Newton from where it was left", {guard_floor * first_floor(), true, on_the_way, 100});
  }

  bool converges(const Assembler& assembler, const std::string& name, const Attempt& attempt) {
    if (exhausted()) return false;
    const double exact_below = attempt.guarded ? HUGE_VAL : !limp_ ? beam_exact_below : attempt.floor > 0.0 ? 0.0 : HUGE_VAL;
    StaticSystem system(assembler, *linear_, attempt.on_the_way ? way_tolerance : tolerance_, exact_below, state_);
    system.keep_definite(attempt.guarded && has_potential(model_));
    NewtonOptions newton_options;
    newton_options.length = longest_line(model_);
    newton_options.floor = attempt.floor;
    newton_options.increment_tolerance = attempt.on_the_way ? way_increment : increment_tolerance_;
    newton_options.max_iterations = std::min(options_.max_iterations - report_.iterations, attempt.iterations);
    newton_options.inexact_matrix = !linear_->takes_unsymmetric() && !has_potential(model_);
    const NewtonReport result = attempt.guarded ? guarded_newton(system, newton_options) : newton(system, newton_options);
    record(system, result);
    if (result.converged()) certify(assembler.model(), state_, report_);
    if (attempt.on_the_way) return result.converged();
    const std::string outcome = result.converged() ? verdict() : "not converged";
    report(fmt::format("{}: {} after {} factorizations, residual {:.1e} of {:.4g} N", name, outcome, result.factorizations, report_.residual,
                       report_.reference_force));
    if (!report_.converged || !report_.stable) remember(name, explain_failure(model_, state_, system, result, report_));
    return result.converged();
  }

  /// Of the states that were not accepted the best, a converged one or else the one with the least residual, and the unstable equilibria.
  void remember(const std::string& name, Failure failure) {
    failure.stage = name;
    const auto same = [&](const Found& other) { return distance(model_, other.state, state_) <= same_place; };
    if (report_.converged && report_.negative_pivots > 0 && std::none_of(unstable_.begin(), unstable_.end(), same) && !find_knot(model_, state_))
      unstable_.push_back({state_, report_, failure});
    if (best_.failure.what.empty() || std::pair(best_.report.converged, -best_.report.residual) < std::pair(report_.converged, -report_.residual))
      best_ = {state_, report_, failure};
  }

  void keep_best() {
    if (best_.failure.what.empty()) return;
    take(best_);
    report_.failure = best_.failure;
    report_.failure.kept =
        fmt::format("the state of this stage, the best of {}; {} factorizations in all", report_.stages.size(), report_.iterations);
  }

  /// What was found, with the account of all stages.
  void take(const Found& found) {
    state_ = found.state;
    StaticReport taken = found.report;
    taken.stages = std::move(report_.stages);
    taken.iterations = report_.iterations;
    taken.modified_newton = report_.modified_newton;
    report_ = std::move(taken);
  }

  void report(const std::string& stage) {
    report_.stages.push_back(stage);
    if (options_.log) options_.log(stage);
  }

  void record(StaticSystem& system, const NewtonReport& result) {
    report_.iterations += result.factorizations;
    report_.converged = result.converged();
    report_.stable = false;
    report_.residual_force = result.residual;
    report_.reference_force = system.reference_force();
    report_.roundoff_floor = system.roundoff();
    report_.residual = report_.reference_force > 0.0 ? result.residual / report_.reference_force : result.residual;
    report_.modified_newton = report_.modified_newton || system.modified();
  }

  const Assembler& assembler_;
  const Model& model_;
  const StaticOptions& options_;
  State& state_;
  StaticReport& report_;
  std::unique_ptr<LinearSolver> linear_;
  State left_;   // by the relaxation
  double load_;  // N, of the line with the largest one
  bool limp_;    // some element has no bending stiffness
  bool hangs_;   // free ends and no bed: what is hard there is the end itself, which no stiffness helps
  double tolerance_, increment_tolerance_ = NewtonOptions{}.increment_tolerance;
  Found best_;
  std::vector<Found> unstable_;  // equilibria without knots, looked at by stable_with_all_loads up to looked_at_
  std::size_t looked_at_ = 0;
};

}  // namespace

StaticReport solve_static(const Assembler& assembler, const StaticOptions& options, State& state) {
  StaticReport report;
  if (const auto refusal = refuse(assembler.model())) {
    report.failure = *refusal;
    if (options.start != StaticStart::given) state = static_start(assembler.model(), StaticStart::straight);
    return report;
  }
  StaticSolver(assembler, options, state, report).run();
  report.converged = report.converged && report.stable;
  if (report.converged) report.failure = {};
  return report;
}

}  // namespace hawser
