// simulate: a run in time from a consistent start, with outputs at fixed instants. The only place that replaces the State.
//
// Steps are at most `step` long and shortened evenly so that every output instant is the end of a step. A step that
// fails is halved, a bounded number of times; the auxiliary acceleration is re-based on every change of step (theory 6).
#pragma once

#include <functional>
#include <string>

#include "assembly/assembler.hpp"
#include "assembly/model.hpp"
#include "assembly/state.hpp"
#include "solver/statics.hpp"

namespace hawser {

struct SimulateOptions {
  double duration = 0.0;         // s
  double step = 0.05;            // s
  double spectral_radius = 0.8;  // generalized-alpha at infinite frequency
  double output_interval = 0.1;  // s
  double tolerance = 0.0;        // relative Newton tolerance (theory 6.1); 0: automatic
  LinearSolverKind linear_solver = LinearSolverKind::automatic;
  int max_halvings = 10;
};

/// The options that a scene with dynamics asks for.
SimulateOptions simulate_options(const Scene& scene);

struct SimulateCounters {
  long steps = 0;
  long newton_iterations = 0;
  long factorizations = 0;
  long residuals = 0;
  long rejected_steps = 0;
  double smallest_step = 0.0;        // s
  double largest_residual = 0.0;     // relative, over accepted steps
  double largest_local_error = 0.0;  // m, estimated, of the positions in one step; the first step is not judged (theory 6)
  std::string linear_solver;
  bool modified_newton = false;
};

struct SimulateReport {
  bool finished = false;
  bool interrupted = false;
  double reached = 0.0;  // s
  SimulateCounters counters;
  Failure failure;  // where neither finished nor interrupted
};

/// Called at t = 0 and at every output instant with a converged state; returns false to stop (interrupt).
using Observer = std::function<bool(const State&, const SimulateCounters&)>;

/// Runs from `state` (positions and velocities at t = 0 given; accelerations are made consistent here) to `duration`.
SimulateReport simulate(const Assembler& assembler, const SimulateOptions& options, State& state, const Observer& observe);

/// At rest (or towed), unstrained, each line on the straight line from `from` towards `to`.
State straight_rest_state(const Model& model);

/// Positions and velocities interpolated from a table of rows per line (scene.md, start = { file = ... }).
State state_from_table(const Model& model, const StartTable& table);

}  // namespace hawser
