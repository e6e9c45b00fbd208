#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "solver/static_start_bed.hpp"
#include "solver/static_start_catenary.hpp"
#include "solver/static_start_hubs.hpp"
#include "solver/static_start_loads.hpp"
#include "solver/static_start_march.hpp"
#include "solver/static_start_shape.hpp"
#include "solver/statics.hpp"

namespace hawser {

void write_shape(const Model& model, int line, const LineShape& shape, State& state) {
  const Chain& chain = model.chain(line);
  for (int i = 0; i < chain.nodes; ++i) {
    Eigen::Map<Vec3>(&state.q[chain.dof(i)]) = shape.r[i];
    if (chain.block == 6) Eigen::Map<Vec3>(&state.q[chain.dof(i) + 3]) = shape.right[i];
  }
  for (const Joint& joint : model.joints) {
    if (joint.line != line) continue;
    const Vec3 &left = shape.left[joint.node], &right = shape.right[joint.node];
    if (joint.jump == Jump::free)
      Eigen::Map<Vec3>(&state.q[joint.inner]) = left;
    else
      state.q[joint.inner] = left.norm() / right.norm();
  }
}

LineShape straight_shape(const Line& line, const Vec3& r0, const Vec3& direction, double stretch) {
  LineShape shape(line.nodes);
  for (int i = 0; i < line.nodes; ++i) {
    shape.r[i] = r0 + stretch * line.s[i] * direction;
    shape.left[i] = shape.right[i] = stretch * direction;
  }
  return shape;
}

LineShape table_shape(const Line& line, const ShapeTable& table) {
  LineShape shape(line.nodes);
  const int rows = static_cast<int>(table.s.size());
  const auto difference = [&](int a, int b) { return Vec3((table.position[b] - table.position[a]) / (table.s[b] - table.s[a])); };
  const auto slope = [&](int k) { return difference(std::max(k - 1, 0), std::min(k + 1, rows - 1)); };
  for (int i = 0; i < line.nodes; ++i) {
    const auto above = std::upper_bound(table.s.begin(), table.s.end(), line.s[i]) - table.s.begin();
    const int k = std::clamp(static_cast<int>(above) - 1, 0, rows - 2);
    const double h = table.s[k + 1] - table.s[k], x = (line.s[i] - table.s[k]) / h;
    const Cubic cubic{table.position[k], table.position[k + 1], slope(k), slope(k + 1), h};
    shape.r[i] = cubic.r(x);
    shape.left[i] = shape.right[i] = cubic.slope(x).stableNormalized();
  }
  return shape;
}

namespace {

/// Neighbouring elements of one line with the same EA and load, and no point load between them.
struct Segments {
  std::vector<CatenarySegment> list;
  std::vector<int> of_element;  // of each element of the line

