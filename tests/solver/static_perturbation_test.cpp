#include "solver/static_perturbation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "solver/statics.hpp"
#include "tests/support/scene_builder.hpp"
#include "tests/support/static_solution.hpp"

namespace hawser {
namespace {

Model hung(const Vec3& to, double length) {
  return build_model(test::SceneBuilder()
                         .type(test::line_type("rope", 1e6, 10.0))
                         .fixed("a", {0, 0, 0})
                         .fixed("b", to)
                         .line("a", "b")
                         .section("rope", length, 40)
                         .scene);
}

Eigen::Map<Vec3> slope(const Model& model, State& state, int node) { return Eigen::Map<Vec3>(&state.q[model.dof(0, node) + 3]); }

TEST(Knot, IsAReversedSlopeInATautLine) {
  const Model taut = hung({100, 0, 0}, 99.0);
  State state = static_start(taut, StaticStart::catenary);
  EXPECT_FALSE(find_knot(taut, state));
  slope(taut, state, 20) *= -1.0;
  const auto knot = find_knot(taut, state);
  ASSERT_TRUE(knot);
  EXPECT_DOUBLE_EQ(knot->s, taut.lines[0].s[19]);
  EXPECT_GT(knot->tension, 1e4);
}

TEST(Knot, IsNotTheFoldOfALineThatHangsInTwoLegs) {
  const Model legs = hung({0, 0, 10}, 100.0);
  const State state = static_start(legs, StaticStart::catenary);
  EXPECT_TRUE(folded(legs, state));
  EXPECT_FALSE(find_knot(legs, state));
}

// r' passing through zero turns a stiff line back without any curvature: collinear states that satisfy every equation and are no equilibria of a
// beam.
TEST(Knot, IsAReversedSlopeOfAStiffElementAtAClampOrUnderLittleTension) {
  const auto column = [](double EI) {
    test::SceneBuilder b;
    b.dry().type(test::line_type("pipe", 1e7, 1.0, EI)).fixed("foot", {0, 0, 0}).free("top", {0, 0, 10});
    b.line("foot", "top", ModelChoice::beam).section("pipe", 10.0, 8).clamp_from({0, 0, 1});
    return build_model(b.scene);
  };
  const Model stiff = column(100.0), limp = column(1e-3);
  State state = static_start(stiff, StaticStart::straight);
  for (int i = 0; i <= 8; ++i) state.q[stiff.dof(0, i) + 2] *= -1.0;
  for (int i = 1; i <= 8; ++i) slope(stiff, state, i) *= -1.0;
  EXPECT_TRUE(find_knot(stiff, state));
  EXPECT_FALSE(find_knot(limp, state));  // hangs from its clamp through a bend shorter than the element
}

TEST(StaticsOfAStiffLine, AColumnTooHeavyToStandBendsOver) {
  double height[2];
  for (const int elements : {16, 64}) {
    test::SceneBuilder b;
    b.dry().type(test::line_type("pipe", 1e7, 1.0, 100.0)).fixed("foot", {0, 0, 0}).free("top", {0, 0, 10});
    b.line("foot", "top").section("pipe", 10.0, elements).clamp_from({0, 0, 1});
    for (const StaticStart start : {StaticStart::catenary, StaticStart::straight}) {
      const test::StaticSolution s(b.scene, start);
      height[elements == 64] = test::position(s, "top").z();
      EXPECT_NEAR(s.stations({0.625})[0].position.z(), 0.625, 0.02);  // still upright there: EI/w L^3 = 0.1
    }
  }
  EXPECT_NEAR(height[0], height[1], 0.01);
}

// Shortened by d, a pinned strut bows and carries Euler's load: P = pi^2 EI/L^2 (1 + d/2L + ...), d/L = 1.8e-4.
TEST(StaticsOfAStiffLine, AStrutPushedTogetherBowsAndCarriesEulersLoad) {
  for (const int elements : {16, 64}) {
    test::SceneBuilder b;
    b.dry().type(test::line_type("rod", 1e6, 1e-3, 1000.0)).fixed("foot", {0, 0, 0}).fixed("top", {0, 0, 9.9982});
    b.line("foot", "top").section("rod", 10.0, elements);
    const test::StaticSolution s(b.scene);
    const double euler = std::pow(std::numbers::pi / 10.0, 2) * 1000.0;
    EXPECT_NEAR(test::force(s, "top").z(), euler, 1e-3 * euler);
  }
}

TEST(OpenStart, HasNoFoldAndKeepsTheEnds) {
  for (const Vec3& to : {Vec3(0, 0, 10), Vec3(0, 0, 0), Vec3(5, 3, 0)}) {
    const Model legs = hung(to, 100.0);
    const State state = open_start(legs);
    EXPECT_FALSE(folded(legs, state)) << to.transpose();
    EXPECT_EQ(Vec3(Eigen::Map<const Vec3>(&state.q[legs.dof(0, 40)])), to);
    EXPECT_EQ(Vec3(Eigen::Map<const Vec3>(&state.q[legs.dof(0, 0)])), Vec3::Zero());
  }
}

TEST(BowSideways, MovesTheMiddleAndKeepsTheEnds) {
  const Model model = hung({60, 0, 0}, 100.0);
  const State before = static_start(model, StaticStart::straight);
  State after = before;
  bow_sideways(model, after);
  EXPECT_EQ(Vec3(Eigen::Map<const Vec3>(&after.q[model.dof(0, 40)])), Vec3(60, 0, 0));
  EXPECT_LT(after.q[model.dof(0, 20) + 2], before.q[model.dof(0, 20) + 2] - 1.0);  // downward, along the load
}

}  // namespace
}  // namespace hawser
