#include "solver/static_system.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <numeric>

#include "assembly/observables.hpp"
#include "assembly/symmetry.hpp"

namespace hawser {
namespace {

constexpr double automatic_tolerance = 1e-10;
constexpr double minimum_share = 1e-6;      // of the load on an element in Model::minimum_tension
constexpr double neutral_share = 1e-2;      // of the load on an element over the length of the line: a thousandth of what lets a column fall
constexpr double neutral_rounding = 1e-14;  // of EA/l
constexpr TangentWeights static_weights{1.0, 0.0, 0.0};

/// Negative pivots of a tangent, with a little stiffness on every node (k on r, k l^2 on r'): what rounding or a hundredth of a pendulum's stiffness
/// decides is neutral. A line whose ends are above each other turns freely about them.
int negative_pivots(const Model& model, Tangent tangent) {
  BlockTridiagonal& matrix = tangent.chain;
  for (std::size_t index = 0; index < model.lines.size(); ++index) {
    const Line& line = model.lines[index];
    const Chain& chain = matrix.chains()[index];
    for (int i = 0; i < chain.nodes; ++i) {
      const int e = line.first_element + std::min(i, line.elements - 1);
      const double l = model.element.length[e], load = model.element.minimum_tension[e] / minimum_share;
      const double k = neutral_share * load / line.length + neutral_rounding * model.element.EA[e] / l;
      for (int c = 0; c < chain.block; ++c) matrix.D(chain, i)[c * (chain.block + 1)] += c < 3 ? k : k * l * l;
    }
  }
  return inertia_of_symmetric_part(matrix).negative + tangent.negative_inner_pivots() + negative_hub_pivots(tangent);
}

}  // namespace

LeastTension least_strain_tension(const Model& model, const State& state) {
  LeastTension least;
  for (int line = 0; line < static_cast<int>(model.lines.size()); ++line) {
    const LineResult result = observe_line(model, state, line);
    if (line == 0 || result.least_strain_tension < least.value) least = {result.least_strain_tension, result.least_strain_tension_s, line};
  }
  return least;
}

StaticSystem::StaticSystem(const Assembler& assembler, LinearSolver& linear, double tolerance, double exact_below, State& state)
    : assembler_(assembler),
      model_(assembler.model()),
      linear_(linear),
      state_(state),
      relative_tolerance_(tolerance > 0.0 ? tolerance : automatic_tolerance),
      exact_below_(exact_below),
      tangent_(assembler.make_tangent()),
      symmetry_(static_symmetry(model_, state)),
      r_(model_.unknowns),
      d_(model_.unknowns) {
  linear_.analyze(tangent_);
  const std::vector<double>& least = model_.element.minimum_tension;
  least_kept_ = *std::max_element(least.begin(), least.end());
}

double StaticSystem::residual() {
  assembler_.residual(state_, r_);
  reference_force_ = hawser::reference_force(model_, r_);
  roundoff_ = roundoff_force(model_, state_);
  assembler_.project(r_);
  residual_ = residual_norm(model_, r_);
  return residual_;
}

double StaticSystem::least_tension() { return least_strain_tension(model_, state_).value; }

bool StaticSystem::solve(double floor) {
  bool exact = floor == 0.0 && residual_ <= exact_below_ * reference_force_ && least_tension() < -10.0 * least_kept_;
  const bool definite = !exact || !keep_definite_ || negative_pivots_here() == 0;
  exact = exact && definite;
  TangentPanels panels = assembler_.tangent_panels(state_, {1.0, 0.0, resistance_}, {floor, !exact, floor > 0.0 || !definite}, r_, tangent_, rhs());
  // Proved for bodies at rest (assembly/symmetry.hpp). Where a line is compressed LU is taken: rounding that keeps to the symmetry keeps a straight
  // line from buckling.
  if (symmetry_ == Symmetry::symmetric && resistance_ == 0.0 && least_tension() >= 0.0) {
    assert(static_symmetry(model_, state_) == Symmetry::symmetric);  // only positions change
    panels.declare(Symmetry::symmetric);
  }
  factor_report_ = solve_with(panels);
  assembler_.project(r_);
  if (factor_report_.status != FactorStatus::ok) return false;
  assembler_.expand(tangent_, rhs(), d_);
  return true;
}

FactorReport StaticSystem::solve_with(TangentPanels& panels) {
  if (!modified_) {
    const FactorReport report = linear_.solve_once(panels, tangent_, rhs());
    if (report.status != FactorStatus::not_applicable) return report;
  }
  modified_ = true;
  panels.whole();
  tangent_.symmetrize();
  const FactorReport report = linear_.factorize(tangent_);
  if (report.status == FactorStatus::ok) linear_.solve(rhs());
  return report;
}

int StaticSystem::negative_pivots_here() {
  assembler_.tangent(state_, static_weights, TangentFloor{}, r_, tangent_);
  return negative_pivots(model_, tangent_);
}

double StaticSystem::work() const { return std::inner_product(d_.begin(), d_.end(), r_.begin(), 0.0); }

void StaticSystem::carry(bool moving) {
  if (moving)
    for (std::size_t i = 0; i < d_.size(); ++i) d_[i] += carried_[i];
  carried_ = d_;
}

void StaticSystem::advance(double factor) {
  for (std::size_t i = 0; i < d_.size(); ++i) state_.q[i] += factor * d_[i];
  if (resistance_ == 0.0) return;
  for (std::size_t i = 0; i < d_.size(); ++i) state_.a[i] += resistance_ * factor * d_[i];
}

void StaticSystem::resist(double c) {
  resistance_ = c;
  start_ = state_.q;
  std::fill(state_.a.begin(), state_.a.end(), 0.0);
}

void StaticSystem::go_back() {
  state_.q = start_;
  std::fill(state_.a.begin(), state_.a.end(), 0.0);
}

bool free_of_compression(const Model& model, const State& state) {
  const double roundoff = roundoff_force(model, state);
  for (int index = 0; index < static_cast<int>(model.lines.size()); ++index) {
    const Line& line = model.lines[index];
    const auto EI = model.element.EI.begin() + line.first_element;
    const double softest = *std::min_element(EI, EI + line.elements);
    const bool clamped = std::any_of(model.supports.begin(), model.supports.end(), [&](const Support& s) { return s.line == index && s.clamped; });
    const bool alone = line.from_hub < 0 && line.to_hub < 0;  // at a hub other lines may push sideways
    const double euler = clamped && alone ? softest * std::pow(std::numbers::pi / (2.0 * line.length), 2) : 0.0;
    if (observe_line(model, state, index).least_strain_tension < -std::max(roundoff, euler)) return false;
  }
  return true;
}

Model elastic_part(const Model& model) {
  Model elastic = model;
  std::fill(elastic.element.drag_normal.begin(), elastic.element.drag_normal.end(), 0.0);
  std::fill(elastic.element.drag_tangential.begin(), elastic.element.drag_tangential.end(), 0.0);
  const TimeFunction none;
  for (Body& body : elastic.bodies) {
    body.drag = 0.0;
    body.moment = none;
  }
  if (elastic.seabed) elastic.seabed->friction_tangent = FrictionTangent::frozen;
  return elastic;
}

Model with_unit_mass(const Model& model) {
  Model massive = model;
  std::fill(massive.element.mass.begin(), massive.element.mass.end(), 1.0);
  std::fill(massive.element.added_normal.begin(), massive.element.added_normal.end(), 0.0);
  std::fill(massive.element.added_tangential.begin(), massive.element.added_tangential.end(), 0.0);
  for (Body& body : massive.bodies) body.mass = body.added_mass = 0.0;
  return massive;
}

int negative_pivots_of_elastic_tangent(const Model& model, const State& state) {
  const Model elastic = elastic_part(model);
  const Assembler assembler(elastic);
  Tangent tangent = assembler.make_tangent();
  std::vector<double> r(elastic.unknowns);
  assembler.tangent(state, static_weights, TangentFloor{}, r, tangent);
  return negative_pivots(elastic, tangent);
}

int unstable_directions(const Model& model, const State& state) {
  return free_of_compression(model, state) ? 0 : negative_pivots_of_elastic_tangent(model, state);
}

}  // namespace hawser
