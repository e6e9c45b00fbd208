// The error of a static answer from its mesh and its residual (statics.hpp).
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "assembly/observables.hpp"
#include "solver/statics.hpp"

namespace hawser {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// The lines of an answer on one mesh.
struct Answer {
  std::vector<int> elements;
  std::vector<LineResult> lines;
};

Answer answer_of(const Model& model, const State& state) {
  Answer answer;
  for (int line = 0; line < static_cast<int>(model.lines.size()); ++line) {
    answer.elements.push_back(model.lines[line].elements);
    answer.lines.push_back(observe_line(model, state, line));
  }
  return answer;
}

std::optional<Answer> solve_on(const Scene& scene, const StaticOptions& options) {
  const Model model = build_model(scene);
  State state;
  if (!solve_static(Assembler(model, std::max(1, options.threads)), options, state).converged) return std::nullopt;
  return answer_of(model, state);
}

double largest_difference(const LineResult& a, const LineResult& b) {
  return std::max(std::abs(a.tension_from - b.tension_from), std::abs(a.tension_to - b.tension_to));
}

/// What is left of `last`, the change of the last refinement of the mesh, where a refinement divides the error by `asymptotic` in
/// the limit and `before` was the change of the refinement before (NaN: not known).
double left_of_change(double last, double before, double asymptotic) {
  constexpr double least_contraction = 2.0;  // of a mesh too coarse for its order; the last change itself is left then
  const double contraction = std::isfinite(before) && last > 0.0 ? std::clamp(before / last, least_contraction, asymptotic) : least_contraction;
  const double left = last / (contraction - 1.0);
  // Changes of both signs can cancel in the last one; what the one before leaves at the full order is there all the same.
  return std::isfinite(before) ? std::max(left, before / (asymptotic * (asymptotic - 1.0))) : left;
}

}  // namespace

std::vector<double> estimate_static_error(const Scene& scene, const StaticOptions& options, const Model& model, const State& state,
                                          double residual_force) {
  std::vector<double> estimate(model.lines.size(), unknown);
  StaticOptions coarse_options = options;
  coarse_options.start = StaticStart::catenary;
  coarse_options.log = nullptr;
  const Scene half_scene = coarsened(scene);
  const std::optional<Answer> half = solve_on(half_scene, coarse_options);
  if (!half) return estimate;
  const std::optional<Answer> quarter = solve_on(coarsened(half_scene), coarse_options);
  const Answer fine = answer_of(model, state);
  for (std::size_t i = 0; i < estimate.size(); ++i) {
    const double ratio = static_cast<double>(fine.elements[i]) / half->elements[i];
    const double scale = std::max(fine.lines[i].tension_from, fine.lines[i].tension_to);
    if (ratio <= 1.0 || scale <= 0.0) continue;
    const double order = model.lines[i].family == Family::bar ? 2.0 : 4.0;
    const bool halved_twice = quarter && half->elements[i] > quarter->elements[i];
    const double before = halved_twice ? largest_difference(half->lines[i], quarter->lines[i]) : unknown;
    const double from_mesh = left_of_change(largest_difference(fine.lines[i], half->lines[i]), before, std::pow(ratio, order));
    estimate[i] = (from_mesh + residual_force) / scale;
  }
  return estimate;
}

}  // namespace hawser
