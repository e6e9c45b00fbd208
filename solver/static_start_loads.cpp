#include "solver/static_start_loads.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hawser {

Vec3 drag_density(const Model& model, int element, const Vec3& tangent, double z) {
  const Vec3 flow = model.current.at(z) - model.tow;
  const Vec3 along = flow.dot(tangent) * tangent, across = flow - along;
  return model.element.drag_normal[element] * across.norm() * across + model.element.drag_tangential[element] * along.norm() * along;
}

Vec3 body_force(const Model& model, const Body& body, double z) {
  const Vec3 flow = model.current.at(z) - model.tow;
  return Vec3(0.0, 0.0, -body.wet_weight) + body.force(0.0) + body.drag * flow.norm() * flow;
}

Vec3 LineLoads::total(const Model& model, const Line& line) const {
  Vec3 sum = Vec3::Zero();
  for (int i = 0; i < line.elements; ++i) sum += model.element.length[line.first_element + i] * density[i];
  for (const Vec3& force : point) sum += force;
  return sum;
}

LineLoads dry_loads(const Model& model, int line_index, double z) {
  const Line& line = model.lines[line_index];
  LineLoads loads;
  loads.density.resize(line.elements);
  loads.point.assign(line.nodes, Vec3::Zero());
  for (int i = 0; i < line.elements; ++i) loads.density[i] = Vec3(0.0, 0.0, -model.element.weight[line.first_element + i]);
  const auto where_lines_meet = [&](int node) { return (node == 0 && line.from_hub >= 0) || (node == line.nodes - 1 && line.to_hub >= 0); };
  for (const Body& body : model.bodies)
    if (body.line == line_index && !where_lines_meet(body.node)) loads.point[body.node] += body_force(model, body, z);
  for (const SpreadLoad& spread : model.spread_loads)
    if (spread.line == line_index)
      loads.density[spread.element - line.first_element] += spread.share / model.element.length[spread.element] * spread.force(0.0);
  return loads;
}

double load_scale(const Model& model, int line_index) {
  const Line& line = model.lines[line_index];
  const double speed = model.current.fastest() + model.tow.norm();
  double sum = 0.0;
  for (int e = line.first_element; e < line.first_element + line.elements; ++e)
    sum += model.element.length[e] * (std::abs(model.element.weight[e]) + model.element.drag_normal[e] * speed * speed);
  for (const Body& body : model.bodies)
    if (body.line == line_index) sum += std::abs(body.wet_weight) + body.force(0.0).norm() + body.drag * speed * speed;
  for (const SpreadLoad& spread : model.spread_loads)
    if (spread.line == line_index) sum += spread.share * spread.force(0.0).norm();
  return sum;
}

double largest_load(const Model& model) {
  double largest = 0.0, buckling = 0.0;
  for (int line = 0; line < static_cast<int>(model.lines.size()); ++line) {
    largest = std::max(largest, load_scale(model, line));
    const Line& l = model.lines[line];
    buckling = std::max(buckling, model.element.EI[l.first_element] * std::pow(2.0 * std::numbers::pi / l.length, 2));
  }
  return largest > 0.0 ? largest : buckling;
}

}  // namespace hawser
