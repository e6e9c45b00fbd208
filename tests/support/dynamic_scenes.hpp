// Scenes of the dynamic reference cases, and a run of one with its samples.
#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "assembly/assembler.hpp"
#include "assembly/model.hpp"
#include "assembly/observables.hpp"
#include "assembly/scene.hpp"
#include "solver/simulate.hpp"

namespace hawser::test {

/// The line of the cases S3 and S3b: 100 m, dry.
inline LineType s3_type() {
  LineType type;
  type.name = "line";
  type.diameter = 0.04;
  type.mass = 2.5;
  type.EA = 4.0e6;
  type.EI = 120.0;
  return type;
}

/// One line from (0, 0, 0), where it is pinned, to `to`.
inline Scene one_line(const LineType& type, double length, int elements, const PointSpec& to) {
  Scene scene;
  scene.environment.water_density = 0.0;
  scene.line_types = {type};
  PointSpec from;
  from.name = "from";
  scene.points = {from, to};
  LineSpec line;
  line.name = "line";
  line.from = "from";
  line.to = to.name;
  line.sections = {SectionSpec{type.name, {}, length, elements}};
  scene.lines = {line};
  return scene;
}

inline PointSpec free_point(const Vec3& position, double mass = 0.0) {
  PointSpec point;
  point.name = "to";
  point.free = true;
  point.position = position;
  point.body.mass = mass;
  return point;
}

/// Case dynamic_S3_falling_cable.
inline Scene falling_line(int elements) { return one_line(s3_type(), 100.0, elements, free_point(Vec3(100.0, 0.0, 0.0))); }

/// Case dynamic_S3b_swinging_bob.
inline Scene swinging_bob(int elements) {
  PointSpec bob = free_point(Vec3(0.0, 0.0, -100.0), 250.0);
  bob.body.wet_weight = 250.0 * 9.80665;
  bob.body.force.pulse = TimeForce::Pulse{Vec3(4000.0, 0.0, 0.0), 4.0};
  return one_line(s3_type(), 100.0, elements, bob);
}

/// The exact static stretch of a line hanging straight down from the origin with `end_force` at its end.
inline State hanging_state(const Model& model, double end_force, double weight, double EA) {
  State state = model.make_state();
  const Line& line = model.lines.front();
  for (int i = 0; i < line.nodes; ++i) {
    const double s = line.s[i];
    const std::size_t d = model.dof(0, i);
    state.q[d + 2] = -s - ((end_force + weight * line.length) * s - 0.5 * weight * s * s) / EA;
    if (line.family != Family::bar) {
      state.q[d + 5] = -1.0 - (end_force + weight * (line.length - s)) / EA;
    }
  }
  model.reset_joints(state);
  return state;
}

struct Sample {
  double t;
  State state;
};

/// A run that keeps the states at the outputs.
inline std::vector<Sample> run_and_sample(const Assembler& assembler, const SimulateOptions& options, State& state, SimulateReport& report) {
  std::vector<Sample> samples;
  report = simulate(assembler, options, state, [&](const State& s, const SimulateCounters&) {
    samples.push_back({s.t, s});
    return true;
  });
  return samples;
}

/// The states of a motion without numerical damping, solved to 1e-11: what is lost is the scheme's error.
inline std::vector<Sample> undamped_motion(const Model& model, State state, double duration, double interval, double step) {
  SimulateOptions options;
  options.duration = duration;
  options.output_interval = interval;
  options.step = step;
  options.spectral_radius = 1.0;
  options.tolerance = 1e-11;
  SimulateReport report;
  auto samples = run_and_sample(Assembler(model), options, state, report);
  EXPECT_TRUE(report.finished) << report.failure.what;
  return samples;
}

inline Vec3 node_position(const Model& model, const State& state, int node, int line = 0) {
  return Eigen::Map<const Vec3>(&state.q[model.dof(line, node)]);
}
inline Vec3 node_velocity(const Model& model, const State& state, int node, int line = 0) {
  return Eigen::Map<const Vec3>(&state.v[model.dof(line, node)]);
}

}  // namespace hawser::test
