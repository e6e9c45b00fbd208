#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "assembly/observables.hpp"
#include "assembly/seabed.hpp"
#include "solver/app/certificate.hpp"
#include "solver/app/command_static.hpp"
#include "solver/app/text.hpp"
#include "solver/end_stiffness.hpp"

namespace hawser {
namespace {

using Json = nlohmann::ordered_json;

std::vector<Station> stations_for(const Model& model, const State& state, int line, int count) {
  if (count == 0) return observe_nodes(model, state, line);
  std::vector<double> s(static_cast<std::size_t>(count));
  const double length = model.lines[static_cast<std::size_t>(line)].length;
  for (int i = 0; i < count; ++i) s[static_cast<std::size_t>(i)] = length * i / (count - 1);
  return observe_stations(model, state, line, s);
}

Json stations_json(const std::vector<Station>& stations) {
  Json json = {{"s", Json::array()},       {"x", Json::array()},         {"y", Json::array()},    {"z", Json::array()},
               {"tension", Json::array()}, {"curvature", Json::array()}, {"twist", Json::array()}};
  for (const Station& station : stations) {
    json["s"].push_back(station.s);
    json["x"].push_back(station.position.x());
    json["y"].push_back(station.position.y());
    json["z"].push_back(station.position.z());
    json["tension"].push_back(station.tension);
    json["curvature"].push_back(station.curvature);
    json["twist"].push_back(0.0);  // bar, cable and beam carry no torque
  }
  return json;
}

Json seabed_json(const Model& model, const State& state, int index, const SeabedContact& contact) {
  Json places = Json::array();
  for (const Station& station : observe_stations(model, state, index, contact.touchdown)) places.push_back(vector_document(station.position));
  return {{"touchdown_positions", places},
          {"length", contact.length},
          {"force", contact.force},
          {"penetration_max", contact.largest_penetration},
          {"penetration_max_s", contact.largest_penetration_s}};
}

/// Rows of a matrix; null where it is not known.
Json to_json(const Eigen::MatrixXd& matrix) {
  if (matrix.size() == 0) return nullptr;
  Json rows = Json::array();
  for (const auto row : matrix.rowwise()) rows.push_back(std::vector<double>(row.begin(), row.end()));
  return rows;
}

Json line_json(const Model& model, const StaticSolution& solution, int index, int stations) {
  const Line& line = model.lines[static_cast<std::size_t>(index)];
  const LineResult result = observe_line(model, solution.state, index);
  Json json;
  json["tension_from"] = result.tension_from;
  json["tension_to"] = result.tension_to;
  json["elements"] = line.elements;
  json["error_estimate"] = solution.error_estimates[static_cast<std::size_t>(index)];
  const SeabedContact contact = observe_seabed(model, solution.state, index);
  json["touchdown"] = contact.touchdown;
  json["moment_from"] = vector_document(result.moment_from);
  json["moment_to"] = vector_document(result.moment_to);
  json["torque_from"] = 0.0;
  json["torque_to"] = 0.0;
  json["model"] = name_of(line.family);
  json["length"] = line.length;
  json["tension_min"] = result.tension_min;
  json["tension_min_s"] = least_tension_place(line, result);
  json["tension_max"] = result.tension_max;
  json["curvature_max"] = result.curvature_max;
  json["curvature_max_s"] = result.curvature_max_s;
  json["compressed_length"] = result.compressed_length;
  if (model.seabed) json["seabed"] = seabed_json(model, solution.state, index, contact);
  json["stations"] = stations_json(stations_for(model, solution.state, index, stations));
  return json;
}

/// A force for people: what is below the accuracy of the solve is rounding and shown as zero.
std::string force_text(double force, const StaticReport& report) {
  return with_prefix(std::abs(force) < 1e-9 * report.reference_force ? 0.0 : force, "N");
}

/// How the force at every held end answers to its displacement: three rows an end, and a blank line.
std::string stiffness_text(const Model& model, const StaticSolution& solution) {
  std::vector<std::vector<std::string>> rows{{"end stiffness", "of force", "for x", "for y", "for z"}};
  for (const EndStiffness& end : end_stiffness(model, solution.state)) {
    if (end.value.size() == 0) continue;
    const Line& line = model.lines[static_cast<std::size_t>(end.line)];
    const double largest = std::max(end.value.topLeftCorner(3, 3).cwiseAbs().maxCoeff(), solution.report.reference_force / line.length);
    for (int i = 0; i < 3; ++i) {
      const std::string place = line.name + (end.at_from ? " from" : " to");
      std::vector<std::string> row{i == 0 ? place : "", std::string(1, "xyz"[i])};
      for (int k = 0; k < 3; ++k) row.push_back(with_prefix(std::abs(end.value(i, k)) < 1e-6 * largest ? 0.0 : end.value(i, k), "N/m"));
      rows.push_back(row);
    }
  }
  return rows.size() > 1 ? '\n' + table(rows) : "";
}

/// What rests on the bed, a row for every line that touches it and every point whose body does, and a blank line.
std::string seabed_text(const Model& model, const State& state, std::span<const PointResult> points) {
  std::vector<std::vector<std::string>> rows{{"on the seabed", "touchdown at s [m]", "length", "force", "deepest"}};
  for (int i = 0; i < static_cast<int>(model.lines.size()); ++i) {
    const SeabedContact c = observe_seabed(model, state, i);
    if (c.length == 0.0) continue;
    std::string places;
    for (const double s : c.touchdown) places += fmt::format("{}{:.2f}", places.empty() ? "" : ", ", s);
    rows.push_back({model.lines[static_cast<std::size_t>(i)].name, places.empty() ? "none" : places, fmt::format("{:.6g} m", c.length),
                    with_prefix(c.force, "N"), fmt::format("{:.2g} m at s = {:.6g} m", c.largest_penetration, c.largest_penetration_s)});
  }
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].bed.z() > 0.0) rows.push_back({model.points[i].name, "", "", with_prefix(points[i].bed.z(), "N"), ""});
  return rows.size() > 1 ? table(rows) + '\n' : "";
}

}  // namespace

