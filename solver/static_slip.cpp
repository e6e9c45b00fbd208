#include "solver/static_slip.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solver/norms.hpp"

namespace hawser {
namespace {

constexpr int most_iterations = 1500;   // factorizations for the first equilibrium
constexpr int most_steps = 800;         // of the branch
constexpr int step_iterations = 5;      // factorizations, about
constexpr double first_step = 0.1;      // decades of d
constexpr double difference = 1e-6;     // decades, of the derivative by p
constexpr double way_tolerance = 1e-8;  // of the points of the branch
constexpr double room = 1.0;            // decades that it may turn back beyond its first point

Model with_slip(const Model& model, double slip) {
  Model other = model;
  other.seabed->law.slip = slip;
  return other;
}

}  // namespace

SlipBranch follow_slip(const Model& model, const StaticOptions& options, double share, int iterations) {
  const double real = model.seabed->law.slip;
  SlipBranch result;
  result.first = result.least = share * longest_line(model);
  if (result.first <= real) return result;
  StaticOptions own = options;
  own.start = StaticStart::catenary;
  own.max_iterations = std::min(most_iterations, iterations);
  own.log = nullptr;
  const Model loose = with_slip(model, result.first);
  State start;
  const StaticReport begun = solve_static(Assembler(loose, std::max(1, options.threads)), own, start);
  result.factorizations = begun.iterations;
  result.started = begun.converged;
  if (!begun.converged) return result;

  own.tolerance = way_tolerance;
  ModelBranch branch([&](double p) { return with_slip(model, real * std::pow(10.0, p)); }, loose, difference, own);
  const double p = std::log10(result.first / real);
  ContinuationOptions way;
  way.stops = {0.0, p + room};
  way.first_step = first_step;
  way.most_steps = way.steps_to_fold = std::min(most_steps, (iterations - begun.iterations) / step_iterations);
  way.folds_change_stability = false;
  const ContinuationReport followed = follow_branch(branch, p, start.q, way);
  result.reached = followed.end == ContinuationEnd::reached;
  result.folds = followed.folds;
  result.factorizations += followed.factorizations;
  for (const BranchPoint& point : followed.points) result.least = std::min(result.least, real * std::pow(10.0, point.p));
  if (result.reached) {
    branch.move_to(0.0, start.q);
    result.state = branch.state_of(followed.points.back().q);
  }
  return result;
}

std::string describe(const SlipBranch& branch) {
  const std::string outcome = branch.reached   ? "arrived"
                              : branch.started ? fmt::format("no way on at {:.2g} m", branch.least)
                                               : "no equilibrium there";
  return fmt::format("branch in the slip from {:.2g} m: {}, {} folds, {} factorizations", branch.first, outcome, branch.folds, branch.factorizations);
}

}  // namespace hawser
