// What every benchmark works on: one line in water, of any family and number of elements, in the middle of a motion.
//
// Elements of 5 m of an umbilical (d 0.040 m, 2.5 kg/m, EA 4e7 N, beam: EI 1e3 N m2) with weight, drag, added mass and
// inertia in a sheared current; a smooth curved state under 20 kN to 50 kN of tension that moves and accelerates. The
// state is no equilibrium: a kernel costs the same, and 10^6 elements hang as easily as 100.
// Tangents are those of a time step of 0.05 s: stiffness + gamma' damping + beta' mass (solver/time/generalized_alpha.hpp).
#pragma once

#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <span>
#include <vector>

#include "assembly/assembler.hpp"
#include "assembly/model.hpp"
#include "solver/linear/linear_solver.hpp"
#include "solver/linear/refinement.hpp"
#include "solver/time/generalized_alpha.hpp"

namespace hawser::bench {

constexpr double element_length = 5.0;  // m

inline Scene line_scene(ModelChoice family, int elements, bool wet) {
  LineType type;
  type.name = "umbilical";
  type.diameter = 0.040;
  type.mass = 2.5;
  type.EA = 4.0e7;
  type.EI = family == ModelChoice::beam ? 1.0e3 : 0.0;
  if (wet) {
    type.drag_normal = 1.2;
    type.drag_tangential = 0.02;
    type.added_mass_normal = 1.0;
  }
  const double length = element_length * elements;
  Scene scene;
  scene.line_types = {type};
  if (wet) scene.environment.current = {{0.0, 0.8, 0.0}, {-100.0, 0.3, 1.0}};
  PointSpec from, to;
  from.name = "from";
  to.name = "to";
  to.position = {0.9 * length, 0.0, 0.0};
  scene.points = {from, to};
  LineSpec line;
  line.name = "line";
  line.from = from.name;
  line.to = to.name;
  line.model = family;
  line.sections = {SectionSpec{type.name, {}, length, elements}};
  scene.lines = {line};
  return scene;
}

/// A wave of 1000 m in two planes, |r'| = 1 + T/EA, integrated by the midpoint rule; velocities and accelerations alike.
inline State moving_state(const Model& model) {
  State state = model.make_state();
  const Line& line = model.lines.front();
  const auto slope = [](double s) {
    const double k = 2.0 * std::numbers::pi / 1000.0, tension = 3.5e4 + 1.5e4 * std::sin(0.7 * k * s);
    const Vec3 direction(1.0, 0.4 * std::cos(k * s), 0.3 * std::sin(1.3 * k * s));
    return Vec3((1.0 + tension / 4.0e7) * direction.normalized());
  };
  Vec3 r = Vec3::Zero();
  for (int i = 0; i < line.nodes; ++i) {
    const std::size_t d = model.dof(0, i);
    const double s = line.s[i];
    if (i > 0) r += (s - line.s[i - 1]) * slope(0.5 * (s + line.s[i - 1]));
    for (int k = 0; k < 3; ++k) {
      state.q[d + k] = r[k];
      state.v[d + k] = 0.5 * std::sin(0.01 * s + k);
      state.a[d + k] = 0.3 * std::cos(0.01 * s + k);
      if (line.family == Family::bar) continue;
      state.q[d + 3 + k] = slope(s)[k];
      state.v[d + 3 + k] = 0.005 * std::cos(0.01 * s + k);
      state.a[d + 3 + k] = -0.003 * std::sin(0.01 * s + k);
    }
  }
  model.reset_joints(state);
  return state;
}

inline TangentWeights step_weights() {
  constexpr double h = 0.05;
  const AlphaCoefficients alpha(0.8);
  return {1.0, alpha.gamma / (alpha.beta * h), (1.0 - alpha.alpha_m) / ((1.0 - alpha.alpha_f) * alpha.beta * h * h)};
}

struct MovingLine {
  Model model;
  Assembler assembler;
  State state;
  Tangent tangent;
  std::vector<double> r, d;
  std::span<double> rhs;  // in the place of d, as in a Newton iteration

  MovingLine(ModelChoice family, int elements, bool wet = true, int threads = 1)
      : model(build_model(line_scene(family, elements, wet))),
        assembler(model, threads),
        state(moving_state(model)),
        tangent(assembler.make_tangent()),
        r(model.unknowns),
        d(model.unknowns),
        rhs(d.data(), model.dofs) {}

  void assemble() { assembler.tangent(state, step_weights(), TangentFloor{}, r, tangent); }
  TangentPanels panels() { return assembler.tangent_panels(state, step_weights(), TangentFloor{}, r, tangent, rhs); }

  /// State, residual, properties and, where asked for, blocks: what a pass over the elements reads and writes.
  double bytes(bool with_tangent) const {
    const std::size_t blocks = with_tangent ? tangent.chain.values().size() : 0;
    return 8.0 * static_cast<double>(4 * model.unknowns + 14 * static_cast<std::size_t>(model.total_elements()) + blocks);
  }
};

/// Seconds per element of one iteration of the benchmark.
inline benchmark::Counter per_element(double elements) {
  return benchmark::Counter(elements, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

inline const char* word_of(ModelChoice family) { return family == ModelChoice::bar ? "bar" : family == ModelChoice::cable ? "cable" : "beam"; }

constexpr ModelChoice families[] = {ModelChoice::bar, ModelChoice::cable, ModelChoice::beam};

}  // namespace hawser::bench
