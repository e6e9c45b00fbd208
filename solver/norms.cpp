#include "solver/norms.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hawser {
namespace {

using ConstVec3 = Eigen::Map<const Vec3>;

/// The larger one, or the one that is not a number: nobody may take that for convergence.
double larger(double a, double b) { return a > b || std::isnan(a) ? a : b; }

/// Calls f(line, node, |r part|^2, |r' part|^2, l) for every node, and for every joint with its inner unknowns as the r' part. Squares: a
/// root at every node would cost more than all the rest.
template <class Function>
void for_each_node(const Model& model, std::span<const double> x, Function f) {
  for (int line = 0; line < static_cast<int>(model.lines.size()); ++line) {
    const Chain& chain = model.chain(line);
    const double* length = &model.node_length[model.lines[line].first_node];
    const double* p = &x[chain.first_dof];
    for (int node = 0; node < chain.nodes; ++node, p += chain.block)
      f(line, node, p[0] * p[0] + p[1] * p[1] + p[2] * p[2], chain.block == 3 ? 0.0 : p[3] * p[3] + p[4] * p[4] + p[5] * p[5], length[node]);
  }
  for (const Joint& joint : model.joints) {
    const double slope = Eigen::Map<const Eigen::VectorXd>(&x[joint.inner], joint.inner_count()).squaredNorm();
    f(joint.line, joint.node, 0.0, slope, model.node_length[model.lines[joint.line].first_node + joint.node]);
  }
}

}  // namespace

WorstNode worst_node(const Model& model, std::span<const double> r) {
  WorstNode worst;
  double largest = 0.0;
  for_each_node(model, r, [&](int line, int node, double force, double moment, double l) {
    const double as_force = moment / (l * l), value = larger(force, as_force);
    if (!(value > largest || (std::isnan(value) && !std::isnan(largest)))) return;
    largest = value;
    worst = {line, node, 0.0, as_force > force};
  });
  worst.residual = std::sqrt(largest);
  return worst;
}

double residual_norm(const Model& model, std::span<const double> r) { return worst_node(model, r).residual; }

IncrementSize increment_size(const Model& model, std::span<const double> d) {
  double position = 0.0, slope = 0.0, as_position = 0.0;
  for_each_node(model, d, [&](int, int, double r, double s, double l) {
    position = larger(r, position);
    slope = larger(s, slope);
    as_position = larger(l * l * s, as_position);
  });
  return {std::sqrt(position), std::sqrt(slope), std::sqrt(larger(position, as_position))};
}

double longest_line(const Model& model) {
  double longest = 0.0;
  for (const Line& line : model.lines) longest = std::max(longest, line.length);
  return longest;
}

double largest_nodal_load(const Model& model) {
  std::vector<Vec3> load(model.total_nodes(), Vec3::Zero());
  for (const Line& line : model.lines)
    for (int i = 0; i < line.elements; ++i) {
      const int e = line.first_element + i;
      const Vec3 half(0.0, 0.0, -0.5 * model.element.weight[e] * model.element.length[e]);
      load[line.first_node + i] += half;
      load[line.first_node + i + 1] += half;
    }
  for (const Body& body : model.bodies) load[model.lines[body.line].first_node + body.node] += Vec3(0.0, 0.0, -body.wet_weight) + body.force(0.0);
  for (const SpreadLoad& spread : model.spread_loads) {
    const Line& line = model.lines[spread.line];
    load[line.first_node + spread.element - line.first_element] += spread.share * spread.force(0.0);
  }
  double largest = 0.0;
  for (const Vec3& force : load) largest = std::max(largest, force.norm());
  return largest;
}

double largest_end_force(const Model& model, std::span<const double> unprojected) {
  double largest = 0.0;
  const auto count = [&](const Support& end) { largest = std::max(largest, ConstVec3(&unprojected[model.dof(end.line, end.node)]).norm()); };
  for (const Support& support : model.supports) count(support);
  for (const Hub& hub : model.hubs)
    for (const Support& end : hub.ends) count(end);
  return largest;
}

double reference_force(const Model& model, std::span<const double> unprojected) {
  return std::max(largest_nodal_load(model), largest_end_force(model, unprojected));
}

double roundoff_force(const Model& model, const State& state) {
  double worst = 0.0;
  const double k = model.seabed ? model.seabed->law.stiffness : 0.0;
  for (int line = 0; line < static_cast<int>(model.lines.size()); ++line) {
    const Chain& chain = model.chain(line);
    const bool laid = model.seabed && model.seabed->laid[line] != Laid::nowhere;
    for (int i = 0; i < model.lines[line].elements; ++i) {
      const int e = model.lines[line].first_element + i;
      const double l = model.element.length[e];
      const double r = std::max(ConstVec3(&state.q[chain.dof(i)]).norm(), ConstVec3(&state.q[chain.dof(i + 1)]).norm());
      const double friction = laid ? friction_stiffness(model.seabed->law) * std::abs(model.element.weight[e]) : 0.0;
      worst = std::max(worst, model.element.EA[e] * std::max(1.0, r / l) + 12.0 * model.element.EI[e] * r / (l * l * l) + (k + friction) * l * r);
    }
  }
  for (const Body& body : model.bodies) {
    const double friction = body.lay ? friction_stiffness(model.seabed->law) * std::abs(body.wet_weight) : 0.0;
    worst = std::max(worst, (k * body.bed_length + friction) * ConstVec3(&state.q[model.dof(body.line, body.node)]).norm());
  }
  return 2.0 * std::numeric_limits<double>::epsilon() * worst;
}

}  // namespace hawser
