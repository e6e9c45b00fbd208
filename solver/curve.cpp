#include "solver/curve.hpp"

#include <algorithm>

namespace hawser {
namespace {

constexpr std::size_t most_known = 4;  // cubic: a higher degree follows the kinks of a touchdown no better
constexpr int warm_iterations = 15;    // factorizations; a guess that needs more is no better than a cold start

/// Numbers that two models share if a state of one is a state of the other.
std::vector<int> layout_of(const Model& model) {
  std::vector<int> layout;
  for (const Line& line : model.lines) layout.insert(layout.end(), {static_cast<int>(line.family), line.nodes});
  for (const Line& line : model.lines) layout.insert(layout.end(), {line.from_hub, line.to_hub});
  for (const Joint& joint : model.joints) layout.insert(layout.end(), {static_cast<int>(joint.jump), joint.element});
  return layout;
}

/// Moves the held ends of a line to where the model has them, and the line with them; a point where lines meet stays.
void follow_ends(const Model& model, int index, State& state) {
  const Line& line = model.lines[index];
  const Chain& chain = model.chain(index);
  const auto r = [&](int node) { return Eigen::Map<Vec3>(&state.q[chain.dof(node)]); };
  const auto way = [&](int point, int node) {
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

}  // namespace

State StaticCurve::predicted(const Model& model, double p) const {
  State state = static_start(model, StaticStart::straight);
  const State resting = state;  // or under tow: a static knows no other velocities of the supports
  state.q.assign(state.q.size(), 0.0);
  for (const Known& known : known_) {
    double weight = 1.0;
    for (const Known& other : known_)
      if (&other != &known) weight *= (p - other.p) / (known.p - other.p);
    for (std::size_t i = 0; i < state.q.size(); ++i) state.q[i] += weight * known.q[i];
  }
  for (int line = 0; line < static_cast<int>(model.lines.size()); ++line) follow_ends(model, line, state);
  model.prescribe(state);
  model.align_clamps(state);
  state.v = resting.v;
  state.a = resting.a;
  return state;
}

CurveReport StaticCurve::next(const Assembler& assembler, double p, const StaticOptions& options, State& state) {
  const Model& model = assembler.model();
  std::vector<int> layout = layout_of(model);
  if (layout != layout_) known_.clear();
  layout_ = std::move(layout);

  CurveReport report;
  if (!known_.empty()) {
    StaticOptions warm = options;
    warm.start = StaticStart::given;
    warm.max_iterations = std::min(warm_iterations, options.max_iterations);
    State found = predicted(model, p);
    report.statics = solve_static(assembler, warm, found);
    report.warm = report.statics.converged;
    if (report.warm) state = std::move(found);
  }
  if (!report.warm) {
    const StaticReport tried = std::move(report.statics);
    report.statics = solve_static(assembler, options, state);
    report.statics.iterations += tried.iterations;
    report.statics.stages.insert(report.statics.stages.begin(), tried.stages.begin(), tried.stages.end());
    if (report.statics.converged) known_.clear();  // perhaps another branch
  }
  if (!report.statics.converged) return report;
  known_.push_back({p, state.q});
  if (known_.size() > most_known) known_.pop_front();
  return report;
}

}  // namespace hawser
