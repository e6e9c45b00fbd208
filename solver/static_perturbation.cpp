#include "solver/static_perturbation.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

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

/// A limp element may turn sharply next to a clamp, and left of a joint it ends with a slope of its own.
bool at_joint(const Model& model, int element) {
  return std::any_of(model.joints.begin(), model.joints.end(), [&](const Joint& joint) { return joint.element == element; });
}
bool at_clamp(const Model& model, int line, int element) {
  return std::any_of(model.supports.begin(), model.supports.end(), [&](const Support& support) {
    return support.line == line && support.clamped && (support.node == element || support.node == element + 1);
  });
}

}  // namespace

std::optional<Knot> find_knot(const Model& model, const State& state) {
  constexpr double taut = 10.0;  // loads of an element
  for (int index = 0; index < static_cast<int>(model.lines.size()); ++index) {
    const Line& line = model.lines[index];
    const Chain& chain = model.chain(index);
    if (chain.block != 6) continue;
    const auto part = [&](int node, int first) { return Vec3(Eigen::Map<const Vec3>(&state.q[chain.dof(node) + first])); };
    for (int i = 0; i < line.elements; ++i) {
      const int e = line.first_element + i;
      const Vec3 a = part(i, 3), b = part(i + 1, 3), middle = 1.5 / model.element.length[e] * (part(i + 1, 0) - part(i, 0)) - 0.25 * (a + b);
      if ((a.dot(middle) >= 0.0 && middle.dot(b) >= 0.0) || at_joint(model, e)) continue;
      const double tension = model.element.EA[e] * (std::max(a.norm(), b.norm()) - 1.0), load = 1e6 * model.element.minimum_tension[e];
      const bool stiff = model.element.EI[e] > (std::abs(tension) + load) * std::pow(model.element.length[e], 2);
      if (stiff || (tension > taut * load && !at_clamp(model, index, i))) return Knot{index, line.s[i], tension};
    }
  }
  return std::nullopt;
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
  double largest = 0.0, longest = 0.0;
  for (int line = 0; line < static_cast<int>(model.lines.size()); ++line) {
    longest = std::max(longest, model.lines[line].length);
    for (int i = 0; i < model.lines[line].nodes; ++i) {
      const std::size_t r = model.dof(line, i);
      largest = std::max(largest, (Eigen::Map<const Vec3>(&a.q[r]) - Eigen::Map<const Vec3>(&b.q[r])).norm());
    }
  }
  return largest / longest;
}

}  // namespace hawser
