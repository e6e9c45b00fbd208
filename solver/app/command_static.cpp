#include "solver/app/command_static.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <limits>

#include "solver/app/certificate.hpp"
#include "solver/app/command_static_vary.hpp"
#include "solver/app/plots.hpp"
#include "solver/app/recorder_folder.hpp"
#include "solver/app/text.hpp"
#include "solver/sundials/kinsol.hpp"

namespace hawser {
namespace fs = std::filesystem;
namespace {

using Clock = std::chrono::steady_clock;

void write_result(const fs::path& folder, const Request& request, const Scene& scene, const Model& model, const StaticSolution& solution) {
  ResultFile result(folder / "result.h5", scene, model, request.overrides, "static");
  const StaticReport& report = solution.report;
  result.append(solution.state);
  result.write_state(solution.state);
  result.set_solver("linear_solver", report.linear_solver);
  result.set_solver("iterations", static_cast<long>(report.iterations));
  result.set_solver("residual", report.residual);
  result.set_solver("wall_seconds", solution.wall_seconds);
  result.set_status(report.converged ? "finished" : "failed");
  std::ofstream(folder / "static.json") << static_document(model, solution, request.stations).dump(2) << '\n';
}

void draw(const fs::path& folder, const Scene& scene, const Model& model, const State& state) {
  PlotData data{scene.title, model, {shape_of(model, state)}, {}, false};
  for (int line = 0; line < static_cast<int>(model.lines.size()); ++line) {
    data.ranges.emplace_back().add(model.lines[static_cast<std::size_t>(line)], observe_line(model, state, line));
  }
  const PlotReport report = draw_plots(folder, data);
  if (!report.trouble.empty()) say_warning(report.trouble);
}

/// The shape of a stored state, with the supports where this scene has them at t = 0, at rest or under tow.
State given_start(const Model& model, const std::string& path) {
  State state = static_start(model, StaticStart::straight);
  const std::vector<double> velocities = state.v;
  state.q = read_last_state(path, model).q;
  model.prescribe(state);
  model.align_clamps(state);
  state.v = velocities;
  state.a.assign(state.a.size(), 0.0);
  return state;
}

/// The user gave a first guess for some line (`start` of a line); lines without one start as ever.
bool has_shape(const Scene& scene) {
  return std::any_of(scene.lines.begin(), scene.lines.end(), [](const LineSpec& line) { return line.start.has_value(); });
}

}  // namespace

StaticOptions requested_static_options(const Request& request, const Scene& scene) {
  StaticOptions options;
  options.start = request.start;
  options.linear_solver = linear_solver_kind(scene.solve.linear_solver);
  options.tolerance = scene.solve.newton_tolerance.value_or(0.0);
  options.threads = scene.solve.threads;
  return options;
}

State requested_start(const Request& request, const Scene& scene, const Model& model, StaticOptions& options) {
  const bool shaped = request.start == StaticStart::catenary && has_shape(scene);
  if (request.from.empty() && !shaped) return model.make_state();
  options.start = StaticStart::given;
  return request.from.empty() ? static_start(model, StaticStart::catenary, scene) : given_start(model, request.from);
}

StaticSolution solve_requested_static(const Request& request, const Scene& scene, const Assembler& assembler) {
  const Model& model = assembler.model();
  StaticOptions options = requested_static_options(request, scene);
  if (!request.quiet) options.log = [](const std::string& stage) { fmt::print(stderr, "static: {}\n", stage); };

  StaticSolution solution;
  solution.state = requested_start(request, scene, model, options);
  const Clock::time_point start = Clock::now();
  const bool kinsol = request.method == StaticMethod::kinsol;
  solution.report = kinsol ? solve_static_kinsol(assembler, options, solution.state) : solve_static(assembler, options, solution.state);
  solution.wall_seconds = std::chrono::duration<double>(Clock::now() - start).count();
  // The state of a failure is an equilibrium only where instability is what was wrong with it.
  if (!solution.report.slowest_decay && (solution.report.converged || solution.report.negative_pivots > 0))
    solution.mode = softest_mode(model, solution.state, solution.report.reference_force);
  solution.error_estimates.assign(model.lines.size(), std::numeric_limits<double>::quiet_NaN());
  if (solution.report.converged) {
    options.log = {};
    if (options.start == StaticStart::given) options.start = StaticStart::catenary;  // the coarse mesh has no given state
    solution.error_estimates = estimate_static_error(scene, options, model, solution.state, solution.report.residual_force);
    if (request.probe > 0) {
      solution.probe_options.starts = request.probe;
      solution.probe = probe_equilibria(assembler, options, solution.state, solution.report, solution.probe_options);
    }
  }
  return solution;
}

int command_static(const Request& request) {
  if (!request.vary.empty()) return command_static_vary(request);
  const Scene scene = read_request(request);
  const Model model = build_requested_model(scene);
  std::optional<OutputFolder> folder;
  if (!request.out.empty()) folder.emplace(request.out);

  const Assembler assembler(model, scene.solve.threads);
  const StaticSolution solution = solve_requested_static(request, scene, assembler);
  const bool converged = solution.report.converged;
  if (request.json) fmt::print("{}\n", static_document(model, solution, request.stations).dump(2));
  if (!request.json && converged) fmt::print("{}", static_text(scene, model, solution));
  if (!converged) {
    say_failure(solution.report.failure);
    fmt::print(stderr, "{}", mode_text(model, solution.mode));
  }

  if (folder) {
    write_result(folder->begin(), request, scene, model, solution);
    const fs::path kept = converged ? folder->commit() : folder->keep_as("failed");
    draw(kept, scene, model, solution.state);
    fmt::print(stderr, "{} {}\n", converged ? "results and pictures in" : "the last iterate, which is no equilibrium, is kept in", kept.string());
  }
  return static_cast<int>(converged ? ExitCode::done : ExitCode::no_equilibrium);
}

}  // namespace hawser
