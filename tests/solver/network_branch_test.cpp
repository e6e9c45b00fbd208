// Curves, KINSOL and the softest mode of lines that meet at free points.
#include <gtest/gtest.h>

#include "solver/bordered_solver.hpp"
#include "solver/curve.hpp"
#include "solver/model_branch.hpp"
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

// The ring lies doubled across the current, pushed together where drag holds it. On eight elements another equilibrium is found first, which drag
// does not hold.
TEST(Network, WithACompressedRingIsSolvedOnEveryMesh) {
  for (const int elements : {2, 3, 4, 6, 8}) {
    SCOPED_TRACE(elements);
    const StaticSolution solution(network_with_ring(elements, ModelChoice::beam));
    EXPECT_GT(solution.report.negative_pivots, 0);
    EXPECT_GT(solution.report.slowest_decay.value_or(-1.0), 0.0);
  }
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

/// Unknowns of straight lines of a pyramid with its hub at height h.
std::vector<double> pyramid_at(const Model& model, double h) {
  State state = model.make_state();
  for (int k = 0; k < 4; ++k) {
    const Vec3 corner = Pyramid::corner(k), hub(0, 0, h), from = k % 2 == 0 ? corner : hub, to = k % 2 == 0 ? hub : corner;
    const Line& line = model.lines[k];
    for (int i = 0; i < line.nodes; ++i) {
      Eigen::Map<Vec3>(&state.q[model.dof(k, i)]) = from + line.s[i] / line.length * (to - from);
      if (model.chain(k).block == 6) Eigen::Map<Vec3>(&state.q[model.dof(k, i) + 3]) = (to - from) / line.length;
    }
  }
  return state.q;
}

class SnappingPyramid : public ::testing::TestWithParam<double> {};

TEST_P(SnappingPyramid, FoldsAtItsHubWhereItsClosedFormDoes) {
  const double EI = GetParam(), top = 4.0, F0 = Pyramid::force(top), hf = Pyramid::fold_height();
  const auto model = [&](double F) { return build_model(Pyramid::scene(F, EI)); };
  const Model first = model(F0);
  ModelBranch branch(model, first, 1.0, {});
  ContinuationOptions options;
  for (int i = -4; i <= 4; ++i) options.stops.push_back(0.25 * i * F0);
  options.target = -F0;
  options.first_step = 0.05 * F0;
  const ContinuationReport report = follow_branch(branch, F0, pyramid_at(first, top), options);
  ASSERT_EQ(report.end, ContinuationEnd::reached);
  ASSERT_EQ(report.folds, 2);
  const double precision = 1e-9 * 4.0 * Pyramid::EA * hf / Pyramid::l;  // residuals end below 1e-10 of the reaction
  const double near = 1e-4 * hf;                                        // of a fold, where the stiffness of the hub is nothing and its sign rounding
  double sign = -1.0;
  for (const BranchPoint& point : report.points) {
    const double h = point.q[first.dof(0, first.lines[0].nodes - 1) + 2];
    EXPECT_NEAR(point.p, Pyramid::force(h), precision);
    for (const Support& end : first.hubs[0].ends) EXPECT_EQ(point.q[first.dof(end.line, end.node) + 2], h);
    if (point.kind == BranchPoint::Kind::fold) {
      EXPECT_NEAR(point.p, Pyramid::force(-sign * hf), precision);
      sign = -sign;
    } else if (std::abs(std::abs(h) - hf) > near) {
      EXPECT_EQ(point.negative_pivots, std::abs(h) > hf ? 0 : 1) << h;
    }
  }
}

// Bars of one element have no unknowns but the hub's; beams, held far below their Euler load of 2e4 N, have some of their own beside it.
INSTANTIATE_TEST_SUITE_P(Bars, SnappingPyramid, ::testing::Values(0.0, 2.0e5), [](const auto& test) { return test.param == 0.0 ? "bars" : "beams"; });

TEST(StaticCurve, FollowsAHubThroughItsFolds) {
  const double hf = Pyramid::fold_height(), snap = Pyramid::force(hf), last = 1.3 * snap;  // from lifted to pressed down, past both folds
  const int n = 9;
  const auto force = [&](double i) { return last * (2.0 * i / (n - 1) - 1.0); };
  const auto model_at = [&](double i) { return std::optional<Model>(build_model(Pyramid::scene(force(i), 2.0e5))); };
  CurveWay way{model_at, {}};
  for (int i = 0; i < n; ++i) way.values.push_back(i);
  StaticCurve curve(way);
  std::vector<double> folds;
  int unstable = 0;
  for (int i = 0; i < n; ++i) {
    const Model model = *model_at(i);
    State state = model.make_state();
    const CurveReport report = curve.next(Assembler(model), i, {}, state);
    EXPECT_TRUE(report.statics.converged) << i;
    EXPECT_EQ(report.branch, 1) << i;
    const double F = force(i), h = state.q[model.dof(0, 3) + 2];
    EXPECT_NEAR(h, F > snap ? Pyramid::height(F, hf, 6.0) : Pyramid::height(F, -6.0, -hf), 1e-8) << i;
    for (const PassedPoint& point : report.passed) {
      if (point.fold) folds.push_back(force(point.p));
      unstable += !point.fold && !point.stable;
      if (!point.fold) {
        EXPECT_EQ(point.negative_pivots, point.stable ? 0 : 1);
      }
    }
  }
  ASSERT_EQ(folds.size(), 2u);
  EXPECT_NEAR(folds[0], snap, 1e-8 * std::abs(snap));
  EXPECT_NEAR(folds[1], -snap, 1e-8 * std::abs(snap));
  EXPECT_GE(unstable, 1);
}

}  // namespace
}  // namespace hawser::test
