// Probing: lines with one equilibrium and lines with several.
#include "solver/probe.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/scene_builder.hpp"
#include "tests/support/static_solution.hpp"

namespace hawser::test {
namespace {

ProbeReport probed(const Scene& scene, int starts, unsigned seed = 1, StaticStart start = StaticStart::catenary) {
  const StaticSolution solution(scene, start);
  ProbeOptions options;
  options.starts = starts;
  options.seed = seed;
  return probe_equilibria(Assembler(*solution.model), {}, solution.state, solution.report, options);
}

/// A pipe of 10 m pushed together to `chord` between clamps on a level frictionless bed: it lies in an arch to one side or the other.
Scene pushed_pipe(double chord) {
  SceneBuilder b;
  b.dry().type(line_type("pipe", 1.0e5, 10.0, 100.0)).fixed("a", {0, 0, -20.01}).fixed("b", {chord, 0, -20.01}).line("a", "b");
  b.section("pipe", 10.0, 32).clamp_from({1, 0, 0}).clamp_to({1, 0, 0});
  b.scene.environment.depth = 20.0;
  b.scene.environment.seabed.stiffness = 1.0e3;
  return b.scene;
}

TEST(Probe, APlainCatenaryHasOneEquilibrium) {
  SceneBuilder b;
  b.type(u40()).fixed("a", {0, 0, -500}).fixed("b", {600, 0, 0}).line("a", "b").section("U40", 900.0, 30);
  const ProbeReport report = probed(b.scene, 20);
  ASSERT_EQ(report.equilibria.size(), 1u);
  EXPECT_EQ(report.equilibria[0].found + report.failed, 21);
  EXPECT_GE(report.equilibria[0].found, 15);
}

TEST(Probe, APushedPipeLiesToEitherSideWithTheSameEnergy) {
  // A state of its own with w0 to one side comes from a shape table: from its chord the pipe could not choose.
  Scene scene = pushed_pipe(9.9);
  scene.lines[0].start = ShapeTable{{0, 2.5, 5, 7.5, 10}, {{0, 0, -20}, {2.45, 0.3, -20}, {4.95, 0.6, -20}, {7.45, 0.3, -20}, {9.9, 0, -20}}};
  const ProbeReport report = probed(scene, 10, 1, StaticStart::given);
  ASSERT_EQ(report.equilibria.size(), 2u);
  const auto middle = [](const ProbedEquilibrium& e) { return e.state.q[6 * 16 + 1]; };
  EXPECT_NEAR(middle(report.equilibria[0]), -middle(report.equilibria[1]), 1e-6 * 10.0);
  EXPECT_GT(std::abs(middle(report.equilibria[0])), 0.3);
  for (const ProbedEquilibrium& e : report.equilibria) {
    EXPECT_TRUE(e.report.stable);
    EXPECT_GE(e.found, 1);
  }
  EXPECT_NEAR(report.equilibria[0].energy, report.equilibria[1].energy, 1e-8 * std::abs(report.equilibria[0].energy));
  EXPECT_NEAR(report.equilibria[1].distance, 2.0 * std::abs(middle(report.equilibria[0])) / 10.0, 1e-6);
  EXPECT_EQ(report.equilibria[0].distance, 0.0);
}

TEST(Probe, ALoopIsFoundBesideTheLineWithoutOne) {
  const ProbeReport report = probed(pushed_pipe(6.0), 25);
  double least = HUGE_VAL;
  bool looped = false;
  for (const ProbedEquilibrium& e : report.equilibria) {
    EXPECT_TRUE(e.report.stable);
    least = std::min(least, e.energy);
    // The tangent of a loop turns back somewhere and comes round on the other side: its direction covers a full turn.
    double turned = 0.0;
    for (int i = 0; i < 32; ++i) {
      const double* a = &e.state.q[6 * static_cast<std::size_t>(i) + 3];
      turned += std::atan2(a[0] * a[7] - a[1] * a[6], a[0] * a[6] + a[1] * a[7]);
    }
    looped = looped || std::abs(turned) > 6.0;
  }
  EXPECT_TRUE(looped);
  EXPECT_GE(report.equilibria.size(), 3u);
}

TEST(Probe, TheSameSeedGivesTheSameBits) {
  const ProbeReport a = probed(pushed_pipe(8.0), 6, 7), b = probed(pushed_pipe(8.0), 6, 7);
  ASSERT_EQ(a.equilibria.size(), b.equilibria.size());
  for (std::size_t i = 0; i < a.equilibria.size(); ++i) {
    EXPECT_EQ(a.equilibria[i].state.q, b.equilibria[i].state.q);
    EXPECT_EQ(a.equilibria[i].found, b.equilibria[i].found);
  }
}

TEST(Probe, PotentialEnergyGrowsByTheWorkAgainstConstantForces) {
  // A thread with a force at its middle, moved as a whole: the force and the weight do work, the strain energy stays.
  SceneBuilder b;
  b.dry().type(line_type("thread", 1.0e5, 5.0)).fixed("a", {0, 0, 0}).fixed("b", {9, 0, 0}).line("a", "b").section("thread", 10.0, 4);
  b.load(5.0, force({3.0, 0.0, -20.0}));
  const Model model = build_model(b.scene);
  State state = static_start(model, StaticStart::catenary);
  const double before = potential_energy(model, state);
  for (int i = 0; i < 5; ++i) {
    state.q[model.dof(0, i)] += 2.0;
    state.q[model.dof(0, i) + 2] += 1.0;
  }
  EXPECT_NEAR(potential_energy(model, state) - before, 5.0 * 10.0 - 3.0 * 2.0 + 20.0, 1e-9);
}

}  // namespace
}  // namespace hawser::test