Json vector_document(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

Json points_document(const Model& model, std::span<const PointResult> points) {
  Json json = Json::object();
  for (std::size_t i = 0; i < points.size(); ++i) {
    json[model.points[i].name] = {{"position", vector_document(points[i].position)}, {"force", vector_document(points[i].force)}};
    if (model.seabed && model.points[i].free) json[model.points[i].name]["seabed_force"] = vector_document(points[i].bed);
  }
  return json;
}

Json failure_document(const Failure& failure) {
  return {{"what", failure.what},   {"line", failure.line},     {"s", failure.s},      {"stage", failure.stage},
          {"cause", failure.cause}, {"remedy", failure.remedy}, {"kept", failure.kept}};
}

Json static_document(const Model& model, const StaticSolution& solution, int stations) {
  const StaticReport& report = solution.report;
  Json json;
  json["converged"] = report.converged;
  json["iterations"] = report.iterations;
  json["residual"] = report.residual;
  json["wall_seconds"] = solution.wall_seconds;
  json["stable"] = report.stable;
  json["stability"] = stability_of(solution);
  json["negative_pivots"] = report.negative_pivots;
  json["mode"] = mode_document(model, solution.mode);
  json["residual_force"] = report.residual_force;
  json["reference_force"] = report.reference_force;
  json["roundoff_floor"] = report.roundoff_floor;
  json["linear_solver"] = report.linear_solver;
  json["modified_newton"] = report.modified_newton;
  json["stages"] = report.stages;
  json["unknowns"] = model.unknowns;
  json["lines"] = Json::object();
  json["points"] = Json::object();
  if (!report.converged) {
    json["failure"] = failure_document(report.failure);
    return json;
  }
  for (int line = 0; line < static_cast<int>(model.lines.size()); ++line) {
    json["lines"][model.lines[static_cast<std::size_t>(line)].name] = line_json(model, solution, line, stations);
  }
  for (const EndStiffness& end : end_stiffness(model, solution.state)) {
    json["lines"][model.lines[static_cast<std::size_t>(end.line)].name][end.at_from ? "stiffness_from" : "stiffness_to"] = to_json(end.value);
  }
  json["points"] = points_document(model, observe_points(model, solution.state));
  if (solution.probe) json["probe"] = probe_document(model, *solution.probe, solution.probe_options);
  return json;
}

std::string static_text(const Scene& scene, const Model& model, const StaticSolution& solution) {
  const StaticReport& report = solution.report;
  std::vector<std::vector<std::string>> lines{
      {"line", "model", "elements", "length", "tension from", "tension to", "least", "at s [m]", "greatest", "compressed", "error"}};
  for (int i = 0; i < static_cast<int>(model.lines.size()); ++i) {
    const Line& line = model.lines[static_cast<std::size_t>(i)];
    const LineResult r = observe_line(model, solution.state, i);
    const double error = solution.error_estimates[static_cast<std::size_t>(i)];
    lines.push_back({line.name, name_of(line.family), fmt::format("{}", line.elements), fmt::format("{:.6g} m", line.length),
                     force_text(r.tension_from, report), force_text(r.tension_to, report), force_text(r.tension_min, report),
                     fmt::format("{:.6g}", least_tension_place(line, r)), force_text(r.tension_max, report),
                     fmt::format("{:.4g} m", r.compressed_length), std::isfinite(error) ? fmt::format("{:.1e}", error) : "?"});
  }
  std::vector<std::vector<std::string>> points{{"point", "x [m]", "y [m]", "z [m]", "force x", "force y", "force z"}};
  const std::vector<PointResult> results = observe_points(model, solution.state);
  for (std::size_t i = 0; i < results.size(); ++i) {
    std::vector<std::string> row{model.points[i].name};
    for (int axis = 0; axis < 3; ++axis) row.push_back(fmt::format("{:.3f}", results[i].position[axis]));
    for (int axis = 0; axis < 3; ++axis) row.push_back(force_text(results[i].force[axis], report));
    points.push_back(row);
  }
  const std::string on_bed = model.seabed ? seabed_text(model, solution.state, results) : "";
  const std::string probe = solution.probe ? probe_text(model, *solution.probe, solution.probe_options) : "";
  return fmt::format("{}\n{} equilibrium after {} factorizations ({}), residual {:.1e} of {}, {:.3g} s\n\n{}{}\n{}{}{}{}", scene.title,
                     stability_of(solution), report.iterations, report.linear_solver, report.residual, with_prefix(report.reference_force, "N"),
                     solution.wall_seconds, mode_text(model, solution.mode), table(lines), on_bed, table(points), stiffness_text(model, solution),
                     probe);
}

}  // namespace hawser
