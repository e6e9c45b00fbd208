#include "solver/app/command_static_vary.hpp"

#include <fmt/core.h>

#include <fstream>
#include <iterator>
#include <limits>
#include <set>

#include "solver/app/command_static.hpp"
#include "solver/app/plots_curve.hpp"
#include "solver/app/recorder_folder.hpp"
#include "solver/app/recorder_series.hpp"
#include "solver/app/text.hpp"
#include "solver/app/variation.hpp"
#include "solver/curve.hpp"

namespace hawser {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;

/// The request of one value, as a user would write it for a single static.
Request request_at(const Request& request, const Variation& vary, int i) {
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

struct Column {
  std::string name;
  double value;
};

/// What a row of curve.csv says of the equilibrium. The names depend on the model alone.
std::vector<Column> columns_of(const Model& model, const Observation& o) {
  std::vector<Column> columns;
  const auto add_vector = [&](const std::string& name, const Vec3& v) {
    for (int axis = 0; axis < 3; ++axis) columns.push_back({name + "xyz"[axis], v[axis]});
  };
  for (std::size_t i = 0; i < model.lines.size(); ++i) {
    const std::string name = model.lines[i].name + '.';
    const LineResult& line = o.lines[i];
    columns.push_back({name + "tension_from", line.tension_from});
    columns.push_back({name + "tension_to", line.tension_to});
    columns.push_back({name + "tension_max", line.tension_max});
    columns.push_back({name + "tension_min", line.tension_min});
    columns.push_back({name + "curvature_max", line.curvature_max});
    add_vector(name + "force_from_", line.force_from);
    add_vector(name + "force_to_", line.force_to);
    if (model.seabed) columns.push_back({name + "touchdown", o.seabed[i].first_touchdown()});
    const ClampedEnds clamped = clamped_ends(model, static_cast<int>(i));
    if (clamped.from) columns.push_back({name + "moment_from", line.moment_from.norm()});
    if (clamped.to) columns.push_back({name + "moment_to", line.moment_to.norm()});
  }
  for (std::size_t i = 0; i < model.points.size(); ++i) {
    add_vector(model.points[i].name + '.', o.points[i].position);
    add_vector(model.points[i].name + ".force_", o.points[i].force);
  }
  return columns;
}

/// For a value without an equilibrium: the right number of everything, for the names of the columns.
Observation blank(const Model& model) {
  Observation o;
  o.lines.resize(model.lines.size());
  o.seabed.resize(model.lines.size());
  o.points.resize(model.points.size());
  return o;
}

/// The same as one item of the JSON array, spelled as in `static --json`.
void add_equilibrium(Json& row, const Model& model, const Observation& o) {
  for (std::size_t i = 0; i < model.lines.size(); ++i) {
    const LineResult& line = o.lines[i];
    row["lines"][model.lines[i].name] = {{"tension_from", line.tension_from},
                                         {"tension_to", line.tension_to},
                                         {"tension_max", line.tension_max},
                                         {"tension_min", line.tension_min},
                                         {"curvature_max", line.curvature_max},
                                         {"force_from", vector_document(line.force_from)},
                                         {"force_to", vector_document(line.force_to)},
                                         {"touchdown", o.seabed[i].touchdown},
                                         {"moment_from", vector_document(line.moment_from)},
                                         {"moment_to", vector_document(line.moment_to)}};
  }
  row["points"] = points_document(model, o.points);
}

/// The rows of a curve in both spellings.
class CurveTable {
 public:
  /// echo: CSV rows go to stdout too, as they come.
  explicit CurveTable(bool echo) : echo_(echo) {}

  void add(double value, const std::string& setting, const Model& model, const State& state, const CurveReport& report) {
    const StaticReport& statics = report.statics;
    const std::vector<std::vector<double>> no_stations(model.lines.size());
    const Observation observation = statics.converged ? observe(model, state, no_stations) : blank(model);
    const std::vector<Column> columns = columns_of(model, observation);
    if (csv_.empty()) write_header(columns);
    // A failed value keeps its row; what is left of its solve is no equilibrium and not shown.
    std::string line =
        fmt::format("{},{:d},{:d},{:d},{},{}", value, statics.converged, statics.stable, report.warm, statics.iterations, statics.residual);
    for (const Column& column : columns) line += fmt::format(",{}", statics.converged ? column.value : std::numeric_limits<double>::quiet_NaN());
    write(line + '\n');

    Json row = {{"value", value},
                {"set", setting},
                {"converged", statics.converged},
                {"stable", statics.stable},
                {"warm", report.warm},
                {"iterations", statics.iterations},
                {"residual", statics.residual},
                {"lines", Json::object()},
                {"points", Json::object()}};
    if (statics.converged) add_equilibrium(row, model, observation);
    if (!statics.converged) row["failure"] = failure_document(statics.failure);
    json_.push_back(std::move(row));
  }

  const std::string& csv() const { return csv_; }
  const Json& json() const { return json_; }

 private:
  void write_header(const std::vector<Column>& columns) {
    std::string line = "value,converged,stable,warm,iterations,residual";
    for (const Column& column : columns) line += ',' + column.name;
    write(line + '\n');
  }

  void write(const std::string& line) {
    csv_ += line;
    if (!echo_) return;
    fmt::print("{}", line);
    std::fflush(stdout);
  }

  bool echo_;
  std::string csv_;
  Json json_ = Json::array();
};

struct Tally {
  int converged = 0, warm = 0, iterations = 0;
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

Tally solve_values(const Request& request, const Variation& vary, CurveTable& table) {
  StaticCurve curve;
  Tally tally;
  for (int i = 0; i < vary.count; ++i) {
    const Request one = request_at(request, vary, i);
    std::vector<Diagnostic> warnings;  // said by check_values
    const Scene scene = read_value(one, warnings);
    const Model model = build_requested_model(scene);
    const Assembler assembler(model, scene.solve.threads);
    StaticOptions options = requested_static_options(one, scene);
    State state = requested_start(one, scene, model, options);
    const CurveReport report = curve.next(assembler, i, options, state);
    table.add(vary.value(i), one.overrides.back(), model, state, report);
    tell_value(request, one.overrides.back(), report);
    tally.converged += report.statics.converged;
    tally.warm += report.warm;
    tally.iterations += report.statics.iterations;
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
    const std::string trouble = draw_curve(kept, scene.title, vary.key + unit, build_requested_model(scene));
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
  }
  if (folder) write_folder(*folder, request, vary, table, tally.converged > 0);
  if (tally.converged == vary.count) return static_cast<int>(ExitCode::done);
  return static_cast<int>(tally.converged > 0 ? ExitCode::failed_cases : ExitCode::no_equilibrium);
}

}  // namespace hawser
