// Curves of equilibria: the same answers as single statics, for fewer factorizations, whatever happens on the way.
#include "solver/curve.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "assembly/observables.hpp"
#include "tests/support/scene_builder.hpp"

namespace hawser::test {
namespace {

/// The 5000 m tether of the deep catenary with its top moved by `offset` along x and y, in a current across it.
Scene tether(double offset, double current, int elements = 200) {
  SceneBuilder b;
  b.type(u40()).fixed("bottom", {0, 0, -3000}).fixed("top", {3000 + offset, 0.5 * offset, 0}).line("bottom", "top").section("U40", 5000.0, elements);
  if (current != 0.0) b.current(0.0, {0, current, 0});
  return b.scene;
}

Scene thread(double wet_weight) {
  return SceneBuilder()
      .dry()
      .type(line_type("thread", 1.0e6, wet_weight))
      .fixed("a", {0, 0, 0})
      .fixed("b", {90, 0, 0})
      .line("a", "b")
      .section("thread", 100.0, 20)
      .scene;
}

struct Solved {
  CurveReport report;
  LineResult line;
};

Solved solve_next(StaticCurve& curve, const Scene& scene, double p, State& state, StaticStart start = StaticStart::catenary) {
  const Model model = build_model(scene);
  StaticOptions options;
  options.start = start;
  Solved solved;
  solved.report = curve.next(Assembler(model), p, options, state);
  if (solved.report.statics.converged) solved.line = observe_line(model, state, 0);
  return solved;
}

Solved solve_next(StaticCurve& curve, const Scene& scene, double p) {
  State state;
  return solve_next(curve, scene, p, state);
}

/// A cold solve: the first of a curve of its own.
Solved solve_cold(const Scene& scene, StaticStart start = StaticStart::catenary) {
  StaticCurve curve;
  State state;
  return solve_next(curve, scene, 0.0, state, start);
}

/// Both answers satisfy R_hat <= max(tolerance F_ref, 2 F_floor), and end forces are wrong by about R_hat (solver/README.md).
double newton_noise(const StaticReport& a, const StaticReport& b) {
  const auto of = [](const StaticReport& r) { return std::max(1e-10 * r.reference_force, 2.0 * r.roundoff_floor); };
  return of(a) + of(b);
}

TEST(StaticCurve, OffsetsOfTheTopEqualIndependentColdSolvesToTheNewtonTolerance) {
  for (const double current : {0.0, 0.6}) {
    StaticCurve curve;
    for (int i = 0; i <= 10; ++i) {
      const Scene scene = tether(80.0 * i - 400.0, current);
      const Solved warm = solve_next(curve, scene, i), cold = solve_cold(scene);
      ASSERT_TRUE(warm.report.statics.converged && cold.report.statics.converged) << i;
      EXPECT_EQ(warm.report.warm, i > 0) << current << " " << i;
      EXPECT_FALSE(cold.report.warm);
      const double noise = newton_noise(warm.report.statics, cold.report.statics);
      EXPECT_NEAR(warm.line.tension_from, cold.line.tension_from, noise) << current << " " << i;
      EXPECT_NEAR(warm.line.tension_to, cold.line.tension_to, noise) << current << " " << i;
      EXPECT_LT((warm.line.force_to - cold.line.force_to).norm(), noise) << current << " " << i;
    }
  }
}

TEST(StaticCurve, WarmStartsTakeFewerFactorizationsThanColdOnesInTotal) {
  for (const StaticStart start : {StaticStart::catenary, StaticStart::straight}) {
    StaticCurve curve;
    State state;
    int warm = 0, cold = 0;
    for (int i = 0; i <= 20; ++i) {
      const Scene scene = tether(20.0 * i, 0.6);
      warm += solve_next(curve, scene, i, state, start).report.statics.iterations;
      cold += solve_cold(scene, start).report.statics.iterations;
    }
    EXPECT_LT(warm, cold);
  }
}

TEST(StaticCurve, AValueWithoutEquilibriumIsReportedAndTheCurveGoesOn) {
  StaticCurve curve;
  EXPECT_TRUE(solve_next(curve, thread(10.0), 0).report.statics.converged);
  const Solved refused = solve_next(curve, thread(0.0), 1);  // slack, without load
  EXPECT_FALSE(refused.report.statics.converged);
  EXPECT_FALSE(refused.report.warm);
  EXPECT_FALSE(refused.report.statics.failure.what.empty());
  const Solved after = solve_next(curve, thread(10.5), 2);
  ASSERT_TRUE(after.report.statics.converged);
  EXPECT_TRUE(after.report.warm);  // from the value before the one that failed
  const Solved cold = solve_cold(thread(10.5));
  EXPECT_NEAR(after.line.tension_to, cold.line.tension_to, newton_noise(after.report.statics, cold.report.statics));
}

TEST(StaticCurve, AnUnusableWarmStartIsGivenUpForTheColdOne) {
  // From the net-buoyant arch the sagging catenary is not to be reached: the shape has to pass through its chord.
  StaticCurve curve;
  ASSERT_TRUE(solve_next(curve, thread(-10.0), 0).report.statics.converged);
  const Solved sagging = solve_next(curve, thread(10.0), 1), cold = solve_cold(thread(10.0));
  ASSERT_TRUE(sagging.report.statics.converged);
  EXPECT_TRUE(sagging.report.statics.stable);
  EXPECT_NEAR(sagging.line.tension_to, cold.line.tension_to, newton_noise(sagging.report.statics, cold.report.statics));
  EXPECT_NEAR(sagging.line.force_to.z(), -500.0, newton_noise(sagging.report.statics, cold.report.statics));  // half of the weight, down
  EXPECT_GE(sagging.report.statics.stages.size(), sagging.report.warm ? 1u : 2u);
}

TEST(StaticCurve, AnotherMeshStartsCold) {
  StaticCurve curve;
  ASSERT_TRUE(solve_next(curve, tether(0.0, 0.6, 100), 0).report.statics.converged);
  const Solved finer = solve_next(curve, tether(0.0, 0.6, 120), 1);
  EXPECT_TRUE(finer.report.statics.converged);
  EXPECT_FALSE(finer.report.warm);
  EXPECT_TRUE(solve_next(curve, tether(10.0, 0.6, 120), 2).report.warm);
}

TEST(StaticCurve, ALineWithAFreeEndMovesWithItsSupport) {
  const auto tow = [](double x) {
    return SceneBuilder()
        .type(u40())
        .towed("ship", {x, 0, 0}, {1.5, 0.5, 0})
        .free("fish", {-500, 0, -500}, weight(3000.0))
        .line("ship", "fish")
        .section("U40", 800.0, 40)
        .scene;
  };
  StaticCurve curve;
  State first, second;
  ASSERT_TRUE(solve_next(curve, tow(0.0), 0, first).report.statics.converged);
  const Solved moved = solve_next(curve, tow(100.0), 1, second);
  EXPECT_TRUE(moved.report.warm);
  EXPECT_EQ(moved.report.statics.iterations, 1);  // the moved shape is the answer
  EXPECT_EQ(second.v, first.v);
  // A transverse force f of rounding or tolerance moves the end by f L/T, T >= 3 kN, L = 800 m.
  const double noise = newton_noise(moved.report.statics, moved.report.statics) * 800.0 / 3000.0;
  for (std::size_t node = 0; node <= 40; ++node) EXPECT_NEAR(second.q[6 * node], first.q[6 * node] + 100.0, noise) << node;
}

}  // namespace
}  // namespace hawser::test
