// Static solves of folds, knots and impossible scenes: the right state, or a failure that says why.
#include <gtest/gtest.h>

#include <random>

#include "solver/norms.hpp"
#include "solver/statics.hpp"
#include "tests/support/deep_span.hpp"
#include "tests/support/scene_builder.hpp"
#include "tests/support/static_solution.hpp"

namespace hawser::test {
namespace {

TEST(StaticRobustness, AKnottedRandomStartEndsInTheRightStateOrIsRefused) {
  for (const double EI : {0.0, 1.0e3}) {
    const StaticSolution right(deep(1000, EI).scene);
    for (const unsigned seed : {1u, 2u, 3u}) {
      State state = right.state;
      std::mt19937_64 random(seed);
      std::normal_distribution<double> knot(0.0, 1.0);
      for (int i = 0; i < right.model->lines[0].nodes; ++i)
        for (int c = 0; c < 3; ++c) {
          state.q[right.model->dof(0, i) + c] += 50.0 * knot(random);  // ten elements
          state.q[right.model->dof(0, i) + 3 + c] += knot(random);     // slopes in every direction
        }
      right.model->prescribe(state);
      const StaticReport report = solve(*right.model, state, StaticStart::given);
      if (!report.converged) {
        EXPECT_FALSE(report.failure.what.empty());
        continue;
      }
      // Two answers differ by what rounding leaves, as from the straight start.
      const double noise = 4.0 * report.roundoff_floor * 5000.0 / (4.0 * 13161.0);
      EXPECT_LT(largest_distance(*right.model, right.state, state), noise) << "EI = " << EI << ", seed " << seed;
    }
  }
}

// A line that hangs in two vertical legs folds within an element, of which the end forces do not know more than its weight.
TEST(StaticRobustness, ALineInTwoVerticalLegsIsSolvedAndItsEndForcesAreTheWeightOfTheLegs) {
  constexpr double w = 100.0, L = 60.0, apart = 20.0;
  for (const int elements : {31, 120}) {
    const StaticSolution s(SceneBuilder()
                               .dry()
                               .type(line_type("rope", 1.0e8, w))
                               .fixed("low", {0, 0, 0})
                               .fixed("high", {0, 0, apart})
                               .line("low", "high")
                               .section("rope", L, elements)
                               .scene);
    const double l = L / elements;
    EXPECT_NEAR(s.line.tension_from, 0.5 * w * (L - apart), w * l);
    EXPECT_NEAR(s.line.tension_to, 0.5 * w * (L + apart), w * l);
    EXPECT_NEAR(s.line.tension_from + s.line.tension_to, w * L, w * l);
  }
}

TEST(StaticRobustness, ALineThatMayTurnFreelyAboutItsEndsIsNotCalledUnstable) {
  const StaticSolution s(SceneBuilder()
                             .dry()
                             .type(line_type("rope", 1.0e8, 100.0, 200.0))
                             .fixed("low", {0, 0, 0})
                             .fixed("high", {0, 0, 5})
                             .line("low", "high")
                             .section("rope", 40.0, 80)
                             .scene);
  EXPECT_EQ(s.report.negative_pivots, 0);
}

TEST(StaticRobustness, ALineWithAFreeEndAndWithoutLoadIsRefusedInItsOwnWords) {
  const Model model = build_model(SceneBuilder()
                                      .dry()
                                      .type(line_type("thread", 1.0e5, 0.0))
                                      .fixed("a", {0, 0, 0})
                                      .free("b", {100, 0, 0}, weight(0.0))
                                      .line("a", "b")
                                      .section("thread", 101.0, 10)
                                      .scene);
  State state;
  const StaticReport report = solve(model, state);
  EXPECT_FALSE(report.converged);
  EXPECT_NE(report.failure.what.find("has a free end and carries no load"), std::string::npos);
  EXPECT_NE(report.failure.remedy.find("thrust"), std::string::npos);
  EXPECT_EQ(report.failure.stage, "before any stage");
}

TEST(StaticRobustness, AFailureNamesItsStageAndKeepsTheBestState) {
  const Model model = build_model(deep(100).scene);
  const Assembler assembler(model);
  StaticOptions options;
  options.start = StaticStart::straight;
  options.max_iterations = 5;
  State state;
  const StaticReport report = solve_static(assembler, options, state);
  ASSERT_FALSE(report.converged);
  EXPECT_EQ(report.failure.stage, "tension-floored Newton from the start");
  EXPECT_NE(report.failure.kept.find("5 factorizations"), std::string::npos);
  // The residual of the report is that of the state which is kept.
  std::vector<double> r(model.unknowns);
  assembler.residual(state, r);
  assembler.project(r);
  EXPECT_DOUBLE_EQ(residual_norm(model, r), report.residual_force);
}

}  // namespace
}  // namespace hawser::test
