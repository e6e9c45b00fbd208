// Manufactured motion of a cable with bending, drag and added mass (case mms_dynamic_cable): orders in element length and step.
#include <gtest/gtest.h>

#include <cmath>

#include "solver/time/generalized_alpha.hpp"
#include "tests/support/dynamic_scenes.hpp"
#include "tests/support/loaded_system.hpp"
#include "tests/support/mms.h"
#include "tests/support/reference_case.hpp"

namespace hawser::test {
namespace {

// The current of the case has a vertical part, which scenes have not. An observer who moves with it sees none: the whole
// line then sinks with this velocity, and nothing else changes.
const Vec3 frame(0.0, 0.0, 3.0);

struct Exact {
  Vec3 r, slope, v;
};

Exact exact(double s, double t) {
  double k[21];
  mms_kin(s, t, k);
  return {Vec3(k[0], k[1], k[2]) - frame * t, Vec3(k[3], k[4], k[5]), Vec3(k[15], k[16], k[17]) - frame};
}

/// d^2 r/ds dt by a difference of order 4; rounding and truncation both below 1e-9.
Vec3 exact_slope_velocity(double s, double t) {
  const double h = 2.0e-3;
  return (8.0 * (exact(s + h, t).v - exact(s - h, t).v) - (exact(s + 2 * h, t).v - exact(s - 2 * h, t).v)) / (12.0 * h);
}

Scene mms_scene(int elements) {
  LineType type;
  type.name = "line";
  type.diameter = 0.05;
  type.mass = 2.0;
  type.EA = 2.0e4;
  type.EI = 50.0;
  type.drag_normal = 1.2;
  type.drag_tangential = 0.05;
  type.added_mass_normal = 1.0;
  PointSpec to;
  to.name = "to";
  to.position = Vec3(10.2, 0.0, 0.0);
  Scene scene = one_line(type, 10.0, elements, to);
  for (PointSpec& point : scene.points) {
    point.motion = MotionSpec{};
    point.motion->velocity = -frame;
  }
  scene.environment.gravity = 0.0;
  scene.environment.water_density = 1000.0;
  scene.environment.current = {CurrentRow{0.0, std::hypot(3.0, 0.5), std::atan2(0.5, 3.0)}};
  scene.lines.front().from_end = {true, Vec3::UnitX()};
  scene.lines.front().to_end = {true, Vec3::UnitX()};
  return scene;
}

State exact_state(const Model& model, double t) {
  State state = model.make_state();
  state.t = t;
  for (int i = 0; i < model.lines.front().nodes; ++i) {
    const double s = model.lines.front().s[i];
    const Exact x = exact(s, t);
    const std::size_t d = model.dof(0, i);
    Eigen::Map<Vec3>(&state.q[d]) = x.r;
    Eigen::Map<Vec3>(&state.q[d + 3]) = x.slope;
    Eigen::Map<Vec3>(&state.v[d]) = x.v;
    Eigen::Map<Vec3>(&state.v[d + 3]) = exact_slope_velocity(s, t);
  }
  return state;
}

/// Root mean square of the position error over nodes and middles of elements.
double position_error(const Model& model, const State& state) {
  double sum = 0.0;
  int points = 0;
  const auto add = [&](const Vec3& r, double s) {
    sum += (r - exact(s, state.t).r).squaredNorm();
    ++points;
  };
  const Line& line = model.lines.front();
  for (int i = 0; i < line.nodes; ++i) {
    add(node_position(model, state, i), line.s[i]);
    if (i + 1 < line.nodes) {
      const double l = line.s[i + 1] - line.s[i];
      const Eigen::Map<const Eigen::Matrix<double, 3, 4>> e(&state.q[model.dof(0, i)]);
      add(0.5 * (e.col(0) + e.col(2)) + l / 8.0 * (e.col(1) - e.col(3)), line.s[i] + 0.5 * l);
    }
  }
  return std::sqrt(sum / points);
}

/// The error at t = 0.5 s.
double mms_error(int elements, int steps) {
  const Model model = build_model(mms_scene(elements));
  const Assembler assembler(model);
  LoadedSystem system(assembler);
  system.body_force = [](double s, double t) {
    double f[3];
    mms_fb_material(s, t, f);
    return Vec3(f[0], f[1], f[2]);
  };
  const auto solver = make_linear_solver(LinearSolverKind::chain);
  GeneralizedAlpha scheme(system, *solver, {.spectral_radius = 0.8, .tolerance = 1e-11});
  State state = exact_state(model, 0.0);
  EXPECT_EQ(scheme.start(state).status, StepStatus::ok);
  const double h = 0.5 / steps;
  for (int i = 1; i <= steps; ++i) {
    EXPECT_EQ(scheme.step(state, i * h, h).status, StepStatus::ok);
  }
  return position_error(model, state);
}

TEST(ManufacturedCable, BodyForceIsThatOfTheCase) {
  const ReferenceCase reference("mms_dynamic_cable");
  const std::string name = "samples [S,t,fx,fy,fz] bending energy EI/2 |r'xr''|^2/|r'|^4 (M=EI dtheta/dS)";
  for (const auto& row : reference.value<Table>(name)) {
    double f[3];
    mms_fb_material(row[0], row[1], f);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(f[c], row[2 + c], 1e-11 * 500.0);  // sums of terms of some 500 N/m with 1e-13 of rounding each
    }
  }
}

TEST(ManufacturedCable, PositionsConvergeWithOrderFourInTheElementLength) {
  const double coarse = mms_error(8, 4000), middle = mms_error(16, 4000), fine = mms_error(32, 4000);
  RecordProperty("fine_error", std::to_string(fine));
  EXPECT_GT(std::log2(coarse / middle), 3.7) << coarse << ' ' << middle;
  EXPECT_NEAR(std::log2(middle / fine), 4.0, 0.3) << middle << ' ' << fine;
}

TEST(ManufacturedCable, PositionsConvergeWithOrderTwoInTheStep) {
  // 64 elements leave 16 times less than 32 do: the error of the step dominates.
  const double coarse = mms_error(64, 25), middle = mms_error(64, 50), fine = mms_error(64, 100);
  EXPECT_NEAR(std::log2(coarse / middle), 2.0, 0.3) << coarse << ' ' << middle;
  EXPECT_NEAR(std::log2(middle / fine), 2.0, 0.15) << middle << ' ' << fine;
}

}  // namespace
}  // namespace hawser::test
