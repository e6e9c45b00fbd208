#include "solver/statics.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "assembly/observables.hpp"
#include "solver/static_failure.hpp"
#include "solver/static_start_loads.hpp"
#include "solver/static_system.hpp"

namespace hawser {
namespace {

constexpr int unfloored_iterations = 30;   // of one stage; a good start needs a tenth of them
constexpr int floored_iterations = 150;    // of one stage; a straight start needs a quarter of them
constexpr double beam_exact_below = 1e-4;  // residual over reference force: near a solution
constexpr double loose_tolerance = 1e-6;   // theory 6.1, where the automatic one cannot be reached (slope of a bare end)
constexpr double loose_increment = 1e-4;   // of the length
constexpr double first_slip = 0.1;         // of the length: where friction is let in step by step
constexpr double slip_ratio = 0.1;         // from one slip to the next; its root after a failure
constexpr double least_slip_step = 0.8;    // then it is given up
constexpr double floor_share = 0.25;       // of the load: T_f = 0.25 w L (theory 7.2)

double longest_line(const Model& model) {
  double longest = 0.0;
  for (const Line& line : model.lines) longest = std::max(longest, line.length);
  return longest;
}

double starting_floor(const Model& model) {
  double floor = 0.0;
  for (int line = 0; line < static_cast<int>(model.lines.size()); ++line) floor = std::max(floor, floor_share * load_scale(model, line));
  return floor;
}

/// Bows every line sideways, across its chord and where possible along its load: out of an unstable state.
void perturb_sideways(const Model& model, State& state) {
  for (int index = 0; index < static_cast<int>(model.lines.size()); ++index) {
    const Line& line = model.lines[index];
    const Chain& chain = model.chain(index);
    const auto r = [&](int node) { return Eigen::Map<Vec3>(&state.q[chain.dof(node)]); };
    const Vec3 chord = r(line.nodes - 1) - r(0);
    const double c = chord.norm(), L = line.length;
    const Vec3 t = c > 0.0 ? Vec3(chord / c) : Vec3::UnitX();
    Vec3 n = -Vec3::UnitZ() + t.z() * t;
    n = n.norm() > 1e-3 ? n.normalized() : t.unitOrthogonal();
    const double bow = std::clamp(std::sqrt(0.375 * c * std::max(L - c, 0.0)), 0.01 * L, 0.3 * L);  // sag of a parabola of length L
    const bool free = line.from_free || line.to_free;
    for (int i = 0; i < line.nodes; ++i) {
      const double x = line.from_free ? 1.0 - line.s[i] / L : line.s[i] / L;
      const double turn = free ? 0.5 * std::numbers::pi : std::numbers::pi;
      const double shape = free ? 1.0 - std::cos(turn * x) : std::pow(std::sin(turn * x), 2);
      const double slope = (free ? turn * std::sin(turn * x) : turn * std::sin(2.0 * turn * x)) / (line.from_free ? -L : L);
      r(i) += bow * shape * n;
      if (chain.block == 6) Eigen::Map<Vec3>(&state.q[chain.dof(i) + 3]) += bow * slope * n;
    }
  }
  model.prescribe(state);
  std::fill(state.a.begin(), state.a.end(), 0.0);
  for (const Chain& chain : model.chains)
    for (int i = 0; i < chain.nodes; ++i) Eigen::Map<Vec3>(&state.v[chain.dof(i)]) = model.tow;
  model.align_clamps(state);
}

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
        floor_(starting_floor(model_)),
        limp_(*std::min_element(model_.element.EI.begin(), model_.element.EI.end()) == 0.0),
        tolerance_(options.tolerance) {
    report_.linear_solver = linear_->name();
  }

  void run() {
    const bool straight = options_.start == StaticStart::straight;
    const State start = options_.start == StaticStart::given ? state_ : static_start(model_, options_.start);
    if (!straight && accepted("Newton from the start", start, 0.0)) return;
    if (with_friction_step_by_step(start)) return;
    if (accepted("tension-floored Newton from the start", start, floor_)) return;
    if (options_.start != StaticStart::catenary) {
      const State catenary = static_start(model_, StaticStart::catenary);
      if (accepted("Newton from the catenary", catenary, 0.0) || accepted("tension-floored Newton from the catenary", catenary, floor_)) return;
    }
    if (without_bending_first()) return;
    if (!straight && accepted("tension-floored Newton from straight lines", static_start(model_, StaticStart::straight), floor_)) return;
    if (options_.tolerance > 0.0) return;
    tolerance_ = loose_tolerance;
    increment_tolerance_ = loose_increment;
    accepted("tension-floored Newton from the start, to a looser tolerance", start, floor_);
  }

 private:
  /// Solves from a start; true if the result is a stable equilibrium. An unstable one is bowed sideways and solved again.
  bool accepted(const std::string& name, const State& start, double floor) {
    state_ = start;
    if (!converges(assembler_, name, floor)) return false;
    if (report_.stable) return true;
    perturb_sideways(model_, state_);
    return converges(assembler_, name + ", bowed sideways because the result was compressed", floor_) && report_.stable;
  }

