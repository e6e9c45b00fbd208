#include "solver/static_failure.hpp"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "solver/static_perturbation.hpp"
#include "solver/static_start_loads.hpp"

namespace hawser {
namespace {

constexpr const char* loosen_the_bed = "take a larger seabed slip, shorter elements on the bed, or less slack there";

/// Ends held, no load at all and longer than its chord: every shape of that length is in equilibrium.
bool shapeless(const Model& model, int index) {
  const Line& line = model.lines[index];
  if (load_scale(model, index) > 0.0) return false;
  if (line.from_free || line.to_free) return true;
  if (line.from_hub >= 0 || line.to_hub >= 0) return false;  // what meets it there may stretch it
  return (model.points[line.to].motion(0.0).r - model.points[line.from].motion(0.0).r).norm() <= line.length;
}

/// Points that are held themselves or joined by lines to one that is.
std::vector<char> held_points(const Model& model) {
  std::vector<char> held;
  for (const ModelPoint& point : model.points) held.push_back(!point.free);
  for (bool more = true; more;) {
    more = false;
    for (const Line& line : model.lines) {
      if (held[line.from] == held[line.to]) continue;
      held[line.from] = held[line.to] = more = true;
    }
  }
  return held;
}

bool clamped(const Model& model, int line) {
  for (const Support& support : model.supports)
    if (support.line == line && support.clamped && model.lines[line].family == Family::beam) return true;
  return false;
}

/// Of a solve that did not end for want of iterations.
std::string likely_cause(const Model& model, const LeastTension& least) {
  const Line& line = model.lines[least.line];
  const std::string place = fmt::format("at s = {:.6g} m of \"{}\"", least.s, line.name);
  if (model.rubs())
    return fmt::format("friction holds the line in one of many ways, and it slips from one to the next; the least strain tension is {:.4g} N {}",
                       least.value, place);
  if (model.seabed && !model.seabed->surface.level())
    return fmt::format(
        "the bed is not level: the line slides, or lies on a bump that is shorter than its elements; the least strain tension is {:.4g} N {}",
        least.value, place);
  if (least.value < 0.0)
    return fmt::format("the line went slack: strain tension {:.4g} N {}, where it may fold within an element", least.value, place);
  return "the first guess is too far away, or the elements are too long for the bends or the current";
}

Failure without_shape(const Line& line) {
  const bool hangs = line.from_free || line.to_free;
  return {fmt::format("no static equilibrium can be told from any other: the line {} and carries no load", hangs ? "has a free end" : "is slack"),
          line.name,
          0.0,
          fmt::format("no weight in water, no current or tow with drag, no force on it{}", hangs ? "" : ", and it is not stretched between its ends"),
          hangs ? "give the line type a mass or wet_weight, the free point a weight or a thrust, or add a current and drag"
                : "give the line type a mass or wet_weight, add a current and drag, or shorten the line below the distance of its ends",
          "before any stage",
          {}};
}

}  // namespace

std::string meeting_point(const Model& model, std::size_t unknown) {
  for (const Hub& hub : model.hubs)
    for (const Support& end : hub.ends)
      if (const std::size_t r = model.dof(end.line, end.node); r <= unknown && unknown < r + 3) return model.points[hub.point].name;
  return "";
}

std::optional<Failure> refuse(const Model& model) {
  const std::vector<char> held = held_points(model);
  for (int index = 0; index < static_cast<int>(model.lines.size()); ++index) {
    const Line& line = model.lines[index];
    if (!held[line.from])
      return Failure{"no static equilibrium: nothing holds the line",
                     line.name,
                     0.0,
                     fmt::format("its ends \"{}\" and \"{}\" are free, and so is every point that it is joined to by other lines",
                                 model.points[line.from].name, model.points[line.to].name),
                     "fix or move one of these points, or run it in time with start = \"straight\"",
                     "before any stage",
                     {}};
    if (shapeless(model, index) && !clamped(model, index)) return without_shape(line);
  }
  return std::nullopt;
}

std::optional<Knot> certify(const Model& model, const State& state, StaticReport& report) {
  report.negative_pivots = unstable_directions(model, state);
  const std::optional<Knot> knot = find_knot(model, state);
  report.stable = report.negative_pivots == 0 && !knot;
  return knot;
}

Failure knotted(const Model& model, const Knot& knot) {
  Failure failure;
  failure.what =
      fmt::format("only a knotted equilibrium was found: the line turns back within an element, under a strain tension of {:.4g} N", knot.tension);
  failure.line = model.lines[knot.line].name;
  failure.s = knot.s;
  failure.cause = "the start holds a loop that is smaller than the elements can follow";
  failure.remedy = "start from the catenary (--start catenary), or use elements shorter than the loop if it is meant";
  return failure;
}

Failure explain_failure(const Model& model, const State& state, const StaticSystem& system, const NewtonReport& newton, const StaticReport& report) {
  const LeastTension least = least_strain_tension(model, state);
  Failure failure;
  if (const auto knot = newton.converged() ? find_knot(model, state) : std::nullopt) return knotted(model, *knot);
  if (newton.converged()) {
    failure.what = fmt::format("only an unstable equilibrium was found: {} negative pivots, strain tension {:.4g} N (compression)",
                               report.negative_pivots, least.value);
    failure.line = model.lines[least.line].name;
    failure.s = least.s;
    failure.cause =
        model.rubs() ? "friction pushes the slack line together where it lies; it gives way at the least push, and no motion came to rest elsewhere"
                     : "a straight compressed line satisfies the equations but would buckle at once";
    failure.remedy =
        model.rubs()
            ? loosen_the_bed
            : "start from the catenary (--start catenary), offset an end sideways, or give the line type an EI so that it can carry the load";
    return failure;
  }
  const WorstNode worst = system.worst();
  const Line& line = model.lines[worst.line];
  failure.line = line.name;
  failure.s = line.s[worst.node];
  failure.what =
      fmt::format("static equilibrium not found: residual {:.3g} N is {:.1e} of {:.4g} N after {} factorizations, largest in the {}", newton.residual,
                  report.residual, report.reference_force, report.iterations, worst.slope ? "slope equation" : "force balance");
  const std::string point = meeting_point(model, model.dof(worst.line, worst.node));
  if (!point.empty() && !worst.slope) failure.what += fmt::format(" of the point \"{}\"", point);
  if (system.factor_report().status != FactorStatus::ok && newton.status == NewtonStatus::no_increment) {
    failure.cause = fmt::format("the tangent could not be factorized by {}: {}", report.linear_solver, system.factor_report().message);
    const std::string loose = meeting_point(model, system.factor_report().failed_unknown);
    if (!loose.empty()) failure.cause += fmt::format(" (point \"{}\")", loose);
    failure.remedy = system.factor_report().status == FactorStatus::not_applicable
                         ? "use linear_solver = \"chain\", which takes unsymmetric and indefinite tangents"
                         : "look for a part of the line that carries neither load nor tension; give its line type a weight or an EI";
  } else if (system.modified()) {
    failure.cause = fmt::format("{} takes symmetric matrices only and the drag is too strong for the symmetric part alone", report.linear_solver);
    failure.remedy = "use linear_solver = \"chain\"";
  } else {
    failure.cause = likely_cause(model, least);
    failure.remedy =
        model.rubs()
            ? loosen_the_bed
            : "give the line type a small EI, use more elements there, or solve first with less current or a shorter line and continue with --from";
  }
  return failure;
}

}  // namespace hawser
