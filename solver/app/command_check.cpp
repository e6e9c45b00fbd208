#include "solver/app/command_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solver/app/text.hpp"

namespace hawser {
namespace {

using Json = nlohmann::ordered_json;

/// Microseconds of one Newton iteration per element on an x86-64 core of about 4 GHz with AVX2: assembly and solution.
constexpr double bar_microseconds = 0.1, beam_microseconds = 0.3;
/// And of a solution alone: where lines meet at free points, three for every end that a line has there (bordered_solver.hpp).
constexpr double bar_solution_microseconds = 0.01, beam_solution_microseconds = 0.03;
constexpr double static_iterations = 10.0, iterations_a_step = 3.0;

bool any_in(const std::vector<double>& values, const Line& line) {
  const auto first = values.begin() + line.first_element;
  return std::any_of(first, first + line.elements, [](double value) { return value != 0.0; });
}

const LineType& type_named(const Scene& scene, const std::string& name) {
  return *std::find_if(scene.line_types.begin(), scene.line_types.end(), [&](const LineType& type) { return type.name == name; });
}

double chord(const Model& model, const Line& line) {
  return (model.points[static_cast<std::size_t>(line.to)].position - model.points[static_cast<std::size_t>(line.from)].position).norm();
}

int joints_of(const Model& model, int line) {
  return static_cast<int>(std::count_if(model.joints.begin(), model.joints.end(), [line](const Joint& joint) { return joint.line == line; }));
}

/// How many line ends meet at a free point; 0 where that is not more than one.
std::size_t ends_meeting(const Model& model, int point) {
  const auto hub = std::find_if(model.hubs.begin(), model.hubs.end(), [point](const Hub& h) { return h.point == point; });
  return hub == model.hubs.end() ? 0 : hub->ends.size();
}

std::string describe(const Model& model, int point) {
  const ModelPoint& p = model.points[static_cast<std::size_t>(point)];
  const std::size_t ends = ends_meeting(model, point);
  const std::string kind = ends > 0 ? fmt::format("free, {} line ends meet,", ends) : p.free ? "free" : p.motion.moves() ? "moved" : "fixed";
  return fmt::format("{} ({} {:.6g}, {:.6g}, {:.6g})", p.name, kind, p.position.x(), p.position.y(), p.position.z());
}

Json line_json(const Scene& scene, const Model& model, int index) {
  const Line& line = model.lines[static_cast<std::size_t>(index)];
  const LineSpec& spec = scene.lines[static_cast<std::size_t>(index)];
  Json json = {{"from", model.points[static_cast<std::size_t>(line.from)].name},
               {"to", model.points[static_cast<std::size_t>(line.to)].name},
               {"length", line.length},
               {"model", name_of(line.family)},
               {"terms", terms_of(model, line)},
               {"elements", line.elements},
               {"joints", joints_of(model, index)},
               {"loads", spec.loads.size()},
               {"sections", Json::array()}};
  for (const SectionSpec& section : spec.sections) {
    json["sections"].push_back(
        {{"type", section.type}, {"length", section.length}, {"elements", section.elements}, {"element_size", section.length / section.elements}});
  }
  return json;
}

Json check_document(const Scene& scene, const Model& model, const std::vector<std::string>& warnings) {
  const CostEstimate cost = estimate_cost(scene, model);
  Json json = {{"title", scene.title}, {"lines", Json::object()}};
  for (int i = 0; i < static_cast<int>(model.lines.size()); ++i)
    json["lines"][model.lines[static_cast<std::size_t>(i)].name] = line_json(scene, model, i);
  json["meeting_points"] = Json::object();
  for (const Hub& hub : model.hubs) json["meeting_points"][model.points[static_cast<std::size_t>(hub.point)].name] = hub.ends.size();
  json["unknowns"] = model.unknowns;
  json["elements"] = model.total_elements();
  json["linear_solver"] = scene.solve.linear_solver;
  json["threads"] = scene.solve.threads;
  json["estimates"] = {
      {"bytes", cost.bytes}, {"steps", cost.steps}, {"static_seconds", cost.static_seconds}, {"dynamic_seconds", cost.dynamic_seconds}};
  json["warnings"] = warnings;
  return json;
}

std::string line_text(const Scene& scene, const Model& model, int index) {
  const Line& line = model.lines[static_cast<std::size_t>(index)];
  const LineSpec& spec = scene.lines[static_cast<std::size_t>(index)];
  std::string text = fmt::format("line {}: {:.6g} m, {} elements, {} ({})\n", line.name, line.length, line.elements, name_of(line.family),
                                 fmt::join(terms_of(model, line), ", "));
  text += fmt::format("  from {}{}\n  to   {}{}\n", describe(model, line.from), spec.from_end.clamped ? ", clamped" : "", describe(model, line.to),
                      spec.to_end.clamped ? ", clamped" : "");
  for (const SectionSpec& section : spec.sections) {
    const LineType& type = type_named(scene, section.type);
    text += fmt::format("  section {}: {:.6g} m in {} elements of {:.4g} m; d {:.4g} m, {:.4g} kg/m, EA {:.4g} N, EI {:.4g} N m2\n", section.type,
                        section.length, section.elements, section.length / section.elements, type.diameter, type.mass, type.EA, type.EI);
  }
  for (const LoadSpec& load : spec.loads) {
    text += fmt::format("  load at {:.6g} m{}{}{}\n", load.at, load.body.mass > 0.0 ? fmt::format(", {:.4g} kg", load.body.mass) : "",
                        load.body.wet_weight ? fmt::format(", {:.4g} N down", *load.body.wet_weight) : "",
                        load.over > 0.0 ? fmt::format(", spread over {:.4g} m", load.over) : "");
  }
  const int joints = joints_of(model, index);
  if (joints > 0) text += fmt::format("  {} joint{} where the slope jumps\n", joints, joints == 1 ? "" : "s");
  return text;
}

std::string bed_text(const Environment& sea) {
  const SeabedSpec& bed = sea.seabed;
  if (!sea.depth && !bed.bathymetry) return "";
  std::string text = sea.depth ? fmt::format(", depth {:.6g} m", *sea.depth)
                               : fmt::format(", seabed of {} x {} soundings", bed.bathymetry->x.size(), bed.bathymetry->y.size());
  text += fmt::format(", bed {:.4g} N/m2", bed.stiffness);
  if (bed.friction_axial == bed.friction_lateral)
    return text + (bed.friction_axial > 0.0 ? fmt::format(", friction {:.3g}", bed.friction_axial) : "");
  return text + fmt::format(", friction {:.3g} axial, {:.3g} lateral", bed.friction_axial, bed.friction_lateral);
}

std::string check_text(const Scene& scene, const Model& model) {
  const Environment& sea = scene.environment;
  const CostEstimate cost = estimate_cost(scene, model);
  std::string text =
      fmt::format("{}\ngravity {:.6g} m/s2, water {:.6g} kg/m3, {}{}\n\n", scene.title, sea.gravity, sea.water_density,
                  sea.current.empty() ? std::string("no current") : fmt::format("current up to {:.3g} m/s", model.current.fastest()), bed_text(sea));
  for (int i = 0; i < static_cast<int>(model.lines.size()); ++i) text += line_text(scene, model, i) + '\n';
  text += fmt::format("{} unknowns, linear solver {}, {} thread{}, about {}\n", model.unknowns, scene.solve.linear_solver, scene.solve.threads,
                      scene.solve.threads == 1 ? "" : "s", with_prefix(cost.bytes, "B"));
  text += fmt::format("estimate for one core: static {:.2g} s", cost.static_seconds);
  if (scene.dynamics) {
    text += fmt::format("; run {:.2g} s ({:.6g} s in {} steps of {:.4g} s, {} iterations a step)", cost.dynamic_seconds, scene.dynamics->duration,
                        cost.steps, scene.dynamics->step, iterations_a_step);
  }
  return text + '\n';
}

}  // namespace

std::vector<std::string> terms_of(const Model& model, const Line& line) {
  const ElementArrays& e = model.element;
  std::vector<std::string> terms{"axial"};
  if (line.family == Family::beam) terms.emplace_back("bending");
  if (any_in(e.weight, line)) terms.emplace_back("weight");
  terms.emplace_back("inertia");
  if (any_in(e.drag_normal, line) || any_in(e.drag_tangential, line)) terms.emplace_back("drag");
  if (any_in(e.added_normal, line) || any_in(e.added_tangential, line)) terms.emplace_back("added mass");
  if (any_in(e.axial_damping, line)) terms.emplace_back("axial damping");
  if (model.seabed) terms.emplace_back("seabed");
  if (model.rubs()) terms.emplace_back("seabed friction");
  return terms;
}

CostEstimate estimate_cost(const Scene& scene, const Model& model) {
  CostEstimate cost;
  double iteration = 0.0;  // s
  int ends_at_hubs = 0;    // of one line, at most
  for (const Line& line : model.lines) ends_at_hubs = std::max(ends_at_hubs, (line.from_hub >= 0 ? 1 : 0) + (line.to_hub >= 0 ? 1 : 0));
  for (std::size_t i = 0; i < model.lines.size(); ++i) {
    const double block = model.chains[i].block;
    // Tangent and factors: 3 blocks a node each; about 20 vectors of unknowns; 12 properties an element.
    cost.bytes += 8.0 * (model.lines[i].nodes * (2.0 * 3.0 * block * block + 20.0 * block) + 12.0 * model.lines[i].elements);
    const bool bar = model.lines[i].family == Family::bar;
    const double solutions = 3.0 * ends_at_hubs * (bar ? bar_solution_microseconds : beam_solution_microseconds);
    iteration += 1e-6 * model.lines[i].elements * ((bar ? bar_microseconds : beam_microseconds) + solutions);
  }
  cost.static_seconds = static_iterations * iteration;
  if (!scene.dynamics) return cost;
  cost.steps = std::lround(std::ceil(scene.dynamics->duration / scene.dynamics->step - 1e-9));
  cost.dynamic_seconds = static_cast<double>(cost.steps) * iterations_a_step * iteration;
  return cost;
}

std::vector<std::string> odd_things(const Scene& scene, const Model& model) {
  std::vector<std::string> odd;
  for (std::size_t i = 0; i < model.lines.size(); ++i) {
    const Line& line = model.lines[i];
    const LineSpec& spec = scene.lines[i];
    const bool held = !model.points[static_cast<std::size_t>(line.from)].free && !model.points[static_cast<std::size_t>(line.to)].free;
    if (held && line.length < chord(model, line)) {
      odd.push_back(fmt::format("line {} is {:.4g} m shorter than the distance of its ends: it is stretched by {:.2g} %", line.name,
                                chord(model, line) - line.length, 100.0 * (chord(model, line) / line.length - 1.0)));
    }
    const bool stiff =
        std::any_of(spec.sections.begin(), spec.sections.end(), [&](const SectionSpec& s) { return type_named(scene, s.type).EI > 0.0; });
    if (stiff && line.family != Family::beam) odd.push_back(fmt::format("line {}: EI is not used by model \"{}\"", line.name, name_of(line.family)));
  }
  if (!scene.dynamics) return odd;
  for (const PointSpec& point : scene.points) {
    if (!point.motion) continue;
    for (const Harmonic& harmonic : point.motion->harmonics) {
      if (harmonic.period >= 20.0 * scene.dynamics->step) continue;
      odd.push_back(
          fmt::format("point {}: a period of {:.4g} s has only {:.3g} steps", point.name, harmonic.period, harmonic.period / scene.dynamics->step));
    }
  }
  return odd;
}

int command_check(const Request& request) {
  std::vector<Diagnostic> diagnostics;
  const Scene scene = read_request(request, &diagnostics);
  const Model model = build_requested_model(scene);
  std::vector<std::string> warnings = odd_things(scene, model);
  if (request.json) {
    for (const Diagnostic& diagnostic : diagnostics) warnings.push_back(diagnostic.message);
    fmt::print("{}\n", check_document(scene, model, warnings).dump(2));
    return static_cast<int>(ExitCode::done);
  }
  fmt::print("{}", check_text(scene, model));
  std::fflush(stdout);
  for (const Diagnostic& diagnostic : diagnostics) fmt::print(stderr, "{}", render(diagnostic));
  for (const std::string& warning : warnings) say_warning(warning);
  return static_cast<int>(ExitCode::done);
}

}  // namespace hawser
