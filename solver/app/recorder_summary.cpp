#include "solver/app/recorder_summary.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "solver/app/text.hpp"

namespace hawser {
namespace {

using Json = nlohmann::ordered_json;

Json error_estimates(const Model& model, const RunRecord& run) {
  Json json = Json::object();
  if (!run.equilibrium) return json;
  for (std::size_t i = 0; i < model.lines.size(); ++i) json[model.lines[i].name] = run.equilibrium->error_estimates[i];
  return json;
}

double per_step(long count, const SimulateCounters& counters) {
  return static_cast<double>(count) / static_cast<double>(std::max(counters.steps, 1L));
}

}  // namespace

std::string status_of(const SimulateReport& report) { return report.finished ? "finished" : report.interrupted ? "partial" : "failed"; }

Json run_summary(const Scene& scene, const Model& model, const RunRecord& run) {
  const SimulateCounters& counters = run.dynamics.counters;
  Json json;
  json["status"] = status_of(run.dynamics);
  json["time"] = run.dynamics.reached;
  json["duration"] = scene.dynamics->duration;
  json["steps"] = counters.steps;
  json["newton_iterations"] = counters.newton_iterations;
  json["factorizations"] = counters.factorizations;
  json["residuals"] = counters.residuals;
  json["rejected_steps"] = counters.rejected_steps;
  json["smallest_step"] = counters.smallest_step;
  json["largest_residual"] = counters.largest_residual;
  json["linear_solver"] = counters.linear_solver;
  json["modified_newton"] = counters.modified_newton;
  json["threads"] = scene.solve.threads;
  json["unknowns"] = model.unknowns;
  json["elements"] = model.total_elements();
  json["wall_seconds"] = {{"static", run.static_seconds}, {"dynamic", run.dynamic_seconds}, {"total", run.total_seconds}};
  json["error_estimates"] = {{"static_tension", error_estimates(model, run)}};
  if (run.equilibrium) {
    const StaticReport& report = run.equilibrium->report;
    json["static"] = {{"converged", report.converged}, {"iterations", report.iterations}, {"residual", report.residual}, {"stable", report.stable}};
  }
  if (!run.dynamics.finished && !run.dynamics.interrupted) json["failure"] = failure_document(run.dynamics.failure);
  return json;
}

void describe_run(ResultFile& file, const Scene& scene, const RunRecord& run) {
  const DynamicsSpec& dynamics = *scene.dynamics;
  const SimulateCounters& counters = run.dynamics.counters;
  file.set_solver("integrator", std::string("generalized-alpha"));
  file.set_solver("step", dynamics.step);
  file.set_solver("spectral_radius", dynamics.spectral_radius);
  file.set_solver("newton_tolerance", scene.solve.newton_tolerance ? decimal_text(*scene.solve.newton_tolerance) : std::string("auto"));
  file.set_solver("linear_solver", counters.linear_solver);
  file.set_solver("threads", static_cast<long>(scene.solve.threads));
  file.set_solver("steps", counters.steps);
  file.set_solver("newton_iterations", counters.newton_iterations);
  file.set_solver("factorizations", counters.factorizations);
  file.set_solver("residuals", counters.residuals);
  file.set_solver("rejected_steps", counters.rejected_steps);
  file.set_solver("largest_residual", counters.largest_residual);
  file.set_solver("wall_seconds", run.dynamic_seconds);
  file.set_status(status_of(run.dynamics));
}

std::string run_text(const Scene& scene, const Model& model, const RunRecord& run, const std::vector<TensionRange>& ranges) {
  const SimulateCounters& counters = run.dynamics.counters;
  std::string text =
      fmt::format("{}\n{:.6g} s simulated in {:.3g} s: {} steps ({} rejected), {:.2f} Newton iterations and {:.2f} factorizations a step ({})\n\n",
                  scene.title, run.dynamics.reached, run.total_seconds, counters.steps, counters.rejected_steps,
                  per_step(counters.newton_iterations, counters), per_step(counters.factorizations, counters), counters.linear_solver);
  std::vector<std::vector<std::string>> rows{{"line", "tension at", "least", "mean", "greatest"}};
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const TensionRange& range = ranges[i];
    if (range.count == 0) continue;
    const Line& line = model.lines[i];
    const double greatest = *std::max_element(range.high.begin(), range.high.end());
    // What is far below the accuracy of a step is rounding and shown as zero.
    const auto force = [&](double value) { return with_prefix(std::abs(value) < 1e-7 * greatest ? 0.0 : value, "N"); };
    const auto add = [&](const std::string& where, std::size_t k) {
      rows.push_back({line.name, where, force(range.low[k]), force(range.sum[k] / static_cast<double>(range.count)), force(range.high[k])});
    };
    add(model.points[static_cast<std::size_t>(line.from)].name, 0);
    add(model.points[static_cast<std::size_t>(line.to)].name, range.s.size() - 1);
  }
  return text + table(rows);
}

}  // namespace hawser
