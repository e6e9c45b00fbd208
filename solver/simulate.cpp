#include "solver/simulate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solver/norms.hpp"
#include "solver/static_failure.hpp"
#include "solver/time/generalized_alpha.hpp"
#include "solver/time/line_system.hpp"
#include "solver/time/step_control.hpp"

namespace hawser {
namespace {

constexpr double same_instant = 1.0e-9;  // of an output interval: instants closer than this are one
constexpr TangentFloor floored{.tension = 0.0, .use_minimum = true, .gauss_newton = true};

StepOptions step_options(const SimulateOptions& options) {
  StepOptions step;
  step.spectral_radius = options.spectral_radius;
  step.tolerance = options.tolerance;
  return step;
}

/// The state of one run: everything that outlives a step.
class Run {
 public:
  Run(const Assembler& assembler, const SimulateOptions& options, State& state)
      : options_(options),
        system_(assembler),
        solver_(make_linear_solver(options.linear_solver, assembler.threads())),
        scheme_(system_, *solver_, step_options(options)),
        control_(options.max_halvings),
        state_(state) {
    counters().linear_solver = solver_->name();
    counters().smallest_step = INFINITY;
  }

  bool start();
  bool advance(double t0, double t1, double h);
  SimulateReport& report() { return report_; }
  SimulateCounters& counters() { return report_.counters; }

 private:
  void count(const StepReport& step);
  void fail(const StepReport& step, const std::string& what);

  SimulateOptions options_;
  LineSystem system_;
  std::unique_ptr<LinearSolver> solver_;
  GeneralizedAlpha scheme_;
  StepControl control_;
  State& state_;
  SimulateReport report_;
};

/// Consistent accelerations at t = 0.
bool Run::start() {
  state_.t = 0.0;
  system_.model().align_clamps(state_);
  const StepReport step = scheme_.start(state_);
  count(step);
  if (step.status != StepStatus::ok) {
    fail(step, "no accelerations fit the start");
  }
  return step.status == StepStatus::ok;
}

/// One nominal step, in pieces where it must be. False where even the smallest piece fails.
bool Run::advance(double t0, double t1, double nominal) {
  control_.begin(t0, t1, nominal);
  while (!control_.finished()) {
    const double h = control_.step();
    const StepReport step = scheme_.step(state_, control_.end_time(), h, control_.subdivided() ? floored : TangentFloor{});
    count(step);
    if (step.status == StepStatus::ok) {
      if (counters().steps > 0) {
        counters().largest_local_error = std::max(counters().largest_local_error, scheme_.local_error());
      }
      ++counters().steps;
      counters().smallest_step = std::min(counters().smallest_step, h);
      counters().largest_residual = std::max(counters().largest_residual, step.residual);
      control_.advance(step.easy);
    } else {
      ++counters().rejected_steps;
      if (!control_.halve()) {
        fail(step, fmt::format("the time integration stopped at t = {:.6g} s: a step of {:.3g} s failed after {} halvings", state_.t, h,
                               options_.max_halvings));
        return false;
      }
    }
  }
  return true;
}

void Run::count(const StepReport& step) {
  counters().newton_iterations += step.iterations;
  counters().factorizations += step.factorizations;
  counters().residuals += step.residuals;
  counters().modified_newton |= step.modified_newton;
}

void Run::fail(const StepReport& step, const std::string& what) {
  const Model& model = system_.model();
  Failure& failure = report_.failure;
  failure.what = what;
  for (std::size_t i = 0; i < model.lines.size(); ++i) {
    const Chain& chain = model.chain(static_cast<int>(i));
    if (step.worst >= chain.first_dof && step.worst < chain.first_dof + chain.dofs()) {
      failure.line = model.lines[i].name;
      failure.s = model.lines[i].s[(step.worst - chain.first_dof) / chain.block];
    }
  }
  const std::string point = meeting_point(model, step.worst);
  if (!point.empty()) failure.what += fmt::format(" (worst at the point \"{}\")", point);
  switch (step.status) {
    case StepStatus::singular:
      failure.cause = "the linear system has no usable factorization there: a part without mass, or a slack or compressed part";
      failure.remedy = "give the line a small bending stiffness EI, or take linear_solver = \"chain\" or \"umfpack\"";
      break;
    case StepStatus::not_finite:
      failure.cause = "forces overflowed there: motions far beyond the mesh, or an input of the wrong size";
      failure.remedy = "check masses, stiffnesses and prescribed motions; take a smaller step";
      break;
    default:
      failure.cause = "Newton's iteration did not converge: a slack part pulled taut, or forces that change faster than the step can follow";
      failure.remedy = "take a smaller step or a smaller spectral_radius, give the line a small bending stiffness EI, or use shorter elements there";
  }
}

/// From one output instant to the next: equal steps, at most options.step long.
struct Interval {
  double end, step;  // s
  long steps;
};

/// The k-th interval, from k = 1; the last one may be shorter.
Interval output_interval(const SimulateOptions& options, double from, long k) {
  const double whole = options.output_interval;
  const double end = static_cast<double>(k) * whole;
  const bool last = end > options.duration - same_instant * whole;
  // The length of a whole interval is exact, not a difference of large times: all its steps are the same number.
  const double length = last && options.duration < end - same_instant * whole ? options.duration - from : whole;
  const long steps = std::max(1L, static_cast<long>(std::ceil(length / options.step * (1.0 - same_instant))));
  return {last ? options.duration : end, length / static_cast<double>(steps), steps};
}

}  // namespace

// What Newton may leave of the wanted relative error of tension.
constexpr double newton_share = 1.0e-3, loosest_tolerance = 1.0e-6;

SimulateOptions simulate_options(const Scene& scene) {
  SimulateOptions options;
  options.duration = scene.dynamics->duration;
  options.step = scene.dynamics->step;
  options.spectral_radius = scene.dynamics->spectral_radius;
  options.output_interval = scene.dynamics->output_interval;
  options.tolerance = scene.solve.newton_tolerance.value_or(std::min(newton_share * scene.solve.accuracy, loosest_tolerance));
  options.linear_solver = linear_solver_kind(scene.solve.linear_solver);
  return options;
}

SimulateReport simulate(const Assembler& assembler, const SimulateOptions& options, State& state, const Observer& observe) {
  Run run(assembler, options, state);
  SimulateReport& report = run.report();
  bool going = run.start();
  if (going && !observe(state, run.counters())) {
    report.interrupted = true;
  }
  double from = 0.0;
  for (long k = 1; going && !report.interrupted && from < options.duration; ++k) {
    const Interval interval = output_interval(options, from, k);
    for (long i = 0; going && i < interval.steps; ++i) {
      const double end = i + 1 == interval.steps ? interval.end : from + interval.step * static_cast<double>(i + 1);
      going = run.advance(from + interval.step * static_cast<double>(i), end, interval.step);
    }
    from = interval.end;
    if (going && !observe(state, run.counters())) {
      report.interrupted = true;
    }
  }
  report.reached = state.t;
  report.finished = going && !report.interrupted;
  if (report.counters.steps == 0) {
    report.counters.smallest_step = 0.0;
  }
  return report;
}

}  // namespace hawser
