#include "solver/simulate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/dynamic_scenes.hpp"
#include "tests/support/scene_builder.hpp"
#include "tests/support/scene_samples.hpp"

namespace hawser::test {
namespace {

constexpr double gravity = 9.80665;

/// The umbilical under a heaving ship of data/scenes/umbilical-heave.toml, in steps of choice.
Scene umbilical(int elements) {
  BodySpec clump;
  clump.mass = 2000.0;
  clump.wet_weight = 15000.0;
  SceneBuilder builder;
  builder.current(0.0, Vec3(0.5, 0.0, 0.0)).type(u40()).fixed("top", Vec3::Zero()).free("clump", Vec3(0.0, 0.0, -4000.0), clump);
  builder.line("top", "clump").section("U40", 4000.0, elements);
  MotionSpec heave;
  heave.ramp = 10.0;
  heave.harmonics = {Harmonic{Vec3::UnitZ(), 2.5, 10.0, 0.0}};
  builder.scene.points.front().motion = heave;
  return builder.scene;
}

State equilibrium(const Assembler& assembler) {
  State state;
  const StaticReport report = solve_static(assembler, {}, state);
  EXPECT_TRUE(report.converged) << report.failure.what;
  return state;
}

SimulateOptions times(double duration, double step, double interval) {
  SimulateOptions options;
  options.duration = duration;
  options.step = step;
  options.output_interval = interval;
  return options;
}

/// S3b on a mesh that takes no time.
struct SmallSwing {
  Model model = build_model(swinging_bob(8));
  Assembler assembler{model};
  State state = hanging_state(model, 250.0 * gravity, 2.5 * gravity, 4.0e6);
};

TEST(Simulate, OutputsFallOnMultiplesOfTheIntervalAndOnTheEnd) {
  SmallSwing swing;
  SimulateReport report;
  const auto samples = run_and_sample(swing.assembler, times(0.95, 0.04, 0.1), swing.state, report);
  EXPECT_TRUE(report.finished);
  EXPECT_EQ(report.reached, 0.95);
  ASSERT_EQ(samples.size(), 11U);
  for (int k = 0; k < 10; ++k) {
    EXPECT_EQ(samples[k].t, k * 0.1);
  }
  EXPECT_EQ(samples.back().t, 0.95);
  // 0.1 s takes three equal steps of at most 0.04 s; the last 0.05 s takes two.
  EXPECT_EQ(report.counters.steps, 9 * 3 + 2);
  EXPECT_NEAR(report.counters.smallest_step, 0.025, 1e-15);  // 0.95 - 0.9 is rounded
}

TEST(Simulate, IntervalThatDividesTheDurationGivesNoExtraOutput) {
  SmallSwing swing;
  SimulateReport report;
  const auto samples = run_and_sample(swing.assembler, times(0.3, 0.1, 0.1), swing.state, report);  // 3 * 0.1 > 0.3 in double
  ASSERT_EQ(samples.size(), 4U);
  EXPECT_EQ(samples.back().t, 0.3);
  EXPECT_EQ(report.counters.steps, 3);
}

TEST(Simulate, IntervalBelowTheStepShortensTheStep) {
  SmallSwing swing;
  SimulateReport report;
  run_and_sample(swing.assembler, times(0.1, 0.05, 0.01), swing.state, report);
  EXPECT_EQ(report.counters.steps, 10);
}

TEST(Simulate, LocalErrorFallsWithTheCubeOfTheStep) {
  double error[2];
  for (int k = 0; k < 2; ++k) {
    SmallSwing swing;
    SimulateReport report;
    run_and_sample(swing.assembler, times(3.0, 0.01 / (1 << k), 0.1), swing.state, report);
    error[k] = report.counters.largest_local_error;
  }
  // h^2 times the change of acceleration in h; the axial waves of the start are below 1 % of it.
  EXPECT_NEAR(std::log2(error[0] / error[1]), 3.0, 0.2) << error[0] << ' ' << error[1];
}

TEST(Simulate, ObserverSeesConsistentAccelerationsAtTheStart) {
  const Model model = build_model(falling_line(16));
  const Assembler assembler(model);
  State state = straight_rest_state(model);
  SimulateReport report;
  const auto samples = run_and_sample(assembler, times(0.01, 0.01, 0.01), state, report);
  EXPECT_EQ(samples.front().t, 0.0);
  // The free end of the horizontal line starts in free fall.
  EXPECT_NEAR(samples.front().state.a[model.dof(0, 16) + 2], -gravity, 1e-3 * gravity);
  std::vector<double> r(model.unknowns);
  assembler.residual(samples.front().state, r);
  assembler.project(r);
  // Nodal loads of 150 N, solved to rounding.
  for (const double x : r) {
    EXPECT_NEAR(x, 0.0, 1e-10);
  }
}

TEST(Simulate, ObserverCanInterrupt) {
  SmallSwing swing;
  int calls = 0;
  const Observer observe = [&](const State&, const SimulateCounters&) { return ++calls < 4; };
  const SimulateReport report = simulate(swing.assembler, times(1.0, 0.05, 0.1), swing.state, observe);
  EXPECT_TRUE(report.interrupted);
  EXPECT_FALSE(report.finished);
  EXPECT_EQ(calls, 4);
  EXPECT_EQ(report.reached, 3 * 0.1);
}

TEST(Simulate, EquilibriumStaysAtRest) {
  const Model model = build_model(loaded_line(40, 100.0, 0.0));
  const Assembler assembler(model);
  State state = equilibrium(assembler);
  const State start = state;
  const SimulateReport report = simulate(assembler, times(5.0, 0.05, 5.0), state, [](const State&, const SimulateCounters&) { return true; });
  ASSERT_TRUE(report.finished) << report.failure.what;
  // The static residual is 1e-8 of some kN or less, on nodes of 10 kg, until drag stops it: micrometres.
  for (int i = 0; i < model.lines.front().nodes; ++i) {
    EXPECT_LT((node_position(model, state, i) - node_position(model, start, i)).norm(), 1e-5);
  }
}

TEST(Simulate, SameBitsForAnyNumberOfThreads) {
  const Model model = build_model(umbilical(serial_below + 300));
  std::vector<State> ends;
  for (const int threads : {1, 2, 3}) {
    const Assembler assembler(model, threads);
    State state = equilibrium(assembler);
    SimulateReport report;
    ends.push_back(run_and_sample(assembler, times(0.5, 0.05, 0.25), state, report).back().state);
    ASSERT_TRUE(report.finished);
  }
  for (const State& end : ends) {
    EXPECT_EQ(end.q, ends.front().q);
    EXPECT_EQ(end.v, ends.front().v);
    EXPECT_EQ(end.a, ends.front().a);
  }
}

/// Columns: top tension, clump tension, clump x, clump z.
using History = std::vector<std::array<double, 4>>;

History umbilical_history(const Assembler& assembler, LinearSolverKind kind) {
  SimulateOptions options = times(20.0, 0.05, 0.1);
  options.tolerance = 1e-11;
  options.linear_solver = kind;
  State state = equilibrium(assembler);
  const Model& model = assembler.model();
  History history;
  const SimulateReport report = simulate(assembler, options, state, [&](const State& s, const SimulateCounters&) {
    const LineResult line = observe_line(model, s, 0);
    const Vec3 clump = node_position(model, s, model.lines.front().nodes - 1);
    history.push_back({line.tension_from, line.tension_to, clump.x(), clump.z()});
    return true;
  });
  EXPECT_TRUE(report.finished) << report.failure.what;
  EXPECT_EQ(report.counters.modified_newton, kind == LinearSolverKind::cholmod);
  return history;
}

TEST(Simulate, EveryLinearSolverGivesTheSameHistories) {
  const Model model = build_model(umbilical(200));
  const Assembler assembler(model);
  const History reference = umbilical_history(assembler, LinearSolverKind::chain);
  for (const LinearSolverKind kind : all_linear_solvers()) {
    const History history = umbilical_history(assembler, kind);
    ASSERT_EQ(history.size(), reference.size());
    for (int column = 0; column < 4; ++column) {
      double largest = 0.0, difference = 0.0;
      for (std::size_t k = 0; k < history.size(); ++k) {
        largest = std::max(largest, std::abs(reference[k][column]));
        difference = std::max(difference, std::abs(history[k][column] - reference[k][column]));
      }
      EXPECT_LT(difference, 1e-8 * largest) << name_of(kind) << ", column " << column;
    }
  }
}

/// Theory 6.2: 300 m of tether with a clump of 500 kg; the top heaves 4 m in 5 s, so the tether goes slack in every cycle.
Scene snapping_tether(int elements, double EI) {
  LineType type = u40();
  type.diameter = 0.03;
  type.mass = 1.5;
  type.EI = EI;
  BodySpec clump;
  clump.mass = 500.0;
  clump.wet_weight = 500.0 * gravity;
  clump.drag_area = 1.0;
  SceneBuilder builder;
  builder.current(0.0, Vec3(0.0, 0.3, 0.0)).type(type).fixed("top", Vec3::Zero()).free("clump", Vec3(0.0, 0.0, -300.0), clump);
  builder.line("top", "clump").section("U40", 300.0, elements);
  MotionSpec heave;
  heave.harmonics = {Harmonic{Vec3::UnitZ(), 4.0, 5.0, 0.0}};
  builder.scene.points.front().motion = heave;
  return builder.scene;
}

class SnapTest : public testing::TestWithParam<std::pair<double, double>> {};

TEST_P(SnapTest, RunsThroughByHalvingSteps) {
  const auto [EI, spectral_radius] = GetParam();
  const Model model = build_model(snapping_tether(100, EI));
  const Assembler assembler(model);
  State state = equilibrium(assembler);
  SimulateOptions options = times(10.0, 0.05, 0.1);
  options.spectral_radius = spectral_radius;
  double largest = 0.0, least = 1.0e9;
  const SimulateReport report = simulate(assembler, options, state, [&](const State& s, const SimulateCounters&) {
    const LineResult line = observe_line(model, s, 0);
    largest = std::max(largest, line.tension_max);
    least = std::min(least, line.least_strain_tension);
    return true;
  });
  EXPECT_TRUE(report.finished) << report.failure.what << " at s = " << report.failure.s;
  EXPECT_LE(report.counters.largest_residual, 1e-5);
  // It does go slack and does snap; the theory's runs have peaks of 62 to 78 kN after the first jerk.
  EXPECT_LT(least, 0.0);
  EXPECT_GT(largest, 3.0e4);
  EXPECT_LT(largest, 2.0e5);
  EXPECT_GT(report.counters.rejected_steps, 0);
  EXPECT_LT(report.counters.smallest_step, 0.05);
}

INSTANTIATE_TEST_SUITE_P(Stiffness, SnapTest, testing::Values(std::pair(1.0, 0.6), std::pair(1.0, 0.3), std::pair(0.0, 0.6), std::pair(200.0, 0.6)));

TEST(Simulate, StopsWithPlaceCauseAndRemedyWhereHalvingsRunOut) {
  const Model model = build_model(snapping_tether(100, 1.0));
  const Assembler assembler(model);
  State state = equilibrium(assembler);
  SimulateOptions options = times(10.0, 0.5, 0.5);
  options.max_halvings = 0;
  double last = -1.0;
  const SimulateReport report = simulate(assembler, options, state, [&](const State& s, const SimulateCounters&) {
    last = s.t;
    return true;
  });
  EXPECT_FALSE(report.finished);
  EXPECT_FALSE(report.interrupted);
  EXPECT_EQ(report.reached, last);
  EXPECT_EQ(state.t, last);
  EXPECT_EQ(report.failure.line, "line");
  EXPECT_GE(report.failure.s, 0.0);
  EXPECT_LE(report.failure.s, 300.0);
  EXPECT_FALSE(report.failure.what.empty());
  EXPECT_FALSE(report.failure.cause.empty());
  EXPECT_FALSE(report.failure.remedy.empty());
}

TEST(StraightRestState, LiesUnstrainedFromTheHeldEnd) {
  SceneBuilder builder;
  builder.dry().type(u40()).free("from", Vec3(0.0, 0.0, -50.0)).fixed("to", Vec3(30.0, 0.0, -10.0));
  builder.line("from", "to").section("U40", 100.0, 10);
  const Model model = build_model(builder.scene);
  const State state = straight_rest_state(model);
  const Vec3 direction(0.6, 0.0, 0.8);
  for (int i = 0; i <= 10; ++i) {
    const Vec3 expected = Vec3(30.0, 0.0, -10.0) - (100.0 - 10.0 * i) * direction;
    EXPECT_LT((node_position(model, state, i) - expected).norm(), 1e-13 * 100.0);
    EXPECT_LT((Eigen::Map<const Vec3>(&state.q[model.dof(0, i) + 3]) - direction).norm(), 1e-15);
    EXPECT_EQ(node_velocity(model, state, i), Vec3::Zero());
  }
}

/// Rows of a circle of radius 60 m that spins about the vertical.
StartTable arc_table(const std::vector<double>& s) {
  StartTable table;
  for (const double x : s) {
    const double angle = x / 60.0;
    const Vec3 position(60.0 * std::sin(angle), 60.0 * (1.0 - std::cos(angle)), 0.0);
    table.rows.push_back({"line", x, position, Vec3(-0.5 * position.y(), 0.5 * position.x(), 0.0)});
  }
  return table;
}

TEST(StateFromTable, InterpolatesPositionsSlopesAndVelocitiesWithOrderFour) {
  const Model model = build_model(one_line(s3_type(), 100.0, 16, free_point(Vec3::Zero())));
  double error[2];
  for (int k = 0; k < 2; ++k) {
    std::vector<double> s;
    for (int i = 0; i <= 15 << k; ++i) {
      s.push_back(100.0 * i / (15 << k));
    }
    const State state = state_from_table(model, arc_table(s));
    error[k] = 0.0;
    for (int i = 0; i <= 16; ++i) {
      const double angle = model.lines.front().s[i] / 60.0;
      const Vec3 r(60.0 * std::sin(angle), 60.0 * (1.0 - std::cos(angle)), 0.0), slope(std::cos(angle), std::sin(angle), 0.0);
      const std::size_t d = model.dof(0, i);
      error[k] = std::max(error[k], (node_position(model, state, i) - r).norm());
      error[k] = std::max(error[k], (node_velocity(model, state, i) - Vec3(-0.5 * r.y(), 0.5 * r.x(), 0.0)).norm());
      EXPECT_LT((Eigen::Map<const Vec3>(&state.q[d + 3]) - slope).norm(), 1e-4);
      EXPECT_LT((Eigen::Map<const Vec3>(&state.v[d + 3]) - Vec3(-0.5 * slope.y(), 0.5 * slope.x(), 0.0)).norm(), 1e-4);
    }
  }
  EXPECT_GT(std::log2(error[0] / error[1]), 3.5) << error[0] << ' ' << error[1];
}

TEST(StateFromTable, TwoRowsGiveAStraightLine) {
  const Model model = build_model(one_line(s3_type(), 100.0, 4, free_point(Vec3::Zero())));
  StartTable table;
  table.rows = {{"line", 0.0, Vec3::Zero(), Vec3::Zero()}, {"line", 100.0, Vec3(0.0, 99.0, 0.0), Vec3(0.0, 0.0, 2.0)}};
  const State state = state_from_table(model, table);
  for (int i = 0; i <= 4; ++i) {
    const std::size_t d = model.dof(0, i);
    EXPECT_NEAR(state.q[d + 1], 99.0 * i / 4.0, 1e-13 * 99.0);
    EXPECT_NEAR(state.q[d + 4], 0.99, 1e-15);
    EXPECT_NEAR(state.v[d + 2], 2.0 * i / 4.0, 1e-15 * 2.0);
  }
}

}  // namespace
}  // namespace hawser::test
