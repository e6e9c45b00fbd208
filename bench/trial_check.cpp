// What must hold of a static answer, checked without the solver's own word for it (README.md, "The trial of statics").
//
//   equations    the residual, assembled anew, is below 1e-10 of the largest reaction (or of what rounding leaves)
//   stability    no part of the line is compressed, or the elastic tangent has no negative pivot, or all eigenvalues of the whole tangent have
//                positive real parts (trial_spectrum.cpp)
//   bending      no element that is too stiff to be turned by the forces, EI > F h^2, is squeezed to half its length anywhere: where r'
//                passes through zero a line turns back and shows no curvature
//   balance      reactions + weight + bodies + drag + bed = 0, the loads integrated here along the shape
//   hubs         the end forces of the lines that meet at a free point and the load there = 0
//   catenary     closed form: span under the computed end force, and the minimum of the energy from its dual,
//                  E = F(L).D - int ( |F| + |F|^2/2EA ) ds,   F = F0 - q s
//   hanging      closed form: straight, tension = what hangs below
//   equal legs   closed form: the free point is on their axis
#include "bench/trial.hpp"

#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "assembly/assembler.hpp"
#include "assembly/observables.hpp"
#include "assembly/seabed.hpp"
#include "assembly/seabed_bodies.hpp"
#include "solver/newton.hpp"
#include "solver/norms.hpp"
#include "solver/static_start_catenary.hpp"
#include "solver/static_start_loads.hpp"
#include "solver/static_system.hpp"
#include "solver/statics.hpp"

namespace hawser::bench {
namespace {

class TrialCheck {
 public:
  TrialCheck(const Trial& trial, const Model& model, const State& state) : trial_(trial), model_(model), state_(state), residual_(model.unknowns) {
    const Assembler assembler(model);
    assembler.residual(state, residual_);
    reference_ = reference_force(model, residual_);
    for (const Support& support : model.supports) reactions_ += Eigen::Map<const Vec3>(&residual_[model.dof(support.line, support.node)]);
    assembler.project(residual_);
  }

  std::optional<std::string> complaint(bool loose) const {
    for (const auto& check : {equations(loose ? 1e-6 : 1e-10), stability(), bending(), balance(), hubs(loose ? 1e-6 : 1e-10), closed_form()})
      if (check) return check;
    return std::nullopt;
  }

 private:
  using Complaint = std::optional<std::string>;

  Complaint equations(double tolerance) const {
    const double residual = residual_norm(model_, residual_), allowed = std::max(tolerance * reference_, unbalanced());
    if (residual <= 1.001 * allowed) return std::nullopt;
    return fmt::format("residual {:.2e} N of {:.2e} N allowed", residual, allowed);
  }

  /// N, of one node: the tolerance of Newton, or what rounding leaves.
  double unbalanced() const { return std::max(1e-10 * reference_, rounding_margin * roundoff_force(model_, state_)); }

  Complaint stability() const {
    if (free_of_compression(model_, state_)) return std::nullopt;
    const int pivots = negative_pivots_of_elastic_tangent(model_, state_);
    if (pivots == 0) return std::nullopt;
    const double slowest = least_decay(model_, state_);
    if (slowest > 0.0) return std::nullopt;
    return fmt::format("unstable: {} negative pivots, slowest decay {:.2g} N/m2", pivots, slowest);
  }

  Complaint bending() const {
    for (int line = 0; line < static_cast<int>(model_.lines.size()); ++line) {
      for (int i = 0; i < model_.lines[line].elements; ++i) {
        const int e = model_.lines[line].first_element + i;
        if (model_.element.EI[e] <= reference_ * std::pow(model_.element.length[e], 2)) continue;
        for (int k = 0; k <= 8; ++k)
          if (const double stretch = place(line, i, k / 8.0).second.norm(); stretch < 0.5)
            return fmt::format("turns back in element {} of {}: stretch {:.2g}", i + 1, model_.lines[line].name, stretch);
      }
    }
    return std::nullopt;
  }

  Complaint balance() const {
    const Vec3 fine = loads(20), coarse = loads(10);
    const double error = (reactions_ + fine).norm();
    // Twenty and ten midpoints an element: their difference bounds what the integration leaves, and the kernels' own three points.
    const double allowed = model_.total_nodes() * unbalanced() + 50.0 * (fine - coarse).norm();
    // The kernels' own points: three for drag where the line bends within an element, four for friction that turns round within one. Midpoints
    // of ours where a line leaves the bed.
    double kernel = 0.02 * drag_;
    if (model_.seabed) kernel += (0.02 + 2.0 * std::max(model_.seabed->law.friction_axial, model_.seabed->law.friction_lateral)) * heaviest_element();
    if (error <= allowed + kernel) return std::nullopt;
    return fmt::format("out of balance by {:.2e} N of {:.2e} N", error, reference_);
  }

