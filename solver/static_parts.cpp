#include "solver/static_parts.hpp"

#include <algorithm>

#include "assembly/numbering.hpp"
#include "solver/static_start_loads.hpp"

namespace hawser {
namespace {

constexpr int most_iterations = 600;  // factorizations of one line

/// The line's own part of values of all elements or nodes.
template <class T>
std::vector<T> part(const std::vector<T>& all, int first, int count) {
  return {all.begin() + first, all.begin() + first + count};
}

ElementArrays elements_of(const ElementArrays& all, const Line& line) {
  const auto of = [&](const std::vector<double>& values) { return part(values, line.first_element, line.elements); };
  return {of(all.length),
          of(all.EA),
          of(all.EI),
          of(all.axial_damping),
          of(all.mass),
          of(all.weight),
          of(all.drag_normal),
          of(all.drag_tangential),
          of(all.added_normal),
          of(all.added_tangential),
          of(all.minimum_tension),
          of(all.diameter)};
}

/// Those of the loads, joints or supports of all lines that are this one's, renumbered.
template <class T>
std::vector<T> those_of(const std::vector<T>& all, int line) {
  std::vector<T> own;
  for (const T& each : all)
    if (each.line == line) own.push_back(each), own.back().line = 0;
  return own;
}

Vec3 end_position(const Model& model, int line, int node, const State& state) { return Eigen::Map<const Vec3>(&state.q[model.dof(line, node)]); }

/// Unknowns of a line in the vectors of all lines and, in the same order, in its own.
std::vector<std::size_t> unknowns_of(const Model& model, int line) {
  std::vector<std::size_t> unknowns;
  for (std::size_t i = 0; i < model.chain(line).dofs(); ++i) unknowns.push_back(model.chain(line).first_dof + i);
  for (const Joint& joint : model.joints)
    for (int k = 0; joint.line == line && k < joint.inner_count(); ++k) unknowns.push_back(joint.inner + static_cast<std::size_t>(k));
  return unknowns;
}

}  // namespace

Model line_apart(const Model& model, int index, const State& state) {
  const Line& line = model.lines[index];
  Model alone;
  alone.current = model.current;
  alone.gravity = model.gravity;
  alone.water_density = model.water_density;
  alone.wet = model.wet;
  alone.tow = model.tow;
  alone.element = elements_of(model.element, line);
  alone.node_length = part(model.node_length, line.first_node, line.nodes);
  alone.joints = those_of(model.joints, index);
  alone.bodies = those_of(model.bodies, index);
  alone.spread_loads = those_of(model.spread_loads, index);
  alone.supports = those_of(model.supports, index);
  for (Support& support : alone.supports) support.point = support.node == 0 ? 0 : 1;
  for (Joint& joint : alone.joints) joint.element -= line.first_element;
  for (SpreadLoad& load : alone.spread_loads) load.element -= line.first_element;
  alone.points = {model.points[line.from], model.points[line.to]};
  alone.lines = {line};
  Line& own = alone.lines[0];
  own.first_node = own.first_element = own.from = 0;
  own.to = 1;
  own.from_hub = own.to_hub = -1;
  for (const auto& [hub, node, point] : {std::tuple{line.from_hub, 0, 0}, std::tuple{line.to_hub, line.nodes - 1, 1}}) {
    if (hub < 0) continue;
    const Vec3 here = end_position(model, index, node, state);
    alone.points[point] = {alone.points[point].name, false, here, Motion(here, std::nullopt)};
    alone.supports.push_back({0, node, point, true, false, Vec3::UnitX()});
    std::erase_if(alone.bodies, [&, at = node](const Body& body) { return body.node == at; });
  }
  if (model.seabed) {
    const Seabed& bed = *model.seabed;
    alone.seabed = Seabed{
        bed.surface,         bed.law, part(bed.lay, line.first_node, line.nodes), part(bed.lay_slope, line.first_node, line.nodes), {bed.laid[index]},
        bed.friction_tangent};
  }
  alone.chains = {model.chain(index)};
  number_unknowns(alone);
  return alone;
}

LinesApart solve_lines_apart(const Model& model, const StaticOptions& options, bool warm, State& state) {
  LinesApart result;
  StaticOptions own_options = options;
  own_options.start = warm ? StaticStart::given : StaticStart::catenary;
  own_options.max_iterations = std::min(options.max_iterations, most_iterations);
  own_options.log = nullptr;
  for (int line = 0; line < static_cast<int>(model.lines.size()); ++line) {
    if (load_scale(model, line) == 0.0) continue;
    const Model alone = line_apart(model, line, state);
    const std::vector<std::size_t> all = unknowns_of(model, line), own = unknowns_of(alone, 0);
    State shape = alone.make_state();
    for (std::size_t i = 0; i < own.size(); ++i) shape.q[own[i]] = state.q[all[i]], shape.v[own[i]] = state.v[all[i]];
    const StaticReport report = solve_static(Assembler(alone), own_options, shape);
    result.factorizations += report.iterations * static_cast<double>(alone.unknowns) / static_cast<double>(model.unknowns);
    if (!report.converged) {
      ++result.unsolved;
      continue;
    }
    for (std::size_t i = 0; i < own.size(); ++i) state.q[all[i]] = shape.q[own[i]];
  }
  return result;
}

}  // namespace hawser
