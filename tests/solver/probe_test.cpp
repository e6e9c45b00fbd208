// Probing: lines with one equilibrium and lines with several.
#include "solver/probe.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/network_scenes.hpp"
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

TEST(Probe, AHubIsFoundOnBothSidesOfItsCorners) {
  // Pressed by half of what makes it snap, the pyramid stands above its corners or hangs below them.
  const double hf = Pyramid::fold_height(), F = 0.5 * Pyramid::force(hf);
  const double above = Pyramid::height(F, hf, 6.0), below = Pyramid::height(F, -6.0, -hf);
  for (const double EI : {0.0, 2.0e5}) {
    const ProbeReport report = probed(Pyramid::scene(F, EI, above), 10, 1, StaticStart::straight);
    ASSERT_EQ(report.equilibria.size(), 2u) << EI;
    for (const ProbedEquilibrium& e : report.equilibria) {
      const double h = e.state.q[EI == 0.0 ? 5 : 20];  // the end of the first line, of one element or of three
      EXPECT_NEAR(h, h > 0.0 ? above : below, 1e-8);
      EXPECT_NEAR(e.energy, h > 0.0 ? Pyramid::energy(above) + (Pyramid::force(above) - F) * above : Pyramid::energy(below), 1e-6);
      EXPECT_EQ(e.report.negative_pivots, 0);
      EXPECT_TRUE(e.report.stable);
    }
    EXPECT_NEAR(report.equilibria[1].distance, (above - below) / Pyramid::l, 1e-8);
    EXPECT_LT(Pyramid::energy(below), Pyramid::energy(above));
  }
}

TEST(Probe, AMooredBuoyHasOneEquilibrium) {
  // Lines without bending stiffness over a level frictionless bed: the energy is convex in every direction but those of compression.
  SceneBuilder b;
  b.type(line_type("chain", 5.0e8, 1000.0)).free("buoy", {20, -10, -5}, weight(-3.0e5));
  b.scene.environment.depth = 100.0;
  b.scene.environment.seabed.stiffness = 1.0e5;
  for (int k = 0; k < 3; ++k) {
    const double heading = 2.0 * std::numbers::pi / 3.0 * k;
    b.fixed("a" + std::to_string(k), {400.0 * std::cos(heading), 400.0 * std::sin(heading), -100.0});
    b.line("a" + std::to_string(k), "buoy").section("chain", 420.0, 30);
  }
  const ProbeReport report = probed(b.scene, 10);
  ASSERT_EQ(report.equilibria.size(), 1u);
  EXPECT_GE(report.equilibria[0].found, 6);
}

TEST(Probe, TheSameSeedGivesTheSameBits) {
  const ProbeReport a = probed(pushed_pipe(8.0), 6, 7), b = probed(pushed_pipe(8.0), 6, 7);
  ASSERT_EQ(a.equilibria.size(), b.equilibria.size());
  for (std::size_t i = 0; i < a.equilibria.size(); ++i) {
    EXPECT_EQ(a.equilibria[i].state.q, b.equilibria[i].state.q);
    EXPECT_EQ(a.equilibria[i].found, b.equilibria[i].found);
  }
}

TEST(Probe, EnergyOfALineThatLiesOnTheBedHoldsThatOfTheBed) {
  // A thread as long as its way, laid between two points at the depth to which it sinks: w/k of a metre, w^2/2k for every metre.
  const double w = 12.0, k = 2.0e3, L = 50.0, z = -20.0 - w / k;
  SceneBuilder b;
  b.dry().type(line_type("thread", 1.0e6, w)).fixed("a", {0, 0, z}).fixed("b", {L, 0, z}).line("a", "b").section("thread", L, 10);
  b.scene.environment.depth = 20.0;
  b.scene.environment.seabed.stiffness = k;
  const StaticSolution s(b.scene);
  EXPECT_NEAR(observe_energies(*s.model, s.state).bed, w * w / (2.0 * k) * L, 1e-9 * w * L);
  EXPECT_NEAR(potential_energy(*s.model, s.state), w * w / (2.0 * k) * L + w * L * z, 1e-9 * w * L * 20.0);
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
