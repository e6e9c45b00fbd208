// Curves, KINSOL and the softest mode of lines that meet at free points.
#include <gtest/gtest.h>

#include "solver/bordered_solver.hpp"
#include "solver/curve.hpp"
#include "solver/stability.hpp"
#include "solver/sundials/kinsol.hpp"
#include "tests/support/network_scenes.hpp"
#include "tests/support/static_solution.hpp"

namespace hawser::test {
namespace {

TEST(Network, HasTheEquilibriumOfKinsol) {
  const StaticSolution newton(small_network(4, ModelChoice::cable));
  State state;
  const StaticReport report = solve_static_kinsol(Assembler(*newton.model), {}, state);
  ASSERT_TRUE(report.converged) << report.failure.what << report.failure.cause;
  for (std::size_t i = 0; i < newton.model->unknowns; ++i) EXPECT_NEAR(state.q[i], newton.state.q[i], 1e-6);
}

TEST(Network, MultipliesAsItSolves) {
  const Model model = build_model(network_with_ring(3, ModelChoice::beam));
  const Assembler assembler(model);
  Tangent tangent = assembler.make_tangent();
  std::vector<double> r(model.unknowns), x(model.dofs), y(model.dofs), back(model.dofs);
  assembler.tangent(static_start(model, StaticStart::catenary), {1.0, 10.0, 200.0}, {}, r, tangent);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = std::sin(0.7 * static_cast<double>(i));
  assembler.project(x);
  for (const Hub& hub : model.hubs)
    for (const Support& end : hub.ends) std::copy_n(&x[model.dof(hub.ends[0].line, hub.ends[0].node)], 3, &x[model.dof(end.line, end.node)]);
  multiply(tangent, x, y);
  back = y;
  const auto chains = make_linear_solver(LinearSolverKind::chain);
  BorderedSolver solver(*chains);
  solver.analyze(tangent);
  ASSERT_EQ(solver.factorize(tangent).status, FactorStatus::ok);
  solver.solve(back);
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(back[i], x[i], 1e-9);  // rounding times the condition of some metres of line
}

TEST(Network, SoftestModeMovesTheHingeOfTwoStruts) {
  SceneBuilder b;
  b.dry().type(line_type("strut", 1.0e6, 1.0, 1.0e5)).fixed("a", {0, 0, 0}).fixed("b", {19.98, 0, 0}).free("hinge", {9.99, 0, 0});
  b.line("a", "hinge").section("strut", 10.0, 8).line("hinge", "b").section("strut", 10.0, 8);
  const Model model = build_model(b.scene);
  const std::optional<StabilityMode> mode = softest_mode(model, static_start(model, StaticStart::straight), 1000.0);
  ASSERT_TRUE(mode.has_value());
  EXPECT_EQ(mode->negative_pivots, 2);
  EXPECT_LT(mode->stiffness, 0.0);
  const std::size_t hinge = model.dof(0, 8);
  EXPECT_NEAR(std::hypot(mode->shape[hinge + 1], mode->shape[hinge + 2]), 1.0, 1e-6);  // largest where the struts meet
  EXPECT_NEAR(mode->shape[hinge + 1], mode->shape[model.dof(1, 0) + 1], 1e-12);
}

}  // namespace
}  // namespace hawser::test