  /// EI = 0 from the catenary, then with EI from there: a folded start unfolds (theory 7.2).
  bool without_bending_first() {
    if (*std::max_element(model_.element.EI.begin(), model_.element.EI.end()) <= 0.0) return false;
    Model limp = model_;
    std::fill(limp.element.EI.begin(), limp.element.EI.end(), 0.0);
    const Assembler limp_assembler(limp, std::max(1, options_.threads));
    state_ = static_start(limp, StaticStart::catenary);
    if (!converges(limp_assembler, "without bending stiffness", floor_)) return false;
    const State start = state_;
    return accepted("with bending stiffness from there", start, 0.0) || accepted("the same, tension-floored", start, floor_);
  }

  /// Friction with a large elastic slip first, which nearly lets the line slide, then with less and less (theory 5.4).
  bool with_friction_step_by_step(State start) {
    if (!model_.seabed || !model_.seabed->law.rubs()) return false;
    const double wanted = model_.seabed->law.slip;
    Model relaxed = model_;
    const auto solved = [&](double slip, double floor) {
      relaxed.seabed->law.slip = slip;
      state_ = start;
      return converges(Assembler(relaxed, std::max(1, options_.threads)), fmt::format("friction with a slip of {:.2g} m", slip), floor) &&
             report_.stable;
    };
    double slip = std::max(wanted, first_slip * longest_line(model_));
    if (!solved(slip, 0.0) && !solved(slip, floor_)) return false;
    for (double ratio = slip_ratio; slip > wanted && ratio < least_slip_step;) {
      start = state_;
      const double next = std::max(wanted, slip * ratio);
      if (solved(next, 0.0))
        slip = next;
      else
        ratio = std::sqrt(ratio), state_ = start;
    }
    return slip == wanted;
  }

  bool converges(const Assembler& assembler, const std::string& name, double floor) {
    const int left = options_.max_iterations - report_.iterations;
    if (left <= 0) return false;
    const double exact_below = !limp_ ? beam_exact_below : floor > 0.0 ? 0.0 : HUGE_VAL;
    StaticSystem system(assembler, *linear_, tolerance_, exact_below, state_);
    NewtonOptions newton_options;
    newton_options.length = longest_line(model_);
    newton_options.floor = floor;
    newton_options.increment_tolerance = increment_tolerance_;
    newton_options.max_iterations = std::min(left, floor > 0.0 ? floored_iterations : unfloored_iterations);
    newton_options.inexact_matrix = !linear_->takes_unsymmetric() && unsymmetric();
    const NewtonReport result = newton(system, newton_options);
    record(system, result);
    if (result.converged()) certify(system);
    const std::string outcome = !result.converged() ? "not converged" : report_.stable ? "converged" : "converged, compressed and unstable";
    report_.stages.push_back(fmt::format("{}: {} after {} factorizations, residual {:.1e} of {:.4g} N", name, outcome, result.factorizations,
                                         report_.residual, report_.reference_force));
    if (options_.log) options_.log(report_.stages.back());
    if (!report_.converged || !report_.stable) report_.failure = explain_failure(model_, state_, system, result, report_);
    return result.converged();
  }

  /// Drag, friction and a bed that is not level have no potential.
  bool unsymmetric() const { return model_.wet || (model_.seabed && (model_.seabed->law.rubs() || !model_.seabed->surface.level())); }

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

  /// Stable: no compression that could buckle a line, or no negative pivot of the exact elastic tangent.
  void certify(StaticSystem& system) {
    const bool tension = free_of_compression(model_, state_, system.roundoff());
    report_.negative_pivots = tension ? 0 : negative_pivots_of_elastic_tangent(model_, state_);
    report_.stable = report_.negative_pivots == 0;
  }

  const Assembler& assembler_;
  const Model& model_;
  const StaticOptions& options_;
  State& state_;
  StaticReport& report_;
  std::unique_ptr<LinearSolver> linear_;
  double floor_;  // N, T_f at the start of a floored stage
  bool limp_;     // some element has no bending stiffness
  double tolerance_, increment_tolerance_ = NewtonOptions{}.increment_tolerance;
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

std::vector<double> estimate_static_error(const Scene& scene, const StaticOptions& options, const Model& model, const State& state) {
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> estimate(model.lines.size(), unknown);
  const Model coarse = build_model(coarsened(scene));
  const Assembler assembler(coarse, std::max(1, options.threads));
  StaticOptions coarse_options = options;
  coarse_options.start = StaticStart::catenary;
  coarse_options.log = nullptr;
  State coarse_state;
  if (!solve_static(assembler, coarse_options, coarse_state).converged) return estimate;
  for (int line = 0; line < static_cast<int>(model.lines.size()); ++line) {
    const double ratio = static_cast<double>(model.lines[line].elements) / coarse.lines[line].elements;
    if (ratio <= 1.0) continue;
    const LineResult fine = observe_line(model, state, line), rough = observe_line(coarse, coarse_state, line);
    const double order = model.lines[line].family == Family::bar ? 2.0 : 4.0;
    const double scale = std::max(fine.tension_from, fine.tension_to);
    const double difference = std::max(std::abs(fine.tension_from - rough.tension_from), std::abs(fine.tension_to - rough.tension_to));
    if (scale > 0.0) estimate[line] = difference / (scale * (std::pow(ratio, order) - 1.0));
  }
  return estimate;
}

}  // namespace hawser
