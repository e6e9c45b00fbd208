#include "solver/model_branch.hpp"

#include <algorithm>
#include <cmath>

#include "solver/stability.hpp"
#include "solver/static_system.hpp"

namespace hawser {
namespace {

constexpr double automatic_tolerance = 1e-10;  // as statics
constexpr TangentWeights static_weights{1.0, 0.0, 0.0};

/// Least tensions kept where the tension vanishes, as in statics; the exact tangent where a line is compressed.
TangentFloor floor_for(const Model& model, const State& state) {
  const std::vector<double>& least = model.element.minimum_tension;
  const double kept = *std::max_element(least.begin(), least.end());
  return {0.0, least_strain_tension(model, state).value >= -10.0 * kept, false};
}

void follow_ends(const Model& model, int index, State& state) {
  const Line& line = model.lines[index];
  const Chain& chain = model.chain(index);
  const auto r = [&](int node) { return Eigen::Map<Vec3>(&state.q[chain.dof(node)]); };
  const auto way = [&](int point, int node) {  // a point where lines meet stays
    return model.points[point].free ? Vec3(Vec3::Zero()) : Vec3(model.points[point].motion(0.0).r - r(node));
  };
  Vec3 from = way(line.from, 0), to = way(line.to, line.nodes - 1);
  if (line.from_free) from = to;
  if (line.to_free) to = from;
  for (int i = 0; i < line.nodes; ++i) {
    const double share = line.s[i] / line.length;
    r(i) += (1.0 - share) * from + share * to;
    if (chain.block == 6) Eigen::Map<Vec3>(&state.q[chain.dof(i) + 3]) += (to - from) / line.length;
  }
}

std::vector<double> product_weights(const Model& model) {
  std::vector<double> weights(model.unknowns, 0.0);
  double longest = 0.0;
  for (const Line& line : model.lines) longest = std::max(longest, line.length);
  const double share = 1.0 / (model.total_nodes() * longest * longest);
  for (int line = 0; line < static_cast<int>(model.lines.size()); ++line) {
    const Chain& chain = model.chain(line);
    for (int node = 0; node < chain.nodes; ++node) {
      const double l = model.node_length[model.lines[line].first_node + node];
      for (int k = 0; k < chain.block; ++k) weights[chain.dof(node) + k] = share * (k < 3 ? 1.0 : l * l);
    }
  }
  return weights;
}

/// Up to this stiffness [N/m^2] a mode is neutral or rounding.
double little_stiffness(const Model& model, double reference_force) { return neutral_stiffness(model, reference_force) + rounding_stiffness(model); }

/// Prescribed unknowns, and those of hub ends beyond the first one, which only repeat it.
std::vector<char> held_unknowns(const Model& model) {
  std::vector<char> held(model.dofs, 0);
  for (const Support& support : model.supports) {
    const auto first = held.begin() + static_cast<std::ptrdiff_t>(model.dof(support.line, support.node));
    if (support.position) std::fill_n(first, 3, 1);
    if (support.clamped && model.chain(support.line).block == 6) std::fill_n(first + 3, 3, 1);
  }
  for (const Hub& hub : model.hubs)
    for (std::size_t i = 1; i < hub.ends.size(); ++i)
      std::fill_n(held.begin() + static_cast<std::ptrdiff_t>(model.dof(hub.ends[i].line, hub.ends[i].node)), 3, 1);
  return held;
}

/// Gives every node this stiffness [N/m per metre of line]: along a direction in which a state is neutral (a bent column turns about its axis) Newton
/// would go anywhere.
void hold(const Model& model, double stiffness, BlockTridiagonal& matrix) {
  for (std::size_t line = 0; line < model.lines.size(); ++line) {
    const Chain& chain = matrix.chains()[line];
    for (int i = 0; i < chain.nodes; ++i) {
      const double l = model.node_length[model.lines[line].first_node + i];
      for (int k = 0; k < chain.block; ++k) matrix.D(chain, i)[k * (chain.block + 1)] += stiffness * l * (k < 3 ? 1.0 : l * l);
    }
  }
}

/// Doubles the diagonal of an unknown and returns what it was.
double double_diagonal(Tangent& tangent, std::size_t unknown) {
  for (BorderEnd& end : tangent.border.ends) {
    if (unknown < end.r || unknown >= end.r + 3) continue;
    const auto k = static_cast<Eigen::Index>(unknown - end.r), own = static_cast<Eigen::Index>(end.r - end.window);
    const double stiffness = end.column(own + k, k);
    end.column(own + k, k) = end.row(k, own + k) = 2.0 * stiffness;
    return stiffness;
  }
  for (const Chain& chain : tangent.chain.chains()) {
    if (unknown < chain.first_dof || unknown >= chain.first_dof + chain.dofs()) continue;
    const std::size_t block = static_cast<std::size_t>(chain.block), k = (unknown - chain.first_dof) % block;
    double& diagonal = tangent.chain.D(chain, static_cast<int>((unknown - chain.first_dof) / block))[k * (block + 1)];
    diagonal *= 2.0;
    return 0.5 * diagonal;
  }
  return 0.0;
}

}  // namespace

std::vector<int> layout_of(const Model& model) {
  std::vector<int> layout;
  for (const Line& line : model.lines) layout.insert(layout.end(), {static_cast<int>(line.family), line.nodes});
  for (const Line& line : model.lines) layout.insert(layout.end(), {line.from_hub, line.to_hub});
  for (const Joint& joint : model.joints) layout.insert(layout.end(), {static_cast<int>(joint.jump), joint.element});
  return layout;
}

void follow_supports(const Model& model, State& state) {
  for (int line = 0; line < static_cast<int>(model.lines.size()); ++line) follow_ends(model, line, state);
  model.prescribe(state);
  model.align_clamps(state);
}

int directions_that_give_way(const Model& model, const State& state, double reference_force) {
  if (free_of_compression(model, state)) return 0;
  return modes_below(model, state, -little_stiffness(model, reference_force));
}

struct ModelBranch::Instance {
  Instance(Model given, double at, int threads)
      : model(std::move(given)), p(at), assembler(model, threads), state(static_start(model, StaticStart::straight)) {}

