#include "solver/app/command_run.hpp"

#include <fmt/core.h>

#include <chrono>
#include <fstream>

#include "solver/app/interrupt.hpp"
#include "solver/app/plots.hpp"
#include "solver/app/progress.hpp"
#include "solver/app/recorder_folder.hpp"
#include "solver/app/recorder_summary.hpp"
#include "solver/app/text.hpp"

namespace hawser {
namespace fs = std::filesystem;
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// The state at t = 0; where it is an equilibrium, its report goes to `run`.
State start_state(const Request& request, const Scene& scene, const Assembler& assembler, RunRecord& run) {
  const Model& model = assembler.model();
  if (scene.dynamics->start == StartChoice::straight) return straight_rest_state(model);
  if (scene.dynamics->start == StartChoice::file) return state_from_table(model, *scene.dynamics->start_table);
  run.equilibrium = solve_requested_static(request, scene, assembler);
  run.static_seconds = run.equilibrium->wall_seconds;
  return run.equilibrium->state;
}

/// No equilibrium to start from: keeps the last iterate for a look, under a name that says what it is.
int stop_without_start(const Request& request, const Scene& scene, const Model& model, const RunRecord& run, OutputFolder& folder) {
  const fs::path running = folder.begin();
  std::ofstream(running / "static.json") << static_document(model, *run.equilibrium, 0).dump(2) << '\n';
  {
    ResultFile result(running / "result.h5", scene, model, request.overrides, "static");
    result.append(run.equilibrium->state);
    result.write_state(run.equilibrium->state);
    result.set_status("failed");
  }
  if (request.json) fmt::print("{}\n", static_document(model, *run.equilibrium, 0).dump(2));
  say_failure(run.equilibrium->report.failure);
  fmt::print(stderr, "the last iterate, which is no equilibrium, is kept in {}\n", folder.keep_as("failed").string());
  return static_cast<int>(ExitCode::no_equilibrium);
}

void integrate(const Request& request, const Scene& scene, const Assembler& assembler, Recorder& recorder, State& state, RunRecord& run) {
  const InterruptGuard interrupt;
  Progress progress(scene.dynamics->duration, stderr, is_terminal(stderr));
  const auto observer = [&](const State& now, const SimulateCounters& counters) {
    recorder.record(now);
    if (!request.quiet) progress.update(now.t, counters, top_tension(assembler.model(), recorder.last()));
    return !interrupt.requested();
  };
  const Clock::time_point start = Clock::now();
  run.dynamics = simulate(assembler, simulate_options(scene), state, observer);
  run.dynamic_seconds = seconds_since(start);
  progress.finish();
}

void tell_outcome(const Request& request, const RunRecord& run, const fs::path& kept, const PlotReport& plots) {
  if (run.dynamics.interrupted) {
    const std::string saved = (kept / "result.h5").string();
    fmt::print(stderr, "interrupted at t = {:.6g} s; the rows up to then, the fields and the last state are in {}\n", run.dynamics.reached,
               kept.string());
    fmt::print(stderr, "  to see what is there: h5dump -n {}\n", saved);
  } else if (!run.dynamics.finished) {
    say_failure(run.dynamics.failure);
    fmt::print(stderr, "the run stopped at t = {:.6g} s; what was recorded until then is kept in {}\n", run.dynamics.reached, kept.string());
  }
  if (!plots.trouble.empty()) say_warning(plots.trouble);
  if (request.quiet) return;
  fmt::print(stderr, "results in {}\n", kept.string());
  for (const fs::path& picture : plots.pictures) fmt::print(stderr, "  {}\n", picture.string());
}

int exit_code(const SimulateReport& report) {
  if (report.finished) return static_cast<int>(ExitCode::done);
  return static_cast<int>(report.interrupted ? ExitCode::interrupted : ExitCode::integration_stopped);
}

}  // namespace

int command_run(const Request& request) {
  const Clock::time_point start = Clock::now();
  const Scene scene = read_request(request);
  if (!scene.dynamics) throw InputError(fmt::format("{} has no [dynamics]: nothing to run (hawser static computes its equilibrium)", scene.path));
  const SeabedSpec& bed = scene.environment.seabed;
  if (bed.friction_axial > 0.0 || bed.friction_lateral > 0.0)
    throw InputError(
        fmt::format("{}: friction of the seabed in motion is not built yet; `--set environment.seabed.friction=0` runs without", scene.path));
  const Model model = build_requested_model(scene);
  OutputFolder folder(request.out.empty() ? fs::path(scene.path).stem().string() + ".out" : request.out);

  const Assembler assembler(model, scene.solve.threads);
  RunRecord run;
  State state = start_state(request, scene, assembler, run);
  if (run.equilibrium && !run.equilibrium->report.converged) return stop_without_start(request, scene, model, run, folder);

  const fs::path running = folder.begin();
  PlotData plots{scene.title, model, {}, {}, true};
  {
    Recorder recorder(scene, model, request.overrides, running);
    integrate(request, scene, assembler, recorder, state, run);
    run.total_seconds = seconds_since(start);
    recorder.finish(state);
    describe_run(recorder.result_file(), scene, run);
    plots.shapes = recorder.shapes();
    plots.ranges = recorder.ranges();
  }
  const nlohmann::ordered_json summary = run_summary(scene, model, run);
  std::ofstream(running / "summary.json") << summary.dump(2) << '\n';
  const fs::path kept = run.dynamics.finished ? folder.commit() : folder.keep_as(status_of(run.dynamics));
  const PlotReport pictures = draw_plots(kept, plots);
  if (request.json) fmt::print("{}\n", summary.dump(2));
  if (!request.json && !request.quiet) fmt::print("{}", run_text(scene, model, run, plots.ranges));
  std::fflush(stdout);
  tell_outcome(request, run, kept, pictures);
  return exit_code(run.dynamics);
}

}  // namespace hawser
