#include "solver/static_perturbation.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/norms.hpp"
#include "solver/static_start_shape.hpp"
#include "solver/statics.hpp"

namespace hawser {

void bow_sideways(const Model& model, State& state) {
  for (int index = 0; index < static_cast<int>(model.lines.size()); ++index) {
    const Line& line = model.lines[index];
    const Chain& chain = model.chain(index);
    const auto r = [&](int node) { return Eigen::Map<Vec3>(&state.q[chain.dof(node)]); };
    const Vec3 chord = r(line.nodes - 1) - r(0);
    const double c = chord.norm(), L = line.length;
    const Vec3 t = c > 0.0 ? Vec3(chord / c) : Vec3::UnitX();
    Vec3 n = model.seabed ? Vec3(Vec3::UnitZ().cross(t)) : Vec3(-Vec3::UnitZ() + t.z() * t);  // a line on the bed gives way along it
    n = n.norm() > 1e-3 ? n.normalized() : t.unitOrthogonal();
    const double bow = std::clamp(std::sqrt(0.375 * c * std::max(L - c, 0.0)), 0.01 * L, 0.3 * L);  // sag of a parabola of length L
    const bool free = line.from_free || line.to_free;
    for (int i = 0; i < line.nodes; ++i) {
      const double x = line.from_free ? 1.0 - line.s[i] / L : line.s[i] / L;
      const double turn = free ? 0.5 * std::numbers::pi : std::numbers::pi;
      const double shape = free ? 1.0 - std::cos(turn * x) : std::pow(std::sin(turn * x), 2);
      const double slope = (free ? turn * std::sin(turn * x) : turn * std::sin(2.0 * turn * x)) / (line.from_free ? -L : L);
      r(i) += bow * shape * n;
      if (chain.block == 6) Eigen::Map<Vec3>(&state.q[chain.dof(i) + 3]) += bow * slope * n;
    }
  }
  model.prescribe(state);
  std::fill(state.a.begin(), state.a.end(), 0.0);
  for (const Chain& chain : model.chains)
    for (int i = 0; i < chain.nodes; ++i) Eigen::Map<Vec3>(&state.v[chain.dof(i)]) = model.tow;
  model.align_clamps(state);
  model.reset_joints(state);
}

bool folded(const Model& model, const State& state) {
  for (int index = 0; index < static_cast<int>(model.lines.size()); ++index) {
    const Chain& chain = model.chain(index);
    const auto r = [&](int node) { return Eigen::Map<const Vec3>(&state.q[chain.dof(node)]); };
    const auto slope = [&](int node) {
      return chain.block == 6 ? Vec3(Eigen::Map<const Vec3>(&state.q[chain.dof(node) + 3])) : Vec3(r(node + 1) - r(node));
    };
    for (int i = 0; i + 1 < chain.nodes - (chain.block == 3); ++i)
      if (slope(i).dot(slope(i + 1)) < 0.0) return true;
  }
  return false;
}

namespace {

/// Left of a joint an element ends with a slope of its own.
bool at_joint(const Model& model, int element) {
  return std::any_of(model.joints.begin(), model.joints.end(), [&](const Joint& joint) { return joint.element == element; });
}

/// The clamp next to which an element lies, where a limp one may turn sharply; nullptr where there is none.
const Support* clamp_at(const Model& model, int line, int element) {
  const auto clamp = std::find_if(model.supports.begin(), model.supports.end(), [&](const Support& support) {
    return support.clamped && support.line == line && (support.node == element || support.node == element + 1);
  });
  return clamp == model.supports.end() ? nullptr : &*clamp;
}

/// The cubic from node `first` to node `last`, with slopes of length one there.
void draw_cubic(const Model& model, State& state, int index, int first, int last) {
  const Line& line = model.lines[index];
  const auto part = [&](int node, int offset) { return Eigen::Map<Vec3>(&state.q[model.dof(index, node) + offset]); };
  for (const int end : {first, last}) part(end, 3).normalize();
  for (const Support& support : model.supports)
    if (support.clamped && support.line == index && (support.node == first || support.node == last)) part(support.node, 3) = support.direction;
  const Cubic cubic{part(first, 0), part(last, 0), part(first, 3), part(last, 3), line.s[last] - line.s[first]};
  for (int i = first + 1; i < last; ++i) {
    const double x = (line.s[i] - line.s[first]) / cubic.h;
    part(i, 0) = cubic.r(x);
    part(i, 3) = cubic.slope(x);
  }
}

}  // namespace

std::optional<Knot> find_knot(const Model& model, const State& state) {
  constexpr double taut = 10.0;     // loads of an element
  constexpr double squeezed = 0.5;  // of its length
  for (int index = 0; index < static_cast<int>(model.lines.size()); ++index) {
    const Line& line = model.lines[index];
    if (model.chain(index).block != 6) continue;
    const auto part = [&](int node, int offset) { return Vec3(Eigen::Map<const Vec3>(&state.q[model.dof(index, node) + offset])); };
    for (int i = 0; i < line.elements; ++i) {
      const int e = line.first_element + i;
      const double l = model.element.length[e];
      const Vec3 a = part(i, 3), b = part(i + 1, 3), middle = 1.5 / l * (part(i + 1, 0) - part(i, 0)) - 0.25 * (a + b);
      const bool turned = a.dot(middle) < 0.0 || middle.dot(b) < 0.0, gone = std::min({a.norm(), middle.norm(), b.norm()}) < squeezed;
      const Support* clamp = i == 0 || i + 1 == line.elements ? clamp_at(model, index, i) : nullptr;
      const bool reversed = clamp && clamp->direction.dot(clamp->node == i ? a : b) < 0.0;
      if ((!turned && !gone && !reversed) || at_joint(model, e)) continue;
      const double tension = model.element.EA[e] * (std::max(a.norm(), b.norm()) - 1.0), load = 1e6 * model.element.minimum_tension[e];
      const double bend = std::sqrt(model.element.EI[e] / std::max(std::abs(tension) + load, 1e-300));
      if (bend > l || reversed || (turned && !clamp && tension > taut * load)) return Knot{index, i, line.s[i], tension, bend};
    }
  }
  return std::nullopt;
}

bool draw_out_knots(const Model& model, State& state) {
  int drawn = 0;
  for (auto knot = find_knot(model, state); knot && drawn < model.total_elements(); knot = find_knot(model, state), ++drawn) {
    const Line& line = model.lines[knot->line];
    const double reach = 2.0 * std::max(knot->bend, line.s[knot->element + 1] - line.s[knot->element]);
    int first = knot->element, last = first + 1;
    while (first > 0 && line.s[knot->element] - line.s[first] < reach) --first;
    while (last + 1 < line.nodes && line.s[last] - line.s[knot->element + 1] < reach) ++last;
    draw_cubic(model, state, knot->line, first, last);
  }
  model.reset_joints(state);
  return drawn > 0;
}

State open_start(const Model& model) {
  State state = static_start(model, StaticStart::straight);
  bow_sideways(model, state);
  for (int index = 0; index < static_cast<int>(model.lines.size()); ++index) {
    const Line& line = model.lines[index];
    if (line.from_free || line.to_free) continue;
    const Chain& chain = model.chain(index);
    const auto r = [&](int node) { return Eigen::Map<Vec3>(&state.q[chain.dof(node)]); };
    const Vec3 chord = r(line.nodes - 1) - r(0);
    const double open = std::max(0.0, 0.1 * line.length - chord.norm());
    Vec3 n = chord;
    n.z() = 0.0;
    const Vec3 flow = model.current.at(r(0).z()) - model.tow;
    n = n.norm() > 0.0 ? n.normalized() : flow.norm() > 0.0 ? Vec3(flow.normalized()) : Vec3::UnitX();
    const double turn = 2.0 * std::numbers::pi / line.length;
    for (int i = 0; i < line.nodes; ++i) {
      r(i) -= open * std::sin(turn * line.s[i]) * n;
      if (chain.block == 6) Eigen::Map<Vec3>(&state.q[chain.dof(i) + 3]) -= open * turn * std::cos(turn * line.s[i]) * n;
    }
  }
  model.prescribe(state);
  model.align_clamps(state);
  model.reset_joints(state);
  return state;
}

double distance(const Model& model, const State& a, const State& b) {
  double largest = 0.0;
  for (int line = 0; line < static_cast<int>(model.lines.size()); ++line) {
    for (int i = 0; i < model.lines[line].nodes; ++i) {
      const std::size_t r = model.dof(line, i);
      largest = std::max(largest, (Eigen::Map<const Vec3>(&a.q[r]) - Eigen::Map<const Vec3>(&b.q[r])).norm());
    }
  }
  return largest / longest_line(model);
}

}  // namespace hawser