  /// What the lines exert on a hub, from the end forces of their elements.
  Complaint hubs(double tolerance) const {
    if (model_.hubs.empty()) return std::nullopt;
    const double allowed = 2.0 * std::max(tolerance * reference_, unbalanced());
    const std::vector<PointResult> points = observe_points(model_, state_);
    for (const Hub& hub : model_.hubs) {
      Vec3 force = points[hub.point].force;
      for (const Body& body : model_.bodies)
        if (body.line == hub.ends[0].line && body.node == hub.ends[0].node)
          force += body_force(model_, body, points[hub.point].position.z()) + points[hub.point].bed;
      if (force.norm() > allowed) return fmt::format("\"{}\" out of balance by {:.2e} N", model_.points[hub.point].name, force.norm());
      for (const Support& end : hub.ends)
        if (node(end.line, end.node, 0) != points[hub.point].position) return fmt::format("lines apart at \"{}\"", model_.points[hub.point].name);
    }
    return std::nullopt;
  }

  double heaviest_element() const {
    double heaviest = 0.0;
    for (std::size_t e = 0; e < model_.element.length.size(); ++e)
      heaviest = std::max(heaviest, std::abs(model_.element.weight[e]) * model_.element.length[e]);
    return heaviest;
  }

  /// All loads but the reactions.
  Vec3 loads(int points) const {
    Vec3 sum = Vec3::Zero();
    drag_ = 0.0;
    for (const Body& body : model_.bodies) sum += body_force(model_, body, node(body.line, body.node, 0).z()) + seabed_force(model_, state_, body);
    for (const SpreadLoad& spread : model_.spread_loads) sum += spread.share * spread.force(0.0);
    for (int line = 0; line < static_cast<int>(model_.lines.size()); ++line)
      for (int i = 0; i < model_.lines[line].elements; ++i) sum += loads_on(line, i, points);
    return sum;
  }

  Vec3 loads_on(int line, int i, int points) const {
    const int e = model_.lines[line].first_element + i;
    const double l = model_.element.length[e];
    Vec3 sum = -l * model_.element.weight[e] * Vec3::UnitZ();
    for (int k = 0; k < points; ++k) {
      const double xi = (k + 0.5) / points;
      const auto [r, slope] = place(line, i, xi);
      const Vec3 drag = drag_density(model_, e, slope.normalized(), r.z());
      drag_ += l / points * drag.norm();
      sum += l / points * drag;
      if (model_.seabed) sum += l / points * seabed_force(model_, state_, line, e, xi);
    }
    return sum;
  }

  /// Position (offset 0) or slope (3) at a node.
  Vec3 node(int line, int node, int offset) const { return Eigen::Map<const Vec3>(&state_.q[model_.dof(line, node) + offset]); }

  /// Position and slope within an element of the line.
  std::pair<Vec3, Vec3> place(int line, int i, double x) const {
    const double l = model_.element.length[model_.lines[line].first_element + i];
    const Vec3 a = node(line, i, 0), b = node(line, i + 1, 0), chord = (b - a) / l;
    if (model_.lines[line].family == Family::bar) return {a + x * (b - a), chord};
    const Vec3 p = node(line, i, 3), q = node(line, i + 1, 3);
    const Vec3 r = a + l * (x * chord + x * (1 - x) * ((1 - x) * (p - chord) - x * (q - chord)));
    return {r, chord + (1 - x) * (1 - 3 * x) * (p - chord) + x * (3 * x - 2) * (q - chord)};
  }

  Complaint closed_form() const {
    if (trial_.known == Known::nothing) return std::nullopt;
    if (trial_.known == Known::hanging) return hanging();
    double energy = 0.0, allowed = 0.0;
    for (int line = 0; line < static_cast<int>(model_.lines.size()); ++line)
      if (const auto complaint = catenary(line, energy, allowed)) return complaint;
    if (const auto complaint = energies(energy, allowed)) return complaint;
    return trial_.known == Known::equal_legs ? on_the_axis() : std::nullopt;
  }

