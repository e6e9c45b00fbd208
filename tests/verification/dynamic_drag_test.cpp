// Rigid translations of a free line in still water, whose laws are closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/dynamic_scenes.hpp"
#include "tests/support/reference_case.hpp"
#include "tests/support/scene_builder.hpp"

namespace hawser::test {
namespace {

constexpr double length = 20.0;

/// A line with both ends free from the origin along `direction`, moving as one with `velocity`.
struct FreeLine {
  FreeLine(const LineType& type, const Vec3& direction, const Vec3& velocity, int elements = 8) {
    SceneBuilder builder;
    builder.type(type).free("from", Vec3::Zero()).free("to", length * direction).line("from", "to").section(type.name, length, elements);
    model = build_model(builder.scene);
    state = straight_rest_state(model);
    for (int i = 0; i <= elements; ++i) {
      Eigen::Map<Vec3>(&state.v[model.dof(0, i)]) = velocity;
    }
  }

  /// Runs to `duration` and returns the states at whole multiples of `interval`.
  std::vector<Sample> run(double duration, double interval, double step) {
    const Assembler assembler(model);
    SimulateOptions options;
    options.duration = duration;
    options.output_interval = interval;
    options.step = step;
    options.tolerance = 1e-11;
    SimulateReport report;
    auto samples = run_and_sample(assembler, options, state, report);
    EXPECT_TRUE(report.finished) << report.failure.what;
    return samples;
  }

  Model model;
  State state;
};

const Sample& at(const std::vector<Sample>& samples, double t) {
  for (const Sample& sample : samples) {
    if (std::abs(sample.t - t) < 1e-9) {
      return sample;
    }
  }
  throw std::runtime_error("no sample at this time");
}

struct DragErrors {
  double position, velocity;
};

DragErrors broadside_errors(double step) {
  const ReferenceCase reference("dynamic_drag_decay_translation");
  LineType type = u40();
  type.wet_weight = 0.0;
  FreeLine line(type, Vec3::UnitX(), Vec3(0.0, 2.0, 0.0));
  const auto samples = line.run(10.0, 0.1, step);
  const auto v = reference.value<std::vector<double>>("v at t=0.1,1,10"), x = reference.value<std::vector<double>>("x at t=0.1,1,10");
  DragErrors errors{};
  const double times[] = {0.1, 1.0, 10.0};
  for (int k = 0; k < 3; ++k) {
    const State& state = at(samples, times[k]).state;
    for (const int node : {0, 3, 8}) {
      errors.position = std::max(errors.position, std::abs(node_position(line.model, state, node).y() - x[k]));
      errors.velocity = std::max(errors.velocity, std::abs(node_velocity(line.model, state, node).y() - v[k]));
    }
  }
  return errors;
}

TEST(FreeLineInWater, BroadsideMotionDecaysAsTheClosedForm) {
  const DragErrors coarse = broadside_errors(0.004), fine = broadside_errors(0.002);
  // The decay time is 0.077 s; h = 0.002 s is 1/38 of it: (1/38)^2/12 of 2 m/s times a factor for the start.
  EXPECT_LT(fine.velocity, 5e-4);
  EXPECT_LT(fine.position, 1e-4);
  EXPECT_NEAR(std::log2(coarse.velocity / fine.velocity), 2.0, 0.2);
  EXPECT_NEAR(std::log2(coarse.position / fine.position), 2.0, 0.2);
}

double sinking_error(double step) {
  const ReferenceCase reference("dynamic_sinking_vertical_cable");
  FreeLine line(u40(), -Vec3::UnitZ(), Vec3::Zero());
  const auto samples = line.run(5.0, 0.1, step);
  const auto times = reference.value<std::vector<double>>("t"), v = reference.value<std::vector<double>>("v(t)");
  const auto drop = reference.value<std::vector<double>>("drop(t)");
  double error = 0.0;
  for (std::size_t k = 0; k < times.size(); ++k) {
    const State& state = at(samples, times[k]).state;
    error = std::max(error, std::abs(node_velocity(line.model, state, 4).z() + v[k]));
    error = std::max(error, std::abs(node_position(line.model, state, 0).z() + drop[k]));
  }
  return error;
}

TEST(FreeLineInWater, VerticalCableSinksAsTheClosedForm) {
  const double coarse = sinking_error(0.02), fine = sinking_error(0.01);
  // Rise time 0.64 s: (0.01/0.64)^2/12 = 2e-5 of 3 m/s, with some factor for the shape of tanh.
  EXPECT_LT(fine, 2e-4);
  EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.2);
}

TEST(FreeLineInWater, TerminalFallOfAnInclinedCableIsSteady) {
  const ReferenceCase reference("dynamic_terminal_inclined_cable");
  for (const auto& row : reference.value<Table>("table")) {
    const double angle = row[0] * M_PI / 180.0;
    const Vec3 direction(std::cos(angle), 0.0, -std::sin(angle)), velocity(row[3], 0.0, row[4]);
    FreeLine line(u40(), direction, velocity);
    const State last = line.run(2.0, 1.0, 0.05).back().state;
    for (int i = 0; i <= 8; ++i) {
      // Velocities of the table carry 14 digits and the balance of 12 N/m is rounded in some ten operations; what is left
      // may be accelerated for 2 s, and the strain of EA = 4e7 N adds the round-off of coordinates, 4e-16 of 20 m per step.
      const double s = length * i / 8.0;
      EXPECT_LT((node_position(line.model, last, i) - (s * direction + 2.0 * velocity)).norm(), 1e-11) << "inclination " << row[0];
      EXPECT_LT((node_velocity(line.model, last, i) - velocity).norm(), 1e-11) << "inclination " << row[0];
    }
  }
}

}  // namespace
}  // namespace hawser::test
