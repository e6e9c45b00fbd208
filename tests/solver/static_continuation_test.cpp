#include "solver/static_continuation.hpp"

#include <gtest/gtest.h>

#include "tests/support/scene_builder.hpp"

namespace hawser {
namespace {

Model hung(double EI, ModelChoice model = ModelChoice::automatic) {
  return build_model(test::SceneBuilder()
                         .type(test::line_type("rope", 1e9, 10.0, EI))
                         .fixed("a", {0, 0, 0})
                         .fixed("b", {20, 0, 0})
                         .line("a", "b", model)
                         .section("rope", 100.0, 40)
                         .scene);
}

TEST(StaticContinuation, BeginsStifferInBendingAndSofterInTension) {
  const Model real = hung(0.0);
  const StaticContinuation way(real, 1000.0);
  EXPECT_FALSE(way.at_end());
  EXPECT_EQ(way.model().lines[0].family, Family::beam);
  EXPECT_DOUBLE_EQ(way.model().element.EI[0], 1e-3 * 1000.0 * 100.0 * 100.0);
  EXPECT_LT(way.model().element.EA[0], 1e9);
}

TEST(StaticContinuation, EndsAtTheModelItself) {
  const Model real = hung(0.0);
  StaticContinuation way(real, 1000.0);
  double EI = way.model().element.EI[0];
  while (!way.at_end()) {
    way.advance();
    EXPECT_LE(way.model().element.EI[0], EI);
    EI = way.model().element.EI[0];
  }
  EXPECT_EQ(&way.model(), &real);
  EXPECT_LT(way.steps(), 20);
}

TEST(StaticContinuation, PassesOverWhatTheLineHasItself) {
  const Model real = hung(1e5);  // more than it would begin with
  const StaticContinuation way(real, 1000.0);
  EXPECT_EQ(way.model().element.EI, real.element.EI);
  const Model bars = hung(0.0, ModelChoice::bar);
  EXPECT_EQ(StaticContinuation(bars, 1000.0).model().element.EI[0], 0.0);
}

TEST(StaticContinuation, GoesBackAndOnInShorterStepsUntilItGivesUp) {
  const Model real = hung(0.0);
  StaticContinuation way(real, 1000.0);
  const double first = way.model().element.EI[0];
  way.advance();
  const double far = way.model().element.EI[0];
  ASSERT_TRUE(way.retreat());
  EXPECT_DOUBLE_EQ(way.model().element.EI[0], first);
  way.advance();
  EXPECT_GT(way.model().element.EI[0], far);
  EXPECT_LT(way.model().element.EI[0], first);
  int tries = 0;
  for (; way.retreat() && tries < 100; ++tries) way.advance();
  EXPECT_LT(tries, 20);
}

}  // namespace
}  // namespace hawser