  /// Also adds the energy of the line, and what it may be off.
  Complaint catenary(int index, double& energy, double& energy_allowed) const {
    const Line& line = model_.lines[index];
    const int e = line.first_element;
    const double w = model_.element.weight[e], L = line.length, EA = model_.element.EA[e], l = L / line.elements;
    const Vec3 from = node(index, 0, 0), chord = node(index, line.nodes - 1, 0) - from;
    const CatenarySegment whole{L, EA, -w * Vec3::UnitZ(), Vec3::Zero()};
    const EndForce exact = solve_end_force({whole}, chord);
    const Vec3 F = observe_line(model_, state_, index).force_from;
    const double order = line.family == Family::bar ? 2.0 : 4.0, H = exact.force.head<2>().norm();
    const double turn = std::abs(w) * l / H;  // of the line within an element at its lowest point
    if (!trial_.degenerate && turn < 0.5) {
      const double gap = (catenary_span(whole, F, L) - chord).norm(),
                   allowed = L * (1e-7 + std::pow(turn, order)) + line.nodes * unbalanced() * catenary_compliance(whole, F, L).norm();
      if (gap > allowed) return fmt::format("misses the catenary by {:.2e} m of {:.2e} m allowed", gap, allowed);
    }
    const double error = (F - exact.force).norm();
    // A bight that turns within an element leaves the weight of that element open.
    if (turn >= 0.5 && error > 2.0 * std::abs(w) * l) return fmt::format("end force off by {:.3g} weights of an element", error / std::abs(w) / l);
    energy += least_energy(whole, exact.force, from, chord);
    energy_allowed += 1e-7 * std::abs(w) * L * (L + chord.norm() + std::abs(from.z())) + 4.0 * std::abs(w) * l * l;
    return std::nullopt;
  }

  double least_energy(const CatenarySegment& whole, const Vec3& F0, const Vec3& from, const Vec3& chord) const {
    constexpr int panels = 20000;
    double dual = 0.0;
    for (int k = 0; k < panels; ++k) {
      const double T = (F0 - (k + 0.5) / panels * whole.length * whole.load).norm();
      dual += whole.length / panels * (T + 0.5 * T * T / whole.EA);
    }
    return (F0 - whole.length * whole.load).dot(chord) - dual - whole.load.z() * whole.length * from.z();
  }

  Complaint energies(double exact, double allowed) const {
    Energies found = observe_energies(model_, state_);
    for (const Hub& hub : model_.hubs)
      for (const Body& body : model_.bodies)
        if (body.line == hub.ends[0].line && body.node == hub.ends[0].node) found.potential -= body.wet_weight * node(body.line, body.node, 0).z();
    const double difference = found.axial + found.potential - exact;
    if (std::abs(difference) <= allowed + 1e-7 * found.axial) return std::nullopt;
    return fmt::format("energy off by {:.2e} J of {:.2e} J allowed", difference, allowed + 1e-7 * found.axial);
  }

  Complaint on_the_axis() const {
    const double off = node(model_.hubs[0].ends[0].line, model_.hubs[0].ends[0].node, 0).head<2>().norm();
    if (off <= 1e-6 * model_.lines[0].length) return std::nullopt;
    return fmt::format("{:.2e} m off the axis", off);
  }

  Complaint hanging() const {
    const Line& line = model_.lines[0];
    const double w = model_.element.weight[0], L = line.length, EA = model_.element.EA[0];
    const double body = model_.bodies.empty() ? 0.0 : model_.bodies[0].wet_weight, top = w * L + body;
    const LineResult found = observe_line(model_, state_, 0);
    const double tension = line.from_free ? found.tension_to : found.tension_from;
    if (std::abs(tension - std::abs(top)) > 1e-8 * std::abs(top) + line.nodes * unbalanced())
      return fmt::format("top tension {:.8g} N instead of {:.8g} N", tension, std::abs(top));
    const double sign = top > 0.0 ? -1.0 : 1.0, reach = L + (std::abs(body) * L + 0.5 * std::abs(w) * L * L) / EA;
    const int end = line.from_free ? 0 : line.nodes - 1;
    const Vec3 r = node(0, end, 0);
    const double off = (r - model_.points[line.from_free ? line.to : line.from].position - sign * reach * Vec3::UnitZ()).norm();
    if (off <= 1e-6 * L) return std::nullopt;
    return fmt::format("free end {:.2e} m off", off);
  }

  const Trial& trial_;
  const Model& model_;
  const State& state_;
  std::vector<double> residual_;
  double reference_ = 0.0;
  mutable double drag_ = 0.0;  // N, along the last integral
  Vec3 reactions_ = Vec3::Zero();
};

double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

std::optional<std::string> complaint(const Trial& trial, const Model& model, const State& state, bool loose) {
  return TrialCheck(trial, model, state).complaint(loose);
}

TrialOutcome run_trial(const Trial& trial) {
  const Model model = build_model(trial.scene);
  const Assembler assembler(model);
  TrialOutcome outcome;
  State state;
  const double begin = processor_seconds();
  outcome.report = solve_static(assembler, {}, state);
  outcome.seconds = processor_seconds() - begin;
  outcome.converged = outcome.report.converged;
  outcome.factorizations = outcome.report.iterations;
  outcome.loose = outcome.converged && outcome.report.residual > 1e-10 && outcome.report.stages.back().find("looser tolerance") != std::string::npos;
  if (outcome.converged) outcome.wrong = complaint(trial, model, state, outcome.loose);
  return outcome;
}

}  // namespace hawser::bench
