// KINSOL and our Newton find the same equilibria.
#include "solver/sundials/kinsol.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "assembly/observables.hpp"
#include "solver/app/scene_reader.hpp"
#include "tests/support/scene_builder.hpp"

namespace hawser::test {
namespace {

struct Case {
  const char* name;
  Scene scene;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

Scene span(double current, double EI) {
  LineType type = u40();
  type.EI = EI;
  SceneBuilder b;
  b.type(type).fixed("a", {0, 0, -500}).fixed("b", {600, 0, 0}).line("a", "b").section("U40", 900.0, 60);
  if (EI > 0.0) b.clamp_from({0, 0, -1}).clamp_to({1, 0, 1});
  if (current != 0.0) b.current(0.0, {0.3 * current, current, 0.0});
  return b.scene;
}

Scene clump() {
  return SceneBuilder()
      .type(u40())
      .current(0.0, {0.6, 0.0, 0.0})
      .fixed("top", {0, 0, 0})
      .free("clump", {0, 0, -400}, weight(5000.0))
      .line("top", "clump")
      .section("U40", 400.0, 40)
      .scene;
}

Scene of_file(const char* name) { return read_scene(std::string(HAWSER_SOURCE_DIR) + "/data/scenes/" + name + ".toml", {}); }

class KinsolRoute : public testing::TestWithParam<Case> {};

TEST_P(KinsolRoute, FindsTheStateOfNewton) {
  const Model model = build_model(GetParam().scene);
  const Assembler assembler(model);
  State by_newton = model.make_state(), by_kinsol = model.make_state();
  const StaticReport newton = solve_static(assembler, {}, by_newton), kinsol = solve_static_kinsol(assembler, {}, by_kinsol);
  ASSERT_TRUE(newton.converged);
  ASSERT_TRUE(kinsol.converged) << kinsol.failure.what << "; " << kinsol.failure.cause;
  EXPECT_TRUE(kinsol.stable);
  EXPECT_EQ(kinsol.linear_solver, "chain");
  EXPECT_GE(kinsol.iterations, 1);
  ASSERT_FALSE(kinsol.stages.empty());
  // Both residuals are below max(1e-10 F_ref, 20 F_floor), and end forces are wrong by about as much (solver/README.md).
  const auto noise = [](const StaticReport& r) { return std::max(1e-10 * r.reference_force, 20.0 * r.roundoff_floor); };
  for (int line = 0; line < static_cast<int>(model.lines.size()); ++line) {
    const LineResult a = observe_line(model, by_newton, line), b = observe_line(model, by_kinsol, line);
    EXPECT_LT((a.force_from - b.force_from).norm(), noise(newton) + noise(kinsol));
    EXPECT_LT((a.force_to - b.force_to).norm(), noise(newton) + noise(kinsol));
    // Positions follow a force f by f L/T at most where the line is held by its tension T alone: 1e-7 of the length is far above it here.
    for (int i = 0; i < model.lines[line].nodes; ++i) {
      const std::size_t r = model.dof(line, i);
      EXPECT_LT((Eigen::Map<const Vec3>(&by_newton.q[r]) - Eigen::Map<const Vec3>(&by_kinsol.q[r])).norm(), 1e-7 * model.lines[line].length) << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, KinsolRoute,
                         testing::Values(Case{"catenary", span(0.0, 0.0)}, Case{"current", span(0.8, 0.0)}, Case{"beam", span(0.0, 500.0)},
                                         Case{"beam_in_a_current", span(0.5, 500.0)}, Case{"clump", clump()}, Case{"bed", of_file("mooring-chain")},
                                         Case{"lazy_wave", of_file("lazy-wave-960")}, Case{"sheared_current", of_file("current-shear")}),
                         [](const auto& one) { return std::string(one.param.name); });

TEST(Kinsol, RefusesWhatNewtonRefusesBeforeAnyIteration) {
  const Model model = build_model(SceneBuilder()
                                      .dry()
                                      .type(line_type("thread", 1e6, 0.0))
                                      .fixed("a", {0, 0, 0})
                                      .fixed("b", {90, 0, 0})
                                      .line("a", "b")
                                      .section("thread", 100.0, 10)
                                      .scene);
  State state = model.make_state();
  const Assembler assembler(model);
  const StaticReport newton = solve_static(assembler, {}, state), kinsol = solve_static_kinsol(assembler, {}, state);
  EXPECT_FALSE(kinsol.converged);
  EXPECT_EQ(kinsol.iterations, 0);
  EXPECT_EQ(kinsol.failure.what, newton.failure.what);
}

TEST(Kinsol, AnUnstableEquilibriumIsNoAnswer) {
  // A straight column above its Euler load, from straight lines: an equilibrium at once, and an unstable one.
  Scene scene = SceneBuilder()
                    .dry()
                    .type(line_type("column", 1e7, 1e-6, 100.0))
                    .fixed("a", {0, 0, 0})
                    .fixed("b", {0, 0, 9.9998})
                    .line("a", "b")
                    .section("column", 10.0, 16)
                    .scene;
  const Model model = build_model(scene);
  State state = model.make_state();
  StaticOptions options;
  options.start = StaticStart::given;
  state = static_start(model, StaticStart::straight);
  const StaticReport report = solve_static_kinsol(Assembler(model), options, state);
  EXPECT_NE(report.stages.front().find("converged, unstable"), std::string::npos) << report.stages.front();
  EXPECT_EQ(report.converged, report.stable);  // the catenary comes next, and may bow it
  ASSERT_GE(report.stages.size(), 2u);
  EXPECT_NE(report.stages[1].find("catenary"), std::string::npos);
}

// From the catenary, which hangs, the column would turn back within its first element and hang through its clamp.
TEST(Kinsol, DoesNotCallAKnotAnEquilibrium) {
  SceneBuilder b;
  b.dry().type(line_type("pipe", 1e7, 1.0, 100.0)).fixed("foot", {0, 0, 0}).free("top", {0, 0, 10});
  b.line("foot", "top").section("pipe", 10.0, 16).clamp_from({0, 0, 1});
  const Model model = build_model(b.scene);
  State state;
  const StaticReport report = solve_static_kinsol(Assembler(model), {}, state);
  EXPECT_FALSE(report.converged);
  EXPECT_FALSE(report.stable);
  EXPECT_NE(report.failure.what.find("knotted"), std::string::npos) << report.failure.what;
  EXPECT_EQ(report.failure.s, 0.0);
}

TEST(Kinsol, ObeysTheLimitOfFactorizationsAndSaysWhyItStopped) {
  const Model model = build_model(span(0.8, 0.0));
  State state = model.make_state();
  StaticOptions options;
  options.start = StaticStart::straight;
  options.max_iterations = 2;
  const StaticReport report = solve_static_kinsol(Assembler(model), options, state);
  EXPECT_FALSE(report.converged);
  EXPECT_LE(report.iterations, 2);
  EXPECT_NE(report.failure.what.find("KIN"), std::string::npos);
  EXPECT_EQ(report.failure.line, "line");
  EXPECT_FALSE(report.failure.remedy.empty());
}

}  // namespace
}  // namespace hawser::test
