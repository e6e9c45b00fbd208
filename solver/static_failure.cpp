#include "solver/static_failure.hpp"

#include <fmt/format.h>

#include "solver/static_start_loads.hpp"

namespace hawser {
namespace {

/// Ends held, no load at all and longer than its chord: every shape of that length is in equilibrium.
bool shapeless(const Model& model, int index) {
  const Line& line = model.lines[index];
  if (load_scale(model, index) > 0.0) return false;
  if (line.from_free || line.to_free) return true;
  return (model.points[line.to].motion(0.0).r - model.points[line.from].motion(0.0).r).norm() <= line.length;
}

bool clamped(const Model& model, int line) {
  for (const Support& support : model.supports)
    if (support.line == line && support.clamped && model.lines[line].family == Family::beam) return true;
  return false;
}

}  // namespace

std::optional<Failure> refuse(const Model& model) {
  for (int index = 0; index < static_cast<int>(model.lines.size()); ++index) {
    const Line& line = model.lines[index];
    if (line.from_free && line.to_free)
      return Failure{"no static equilibrium: nothing holds the line", line.name, 0.0,
                     fmt::format("both its ends, \"{}\" and \"{}\", are free", model.points[line.from].name, model.points[line.to].name),
                     "fix or move one of the two points, or run it in time with start = \"straight\""};
    if (shapeless(model, index) && !clamped(model, index))
      return Failure{"no static equilibrium can be told from any other: the line is slack and carries no load", line.name, 0.0,
                     "no weight in water, no current or tow with drag, no force on it, and it is not stretched between its ends",
                     "give the line type a mass or wet_weight, add a current and drag, or shorten the line below the distance of its ends"};
  }
  return std::nullopt;
}

Failure explain_failure(const Model& model, const State& state, const StaticSystem& system, const NewtonReport& newton, const StaticReport& report) {
  const LeastTension least = least_strain_tension(model, state);
  Failure failure;
  if (newton.converged()) {
    failure.what = fmt::format("only an unstable equilibrium was found: {} negative pivots, strain tension {:.4g} N (compression)",
                               report.negative_pivots, least.value);
    failure.line = model.lines[least.line].name;
    failure.s = least.s;
    failure.cause = "a straight compressed line satisfies the equations but would buckle at once";
    failure.remedy = "start from the catenary (--start catenary), offset an end sideways, or give the line type an EI so that it can carry the load";
    return failure;
  }
  const WorstNode worst = system.worst();
  const Line& line = model.lines[worst.line];
  failure.line = line.name;
  failure.s = line.s[worst.node];
  failure.what =
      fmt::format("static equilibrium not found: residual {:.3g} N is {:.1e} of {:.4g} N after {} factorizations, largest in the {}", newton.residual,
                  report.residual, report.reference_force, report.iterations, worst.slope ? "slope equation" : "force balance");
  if (system.factor_report().status != FactorStatus::ok && newton.status == NewtonStatus::no_increment) {
    failure.cause = fmt::format("the tangent could not be factorized by {}: {}", report.linear_solver, system.factor_report().message);
    failure.remedy = system.factor_report().status == FactorStatus::not_applicable
                         ? "use linear_solver = \"chain\", which takes unsymmetric and indefinite tangents"
                         : "look for a part of the line that carries neither load nor tension; give its line type a weight or an EI";
  } else if (system.modified()) {
    failure.cause = fmt::format("{} takes symmetric matrices only and the drag is too strong for the symmetric part alone", report.linear_solver);
    failure.remedy = "use linear_solver = \"chain\"";
  } else if (least.value < 0.0) {
    failure.cause =
        fmt::format("the line went slack: strain tension {:.4g} N at s = {:.6g} m of \"{}\"", least.value, least.s, model.lines[least.line].name);
    failure.remedy =
        "give the line type a small EI, use more elements there, or solve first with less current or a shorter line and continue with --from";
  } else {
    failure.cause = "the first guess is too far away, or the elements are too long for the bends or the current";
    failure.remedy = "double the elements, try --start straight, or solve first with less current and continue with --from";
  }
  return failure;
}

}  // namespace hawser
