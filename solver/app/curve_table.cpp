#include "solver/app/curve_table.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstdio>
#include <limits>

#include "solver/app/command_static.hpp"

namespace hawser {
namespace {

using Json = nlohmann::ordered_json;

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

}  // namespace

struct CurveTable::Column {
  std::string name;
  double value;
};

/// What a row of curve.csv says of an equilibrium. The names depend on the model alone.
std::vector<CurveTable::Column> CurveTable::columns_of(const Model& model, const Observation& o) {
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

void CurveTable::add(const CurveRow& row, const Model& model, const State& state, const Failure& failure) {
  const std::vector<std::vector<double>> no_stations(model.lines.size());
  const Observation observation = row.converged ? observe(model, state, no_stations) : blank(model);
  const std::vector<Column> columns = columns_of(model, observation);
  if (csv_.empty()) write_header(columns);
  parts_.branches = std::max(parts_.branches, row.branch);
  parts_.unstable = parts_.unstable || (row.converged && !row.stable);
  // A failed value keeps its row; what is left of its solve is no equilibrium and not shown.
  std::string line = fmt::format("{},{:d},{:d},{},{},{:d},{:d},{:d},{},{}", row.value, row.converged, row.stable, row.negative_pivots, row.branch,
                                 row.fold, row.bifurcation, row.warm, row.iterations, row.residual);
  for (const Column& column : columns) line += fmt::format(",{}", row.converged ? column.value : std::numeric_limits<double>::quiet_NaN());
  write(line + '\n');

  Json item = {{"value", row.value},
               {"set", row.setting},
               {"converged", row.converged},
               {"stable", row.stable},
               {"negative_pivots", row.negative_pivots},
               {"branch", row.branch},
               {"fold", row.fold},
               {"bifurcation", row.bifurcation},
               {"warm", row.warm},
               {"iterations", row.iterations},
               {"residual", row.residual},
               {"lines", Json::object()},
               {"points", Json::object()}};
  if (row.converged) add_equilibrium(item, model, observation);
  if (!row.converged) item["failure"] = failure_document(failure);
  json_.push_back(std::move(item));
}

void CurveTable::write_header(const std::vector<Column>& columns) {
  std::string line = "value,converged,stable,negative_pivots,branch,fold,bifurcation,warm,iterations,residual";
  for (const Column& column : columns) line += ',' + column.name;
  write(line + '\n');
}

void CurveTable::write(const std::string& line) {
  csv_ += line;
  if (!echo_) return;
  fmt::print("{}", line);
  std::fflush(stdout);
}

}  // namespace hawser