  Segments(const Model& model, const Line& line, const LineLoads& loads) : of_element(line.elements) {
    for (int i = 0; i < line.elements; ++i) {
      const int e = line.first_element + i;
      const bool same = i > 0 && model.element.EA[e] == list.back().EA && loads.density[i] == list.back().load && loads.point[i].isZero(0.0);
      if (i > 0) list.back().point = loads.point[i];
      if (!same) list.push_back({0.0, model.element.EA[e], loads.density[i], Vec3::Zero()});
      list.back().length += model.element.length[e];
      of_element[i] = static_cast<int>(list.size()) - 1;
    }
  }
};

LineShape evaluate(const Line& line, const Segments& segments, const Vec3& r0, const Vec3& F0) {
  LineShape shape(line.nodes);
  Vec3 F = F0, r = r0;
  double s0 = 0.0;
  std::size_t k = 0;
  for (int i = 0; i < line.elements; ++i) {
    if (i > 0 && segments.of_element[i] != static_cast<int>(k)) {
      const CatenarySegment& passed = segments.list[k++];
      r += catenary_span(passed, F, passed.length);
      F -= passed.length * passed.load + passed.point;
      s0 += passed.length;
    }
    const CatenarySegment& segment = segments.list[k];
    shape.r[i] = r + catenary_span(segment, F, line.s[i] - s0);
    shape.right[i] = catenary_slope(segment.EA, F - (line.s[i] - s0) * segment.load);
    shape.left[i + 1] = catenary_slope(segment.EA, F - (line.s[i + 1] - s0) * segment.load);
  }
  shape.r.back() = r + catenary_span(segments.list[k], F, segments.list[k].length);
  shape.left.front() = shape.right.front();
  shape.right.back() = shape.left.back();
  return shape;
}

/// Drag on every element of a shape.
std::vector<Vec3> drag_on(const Model& model, const Line& line, const LineShape& shape) {
  std::vector<Vec3> drag(line.elements);
  for (int i = 0; i < line.elements; ++i) {
    const Vec3 chord = shape.r[i + 1] - shape.r[i];
    drag[i] = drag_density(model, line.first_element + i, chord.stableNormalized(), 0.5 * (shape.r[i].z() + shape.r[i + 1].z()));
  }
  return drag;
}

double norm_of(const std::vector<Vec3>& field) {
  double sum = 0.0;
  for (const Vec3& x : field) sum += x.norm();
  return sum;
}

}  // namespace

LineShape catenary_shape(const Model& model, int index, const Vec3& from, const Vec3& to) {
  constexpr int passes = 12;
  const Line& line = model.lines[index];
  const Vec3 chord = to - from;
  const LineLoads dry = dry_loads(model, index, 0.5 * (from.z() + to.z()));
  const auto solve = [&](const LineLoads& loads) {
    const Segments segments(model, line, loads);
    return evaluate(line, segments, from, solve_end_force(segments.list, chord).force);
  };
  // The drag of the straight line tells whether the weight or the flow gives the first shape.
  LineShape shape = straight_shape(line, from, chord / line.length, 1.0);
  std::vector<Vec3> drag = drag_on(model, line, shape);
  const double weight = norm_of(dry.density), first_drag = norm_of(drag);
  if (first_drag == 0.0) return solve(dry);
  if (weight > first_drag) drag = drag_on(model, line, solve(dry));
  for (int pass = 0; pass < passes; ++pass) {
    LineLoads loads = dry;
    for (int i = 0; i < line.elements; ++i) loads.density[i] += drag[i];
    shape = solve(loads);
    const std::vector<Vec3> next = drag_on(model, line, shape);
    double change = 0.0;
    for (int i = 0; i < line.elements; ++i) {
      change += (next[i] - drag[i]).norm();
      drag[i] += 0.5 * (next[i] - drag[i]);
    }
    if (change <= 1e-2 * (weight + first_drag)) break;
  }
  return shape;
}

LineShape guessed_shape(const Model& model, int index, const Vec3& from, const Vec3& to) {
  const Line& line = model.lines[index];
  const bool held = !line.from_free && !line.to_free;
  LineShape shape = held ? catenary_shape(model, index, from, to) : march_from_free_end(model, index, line.from_free ? to : from);
  if (!reaches_bed(model, shape)) return shape;
  if (const auto laid = laid_shape(model, index, from, to)) return *laid;
  lift_onto_bed(model, shape);
  return shape;
}

namespace {

LineShape start_of_line(const Model& model, int index, StaticStart start, const Vec3& from, const Vec3& to) {
  const Line& line = model.lines[index];
  const bool held = !line.from_free && !line.to_free;
  const Vec3 chord = to - from;
  const bool straight = start == StaticStart::straight && !(held && chord.norm() <= 1e-9 * line.length);
  if (!straight && !(line.from_free && line.to_free)) return guessed_shape(model, index, from, to);
  const Vec3 direction = chord.isZero(0.0) ? Vec3(-Vec3::UnitZ()) : chord.normalized();
  const bool hang_back = line.from_free && !line.to_free;
  return straight_shape(line, hang_back ? Vec3(to - line.length * direction) : from, direction, held ? chord.norm() / line.length : 1.0);
}

/// Ends where they are held, clamps along their direction, the whole system in the velocity of the tow.
void apply_supports(const Model& model, State& state) {
  model.prescribe(state);
  model.align_clamps(state);
  std::fill(state.v.begin(), state.v.end(), 0.0);
  std::fill(state.a.begin(), state.a.end(), 0.0);
  for (const Chain& chain : model.chains)
    for (int i = 0; i < chain.nodes; ++i) Eigen::Map<Vec3>(&state.v[chain.dof(i)]) = model.tow;
}

}  // namespace

State static_start(const Model& model, StaticStart start) {
  State state = model.make_state();
  std::vector<Vec3> at;
  for (const ModelPoint& point : model.points) at.push_back(point.motion(0.0).r);
  if (start != StaticStart::straight && !model.hubs.empty()) at = balanced_positions(model);
  for (int line = 0; line < static_cast<int>(model.lines.size()); ++line)
    write_shape(model, line, start_of_line(model, line, start, at[model.lines[line].from], at[model.lines[line].to]), state);
  apply_supports(model, state);
  return state;
}

State static_start(const Model& model, StaticStart start, const Scene& scene) {
  State state = static_start(model, start);
  for (std::size_t line = 0; line < scene.lines.size(); ++line)
    if (scene.lines[line].start) write_shape(model, static_cast<int>(line), table_shape(model.lines[line], *scene.lines[line].start), state);
  apply_supports(model, state);
  return state;
}

}  // namespace hawser
