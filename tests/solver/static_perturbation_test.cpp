#include "solver/static_perturbation.hpp"

#include <gtest/gtest.h>

#include "solver/statics.hpp"
#include "tests/support/scene_builder.hpp"

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
