// Motion of lines that meet at free points: as one line, at rest where they are in equilibrium, with the momenta of free flight.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "tests/support/dynamic_scenes.hpp"
#include "tests/support/network_scenes.hpp"
#include "tests/support/static_solution.hpp"

namespace hawser::test {
namespace {

/// 200 m of U40 hanging from a heaving point to a fixed one, a clump at 120 m: on the line, or at a point where two lines meet.
Scene heaving(bool two, double clump) {
  BodySpec body;
  body.mass = clump;
  body.drag_area = 0.5;
  body.added_mass = 0.3 * clump;
  SceneBuilder b;
  b.type(u40()).current(0.0, {0.4, 0.2, 0}).fixed("top", {0, 0, 0}).fixed("bottom", {100, 0, -120});
  b.scene.points[0].motion = MotionSpec{};
  b.scene.points[0].motion->ramp = 2.0;
  b.scene.points[0].motion->harmonics = {Harmonic{Vec3(0.2, 0.5, 1.0), 1.5, 6.0, 0.0}};
  if (two) {
    b.free("knot", {50, 5, -100}, body);
    b.line("top", "knot").section("U40", 120.0, 12).line("knot", "bottom").section("U40", 80.0, 8);
  } else {
    b.line("top", "bottom").section("U40", 200.0, 20).load(120.0, body);
  }
  return b.scene;
}

std::vector<Sample> motion(const Model& model, State state, double duration, double step, SimulateReport& report,
                           LinearSolverKind kind = LinearSolverKind::automatic) {
  const Assembler assembler(model, threads());
  SimulateOptions options;
  options.duration = duration;
  options.step = step;
  options.output_interval = 0.5;
  options.tolerance = 1e-11;
  options.linear_solver = kind;
  return run_and_sample(assembler, options, state, report);
}

TEST(TwoLinesInSeries, MoveAsOneLineWithAClump) {
  const StaticSolution one(heaving(false, 150.0), StaticStart::catenary, 1e-12), two(heaving(true, 150.0), StaticStart::catenary, 1e-12);
  SimulateReport a, b;
  const auto single = motion(*one.model, one.state, 8.0, 0.02, a), joined = motion(*two.model, two.state, 8.0, 0.02, b);
  ASSERT_TRUE(a.finished && b.finished) << b.failure.what;
  ASSERT_EQ(single.size(), joined.size());
  double moved = 0.0;
  for (std::size_t k = 0; k < single.size(); ++k) {
    // The same discrete problem: 400 steps of a Newton that stops at 1e-11 of 200 m.
    EXPECT_LT((node_position(*two.model, joined[k].state, 12) - node_position(*one.model, single[k].state, 12)).norm(), 1e-7) << single[k].t;
    const double T = observe_line(*one.model, single[k].state, 0).tension_from;
    EXPECT_NEAR(observe_line(*two.model, joined[k].state, 0).tension_from, T, 1e-6 * T);
    moved = std::max(moved, (node_position(*one.model, single[k].state, 12) - node_position(*one.model, one.state, 12)).norm());
  }
  EXPECT_GT(moved, 0.3);
}

TEST(Network, KeepsTheEndsOfItsLinesTogetherToTheBit) {
  const StaticSolution two(heaving(true, 0.0));
  SimulateReport report;
  for (const LinearSolverKind kind : {LinearSolverKind::chain, LinearSolverKind::umfpack}) {
    for (const Sample& sample : motion(*two.model, two.state, 3.0, 0.05, report, kind)) {
      EXPECT_EQ(node_position(*two.model, sample.state, 12, 0), node_position(*two.model, sample.state, 0, 1));
      EXPECT_EQ(node_velocity(*two.model, sample.state, 12, 0), node_velocity(*two.model, sample.state, 0, 1));
    }
    EXPECT_TRUE(report.finished) << report.failure.what;
  }
}

TEST(Network, InEquilibriumStaysAtRest) {
  for (const ModelChoice choice : {ModelChoice::cable, ModelChoice::beam}) {
    const StaticSolution s(small_network(4, choice), StaticStart::catenary, 1e-12);
    SimulateReport report;
    for (const Sample& sample : motion(*s.model, s.state, 5.0, 0.05, report))
      for (std::size_t i = 0; i < s.model->dofs; ++i) ASSERT_NEAR(sample.state.q[i], s.state.q[i], 1e-6) << sample.t;
    EXPECT_TRUE(report.finished) << report.failure.what;
  }
}

TEST(FreeNetwork, KeepsItsMomentumAndWithOrderTwoItsEnergyAndAngularMomentum) {
  LineType type = line_type("rope", 4.0e6, 0.0);
  BodySpec knot;
  knot.mass = 40.0;
  SceneBuilder b;
  b.dry().type(type).free("knot", {0, 0, 0}, knot);
  b.scene.environment.gravity = 0.0;
  const std::vector<Vec3> ends{{30, 0, 0}, {-15, 25.98076211353316, 0}, {-15, -25.98076211353316, 0}};
  for (std::size_t i = 0; i < 3; ++i) b.free("end" + std::to_string(i), ends[i]).line("knot", "end" + std::to_string(i)).section("rope", 30.0, 12);
  const Model model = build_model(b.scene);
  State start = straight_rest_state(model);
  const Vec3 spin(0.1, 0.2, 1.0), drift(3.0, -2.0, 1.0);
  for (int line = 0; line < 3; ++line)
    for (int i = 0; i <= 12; ++i) {
      const std::size_t d = model.dof(line, i);
      Eigen::Map<Vec3> v(&start.v[d]), turn(&start.v[d + 3]);
      v = drift + spin.cross(Eigen::Map<const Vec3>(&start.q[d]));
      turn = spin.cross(Eigen::Map<const Vec3>(&start.q[d + 3]));
    }
  const auto drifts = [&](double step) {
    const Assembler assembler(model);
    SimulateOptions options;
    options.duration = 1.0;
    options.step = step;
    options.spectral_radius = 1.0;
    options.tolerance = 1e-11;
    SimulateReport report;
    State state = start;
    const auto samples = run_and_sample(assembler, options, state, report);
    EXPECT_TRUE(report.finished) << report.failure.what;
    const Energies first = observe_energies(model, samples.front().state), last = observe_energies(model, samples.back().state);
    return std::array{(last.momentum - first.momentum).norm(), std::abs(last.total() - first.total()),
                      (last.angular_momentum - first.angular_momentum).norm()};
  };
  const auto coarse = drifts(0.004), fine = drifts(0.002);
  const Energies energies = observe_energies(model, start);
  // Newton's equations conserve it identically: what is left is where Newton stops, 1e-11 of the forces in 500 steps of 0.002 s, and rounding.
  EXPECT_LT(fine[0], 1e-9 * energies.momentum.norm());
  EXPECT_LT(fine[1], 0.5 * coarse[1] + 1e-9 * energies.kinetic);
  EXPECT_LT(fine[2], 0.5 * coarse[2] + 1e-9 * energies.angular_momentum.norm());
  EXPECT_LT(fine[1], 1e-3 * energies.kinetic);
}

}  // namespace
}  // namespace hawser::test
