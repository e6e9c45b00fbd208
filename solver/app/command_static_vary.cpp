#include "solver/app/command_static_vary.hpp"

#include <fmt/core.h>

#include <fstream>
#include <set>

#include "solver/app/command_static.hpp"
#include "solver/app/curve_table.hpp"
#include "solver/app/plots_curve.hpp"
#include "solver/app/recorder_folder.hpp"
#include "solver/app/text.hpp"
#include "solver/app/variation.hpp"

namespace hawser {
namespace fs = std::filesystem;
namespace {

/// The request of value number i, as a user would write it for a single static; between whole numbers lie values that nobody asked for.
Request request_at(const Request& request, const Variation& vary, double i) {
  Request one = request;
  one.overrides.push_back(vary.override_at(i));
  if (i > 0) one.from.clear();  // a stored state starts the first value
  return one;
}

/// The scene of one value; errors about the override point at --vary.
Scene read_value(const Request& one, std::vector<Diagnostic>& warnings) {
  try {
    return read_request(one, &warnings);
  } catch (const InputError& error) {
    std::vector<Diagnostic> diagnostics = error.diagnostics();
    for (Diagnostic& d : diagnostics) {
      if (d.where == "--set " + one.overrides.back()) d.where = fmt::format("--vary {}, at {}", one.vary, one.overrides.back());
    }
    throw InputError(diagnostics);
  }
}

/// Reads every value, so that a bad one is refused before anything is solved; every warning is said once.
void check_values(const Request& request, const Variation& vary) {
  std::set<std::string> said;
  for (int i = 0; i < vary.count; ++i) {
    std::vector<Diagnostic> warnings;
    build_requested_model(read_value(request_at(request, vary, i), warnings));
    for (const Diagnostic& warning : warnings) {
      if (said.insert(render(warning)).second) fmt::print(stderr, "{}\n", render(warning));
    }
  }
}

/// The model of any value: for what lies between those asked for. Nothing where the scene refuses it (half an element).
std::optional<Model> model_between(const Request& request, const Variation& vary, double i) {
  try {
    std::vector<Diagnostic> warnings;
    return build_requested_model(read_value(request_at(request, vary, i), warnings));
  } catch (const InputError&) {
    return std::nullopt;
  }
}

struct Tally {
  int converged = 0, warm = 0, passed = 0, folds = 0, bifurcations = 0, iterations = 0;
};

void tell_value(const Request& request, const std::string& setting, const CurveReport& report) {
  const StaticReport& statics = report.statics;
  if (!statics.converged) {
    Failure failure = statics.failure;
    failure.what = setting + ": " + failure.what;
    say_failure(failure);
  } else if (!request.quiet) {
    const char* start = report.warm ? "from the values before" : "from its own start";
    fmt::print(stderr, "static: {}: {} after {} factorizations\n", setting, start, statics.iterations);
  }
}

/// The rows of what a branch passed on its way from one value to the next.
void add_passed(const Request& request, const Variation& vary, const CurveReport& report, int branch, CurveTable& table, Tally& tally) {
  for (const PassedPoint& point : report.passed) {
    const std::optional<Model> model = model_between(request, vary, point.p);
    if (!model) continue;
    const std::string setting = vary.override_at(point.p);
    table.add({vary.value(point.p), setting, true, point.stable, point.fold, point.bifurcation, true, point.negative_pivots, branch, point.iterations,
               point.residual},
              *model, point.state);
    if (point.fold && !request.quiet) fmt::print(stderr, "static: {}: the branch folds\n", setting);
    if (point.bifurcation && !request.quiet) fmt::print(stderr, "static: {}: stability changes, another branch crosses\n", setting);
    (point.fold ? tally.folds : point.bifurcation ? tally.bifurcations : tally.passed) += 1;
    tally.iterations += point.iterations;
  }
}

Tally solve_values(const Request& request, const Variation& vary, CurveTable& table) {
  CurveWay way{[&](double p) { return model_between(request, vary, p); }, {}};
  for (int i = 0; i < vary.count; ++i) way.values.push_back(i);
  StaticCurve curve(std::move(way));
  Tally tally;
  int branch = 0;
  for (int i = 0; i < vary.count; ++i) {
    const Request one = request_at(request, vary, i);
    std::vector<Diagnostic> warnings;  // said by check_values
    const Scene scene = read_value(one, warnings);
    const Model model = build_requested_model(scene);
    const Assembler assembler(model, scene.solve.threads);
    StaticOptions options = requested_static_options(one, scene);
    State state = requested_start(one, scene, model, options);
    const CurveReport report = curve.next(assembler, i, options, state);
    const StaticReport& statics = report.statics;
    add_passed(request, vary, report, branch, table, tally);
    table.add({vary.value(i), one.overrides.back(), statics.converged, statics.stable, false, false, report.warm, statics.negative_pivots,
               report.branch, statics.iterations, statics.residual},
              model, state, statics.failure);
    tell_value(request, one.overrides.back(), report);
    if (statics.converged) branch = report.branch;
    tally.converged += statics.converged;
    tally.warm += report.warm;
    tally.iterations += statics.iterations;
  }
  return tally;
}

void write_folder(OutputFolder& folder, const Request& request, const Variation& vary, const CurveTable& table, bool some_converged) {
  const fs::path& running = folder.begin();
  std::ofstream(running / "curve.csv") << table.csv();
  std::ofstream(running / "curve.json") << table.json().dump(2) << '\n';
  const fs::path kept = some_converged ? folder.commit() : folder.keep_as("failed");
  if (some_converged) {
    std::vector<Diagnostic> warnings;
    const Scene scene = read_value(request_at(request, vary, 0), warnings);
    const std::string unit = vary.unit.empty() ? "" : " [" + vary.unit + "]";
    const std::string trouble = draw_curve(kept, scene.title, vary.key + unit, build_requested_model(scene), table.parts());
    if (!trouble.empty()) say_warning(trouble);
  }
  fmt::print(stderr, "{} {}\n", some_converged ? "the curve and its picture are in" : "the curve, of which no value converged, is kept in",
             kept.string());
}

}  // namespace

int command_static_vary(const Request& request) {
  const Variation vary = parse_variation("--vary", request.vary);
  check_values(request, vary);
  std::optional<OutputFolder> folder;
  if (!request.out.empty()) folder.emplace(request.out);

  CurveTable table(!request.json);
  const Tally tally = solve_values(request, vary, table);
  if (request.json) fmt::print("{}\n", table.json().dump(2));
  if (!request.quiet) {
    fmt::print(stderr, "static: {} of {} values converged, {} of them from the values before; {} factorizations\n", tally.converged, vary.count,
               tally.warm, tally.iterations);
    if (tally.folds + tally.bifurcations > 0)
      fmt::print(stderr, "static: {} folds, {} bifurcations; {} further equilibria next to them\n", tally.folds, tally.bifurcations, tally.passed);
  }
  if (folder) write_folder(*folder, request, vary, table, tally.converged > 0);
  if (tally.converged == vary.count) return static_cast<int>(ExitCode::done);
  return static_cast<int>(tally.converged > 0 ? ExitCode::failed_cases : ExitCode::no_equilibrium);
}

}  // namespace hawser