  const State& with(std::span<const double> q) {
    state.q.assign(q.begin(), q.end());
    return state;
  }

  Model model;
  double p;
  Assembler assembler;
  State state;  // velocities of a static
};

ModelBranch::ModelBranch(ModelAt model_at, const Model& like, double step, const StaticOptions& options)
    : model_at_(std::move(model_at)),
      layout_(layout_of(like)),
      step_(step),
      options_(options),
      weights_(product_weights(like)),
      held_(held_unknowns(like)),
      chains_(make_linear_solver(LinearSolverKind::automatic)),
      linear_(*chains_) {}

ModelBranch::~ModelBranch() = default;

std::unique_ptr<ModelBranch::Instance> ModelBranch::instance_at(double p) const {
  std::optional<Model> model = model_at_(p);
  if (!model || layout_of(*model) != layout_) return nullptr;
  return std::make_unique<Instance>(std::move(*model), p, std::max(1, options_.threads));
}

bool ModelBranch::move_to(double p, std::vector<double>& q) {
  if (!instance_ || instance_->p != p) {
    std::unique_ptr<Instance> other = instance_at(p);
    if (!other) return false;
    instance_ = std::move(other);
  }
  if (!tangent_) {
    tangent_ = instance_->assembler.make_tangent();
    linear_.analyze(*tangent_);
  }
  State state = instance_->with(q);
  follow_supports(instance_->model, state);
  q = std::move(state.q);
  return true;
}

BranchResidual ModelBranch::residual(std::span<const double> q) {
  const Model& model = instance_->model;
  const State& state = instance_->with(q);
  std::vector<double> r(model.unknowns);
  instance_->assembler.residual(state, r);
  const double reference = reference_force(model, r);
  instance_->assembler.project(r);
  const double tolerance = options_.tolerance > 0.0 ? options_.tolerance : automatic_tolerance, rounding = roundoff_force(model, state);
  return {residual_norm(model, r), std::max(tolerance * reference, 2.0 * rounding), rounding, reference};
}

/// dR/dp along the shift by central differences, one-sided where there is no model on the other side.
bool ModelBranch::differentiate(std::span<const double> q, BranchResponse& response, std::vector<double>& by_p) const {
  const auto side = [&](double p, std::vector<double>& shifted, std::vector<double>& r) {
    const std::unique_ptr<Instance> other = p == instance_->p ? nullptr : instance_at(p);
    if (!other && p != instance_->p) return false;
    Instance& at = other ? *other : *instance_;
    State state = at.with(q);
    follow_supports(at.model, state);
    shifted = std::move(state.q);
    r.resize(at.model.unknowns);
    at.assembler.residual(at.with(shifted), r);
    return true;
  };
  std::vector<double> ahead, behind;
  double high = instance_->p + step_, low = instance_->p - step_;
  if (!side(high, ahead, by_p) && !side(high = instance_->p, ahead, by_p)) return false;
  std::vector<double> r;
  if (!side(low, behind, r) && !side(low = instance_->p, behind, r)) return false;
  if (low == high) return false;
  response.shift.resize(q.size());
  for (std::size_t i = 0; i < q.size(); ++i) {
    by_p[i] = (by_p[i] - r[i]) / (high - low);
    response.shift[i] = (ahead[i] - behind[i]) / (high - low);
  }
  return true;
}

bool ModelBranch::respond(std::span<const double> q, std::size_t spring, BranchResponse& response) {
  const Model& model = instance_->model;
  std::vector<double> r(model.unknowns), by_p;
  if (!differentiate(q, response, by_p)) return false;
  const Assembler& assembler = instance_->assembler;
  const State& state = instance_->with(q);
  Tangent& tangent = *tangent_;
  assembler.tangent(state, static_weights, floor_for(model, state), r, tangent);
  hold(model, little_stiffness(model, reference_force(model, r)), tangent.chain);
  const double stiffness = spring == no_spring ? 0.0 : double_diagonal(tangent, spring);
  if (linear_.factorize(tangent).status != FactorStatus::ok) return false;
  std::vector<double> rhs(model.dofs);
  const auto solve = [&](std::span<const double> load, double at_spring, std::vector<double>& answer) {
    answer.resize(model.unknowns);
    assembler.reduce(tangent, load, rhs);
    if (spring != no_spring) rhs[spring] += at_spring;
    linear_.solve(rhs);
    assembler.expand(tangent, rhs, answer);
  };
  solve(r, 0.0, response.residual);
  solve(by_p, 0.0, response.parameter);
  std::fill(r.begin(), r.end(), 0.0);
  solve(r, stiffness, response.spring);
  return true;
}

int ModelBranch::negative_pivots(std::span<const double> q) {
  const double reference = residual(q).reference;
  return directions_that_give_way(instance_->model, instance_->with(q), reference);
}

double ModelBranch::product(std::span<const double> a, std::span<const double> b) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < weights_.size(); ++i) sum += weights_[i] * a[i] * b[i];
  return sum;
}

std::size_t ModelBranch::strongest(std::span<const double> motion) const {
  std::size_t found = no_spring;
  double largest = 0.0;
  for (std::size_t i = 0; i < held_.size(); ++i) {
    const double size = weights_[i] * motion[i] * motion[i];
    if (held_[i] || size <= largest) continue;
    largest = size;
    found = i;
  }
  return found;
}

const Model& ModelBranch::model() const { return instance_->model; }

State ModelBranch::state_of(std::span<const double> q) const {
  State state = instance_->state;
  state.q.assign(q.begin(), q.end());
  return state;
}

}  // namespace hawser
