// The scenes of data/scenes, solved in this process: reading, meshing, statics, dynamics and histories, but no files.
#pragma once

#include <string>
#include <vector>

#include "assembly/observables.hpp"
#include "solver/app/scene_reader.hpp"
#include "solver/simulate.hpp"

namespace hawser::bench {

inline Scene scene_of(const std::string& name, const std::vector<std::string>& overrides) {
  std::vector<Diagnostic> warnings;
  return read_scene(std::string(HAWSER_SOURCE_DIR) + "/data/scenes/" + name + ".toml", overrides, &warnings);
}

struct StaticRun {
  Model model;
  State state;
  StaticReport report;
};

inline StaticRun run_static(const Scene& scene) {
  StaticRun run{build_model(scene), {}, {}};
  const Assembler assembler(run.model);
  run.state = run.model.make_state();
  StaticOptions options;
  options.tolerance = scene.solve.newton_tolerance.value_or(0.0);
  options.linear_solver = linear_solver_kind(scene.solve.linear_solver);
  run.report = solve_static(assembler, options, run.state);
  return run;
}

/// One row of a history: time, position of both ends of the first line, tension at its two ends.
struct Row {
  double time;
  Vec3 from, to;
  double tension_from, tension_to;
};

struct DynamicRun {
  bool finished = false;
  std::vector<Row> history;
  SimulateCounters counters;
};

inline DynamicRun run_dynamic(const Scene& scene) {
  StaticRun start = run_static(scene);
  DynamicRun run;
  if (!start.report.converged) return run;
  const Model& model = start.model;
  const Assembler assembler(model);
  const SimulateOptions options = simulate_options(scene);
  const auto node = [&model](const State& s, int i) { return Vec3(Eigen::Map<const Vec3>(&s.q[model.dof(0, i)])); };
  const auto observe = [&](const State& s, const SimulateCounters&) {
    const LineResult line = observe_line(model, s, 0);
    run.history.push_back({s.t, node(s, 0), node(s, model.lines[0].nodes - 1), line.tension_from, line.tension_to});
    return true;
  };
  const SimulateReport report = simulate(assembler, options, start.state, observe);
  run.finished = report.finished;
  run.counters = report.counters;
  return run;
}

}  // namespace hawser::bench
