// Starts that need no equilibrium: straight at rest, and interpolated from a table.
#include <algorithm>
#include <cassert>

#include "solver/simulate.hpp"

namespace hawser {
namespace {

using NodeVec3 = Eigen::Map<Vec3>;

Vec3 position_at_start(const ModelPoint& point) { return point.free ? point.position : point.motion(0.0).r; }

/// Rows of one line: arc lengths with positions or velocities, and their derivatives in s.
struct Curve {
  std::vector<double> s;
  std::vector<Vec3> value, slope;

  void differentiate();
  void evaluate(double at, Vec3& r, Vec3& derivative) const;
};

/// Slopes at the rows from the polynomial through the (up to) five nearest rows: order 4, one-sided at the ends.
void Curve::differentiate() {
  const int rows = static_cast<int>(s.size());
  const int width = std::min(rows, 5);
  slope.assign(rows, Vec3::Zero());
  for (int k = 0; k < rows; ++k) {
    const int first = std::clamp(k - width / 2, 0, rows - width);
    // Lagrange: derivative of the basis polynomial of row j at row k is (w_j/w_k)/(s_k - s_j), w the barycentric weights.
    const auto weight = [&](int j) {
      double product = 1.0;
      for (int i = first; i < first + width; ++i) {
        product *= i == j ? 1.0 : s[j] - s[i];
      }
      return 1.0 / product;
    };
    for (int j = first; j < first + width; ++j) {
      if (j != k) {
        slope[k] += weight(j) / weight(k) / (s[k] - s[j]) * (value[j] - value[k]);
      }
    }
  }
}

/// Cubic Hermite between the rows, straight beyond them.
void Curve::evaluate(double at, Vec3& r, Vec3& derivative) const {
  if (at <= s.front() || at >= s.back() || s.size() == 1) {
    const std::size_t end = at <= s.front() ? 0 : s.size() - 1;
    r = value[end] + (at - s[end]) * slope[end];
    derivative = slope[end];
    return;
  }
  const std::size_t i = std::upper_bound(s.begin(), s.end(), at) - s.begin() - 1;
  const double l = s[i + 1] - s[i], x = (at - s[i]) / l;
  const Vec3 d = (value[i + 1] - value[i]) / l;
  r = value[i] + l * (x * x * (3 - 2 * x) * d + x * (1 - x) * (1 - x) * slope[i] + x * x * (x - 1) * slope[i + 1]);
  derivative = 6 * x * (1 - x) * d + (1 - x) * (1 - 3 * x) * slope[i] + x * (3 * x - 2) * slope[i + 1];
}

/// Writes r and, where the node has it, r' of one node into q or v.
void set_node(const Chain& chain, int node, const Vec3& r, const Vec3& slope, std::vector<double>& into) {
  double* part = &into[chain.dof(node)];
  NodeVec3{part} = r;
  if (chain.block > 3) {
    NodeVec3{part + 3} = slope;
  }
}

void set_straight(const Model& model, int line, State& state) {
  const Line& l = model.lines[line];
  const Vec3 from = position_at_start(model.points[l.from]), to = position_at_start(model.points[l.to]);
  const Vec3 direction = (to - from).normalized();
  const Vec3 origin = l.from_free && !l.to_free ? Vec3(to - l.length * direction) : from;
  for (int i = 0; i < l.nodes; ++i) {
    set_node(model.chain(line), i, origin + l.s[i] * direction, direction, state.q);
    set_node(model.chain(line), i, model.tow, Vec3::Zero(), state.v);
  }
}

/// A clamped slope may only change its length.
void align_clamp_velocities(const Model& model, State& state) {
  for (const Support& support : model.supports) {
    if (support.clamped) {
      NodeVec3 slope(&state.v[model.dof(support.line, support.node) + 3]);
      slope = Vec3(slope.dot(support.direction) * support.direction);
    }
  }
}

State finished(const Model& model, State state) {
  model.prescribe(state);
  model.align_clamps(state);
  align_clamp_velocities(model, state);
  model.reset_joints(state);
  return state;
}

}  // namespace

State straight_rest_state(const Model& model) {
  State state = model.make_state();
  for (int line = 0; line < static_cast<int>(model.lines.size()); ++line) {
    set_straight(model, line, state);
  }
  return finished(model, std::move(state));
}

State state_from_table(const Model& model, const StartTable& table) {
  State state = model.make_state();
  for (int line = 0; line < static_cast<int>(model.lines.size()); ++line) {
    Curve position, velocity;
    for (const StartTable::Row& row : table.rows) {
      if (row.line == model.lines[line].name) {
        position.s.push_back(row.s);
        position.value.push_back(row.position);
        velocity.value.push_back(row.velocity);
      }
    }
    if (position.s.size() < 2) {
      set_straight(model, line, state);
      continue;
    }
    assert(std::is_sorted(position.s.begin(), position.s.end()));
    velocity.s = position.s;
    position.differentiate();
    velocity.differentiate();
    for (int i = 0; i < model.lines[line].nodes; ++i) {
      Vec3 r, slope;
      position.evaluate(model.lines[line].s[i], r, slope);
      set_node(model.chain(line), i, r, slope, state.q);
      velocity.evaluate(model.lines[line].s[i], r, slope);
      set_node(model.chain(line), i, r, slope, state.v);
    }
  }
  return finished(model, std::move(state));
}

}  // namespace hawser
