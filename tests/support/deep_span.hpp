// The deep span that most tests of statics work on, and how they solve and compare it.
#pragma once

#include "solver/statics.hpp"
#include "tests/support/scene_builder.hpp"

namespace hawser::test {

/// 5000 m of U40 from 3000 m deep to the surface, 3000 m away (theory, scene S1).
inline SceneBuilder deep(int elements, double EI = 0.0, double L = 5000.0) {
  LineType type = u40();
  type.EI = EI;
  return SceneBuilder().type(type).fixed("bottom", {0, 0, -3000}).fixed("top", {3000, 0, 0}).line("bottom", "top").section("U40", L, elements);
}

inline StaticReport solve(const Model& model, State& state, StaticStart start = StaticStart::catenary,
                          LinearSolverKind kind = LinearSolverKind::automatic) {
  const Assembler assembler(model);
  StaticOptions options;
  options.start = start;
  options.linear_solver = kind;
  return solve_static(assembler, options, state);
}

/// Of the nodes of the first line.
inline double largest_distance(const Model& model, const State& a, const State& b) {
  double largest = 0.0;
  for (int i = 0; i < model.lines[0].nodes; ++i)
    largest = std::max(largest, (Eigen::Map<const Vec3>(&a.q[model.dof(0, i)]) - Eigen::Map<const Vec3>(&b.q[model.dof(0, i)])).norm());
  return largest;
}

}  // namespace hawser::test
