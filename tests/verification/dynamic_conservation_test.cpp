// What a line keeps in vacuum: steady spinning, and the momenta and energy of free flight.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/dynamic_scenes.hpp"
#include "tests/support/reference_case.hpp"
#include "tests/support/scene_builder.hpp"

namespace hawser::test {
namespace {

using std::numbers::pi;

struct SpinErrors {
  double radius, tension, angle;
};

/// Case dynamic_spinning_pinned_cable for a fifth of a turn, started in the exact steady state.
SpinErrors spinning_errors(int elements, double step) {
  const ReferenceCase reference("dynamic_spinning_pinned_cable");
  const double L = 100.0, EA = 4.0e6, m = 2.5, W = 5.0, k = W * std::sqrt(m / EA);
  LineType type = s3_type();
  type.EI = 0.0;
  Scene scene = one_line(type, L, elements, free_point(Vec3(L, 0.0, 0.0)));
  scene.environment.gravity = 0.0;
  const Model model = build_model(scene);
  State state = model.make_state();
  for (int i = 0; i <= elements; ++i) {
    // EA x'' + m W^2 x = 0, x(0) = 0, x'(L) = 1.
    const double s = model.lines.front().s[i], x = std::sin(k * s) / (k * std::cos(k * L)), slope = std::cos(k * s) / std::cos(k * L);
    const std::size_t d = model.dof(0, i);
    state.q[d] = x;
    state.q[d + 3] = slope;
    state.v[d + 1] = W * x;
    state.v[d + 4] = W * slope;
  }
  const Assembler assembler(model);
  SimulateOptions options;
  options.duration = 0.4 * pi / W;
  options.output_interval = options.duration;
  options.step = step;
  options.tolerance = 1e-11;
  SimulateReport report;
  const State last = run_and_sample(assembler, options, state, report).back().state;
  EXPECT_TRUE(report.finished);
  const Vec3 tip = node_position(model, last, elements);
  const double turned = std::fmod(W * last.t, 2.0 * pi);
  const double radius = reference.value("tip radius"), tension = reference.value("hub tension");
  return {std::abs(tip.norm() - radius) / radius, std::abs(observe_line(model, last, 0).tension_from - tension) / tension,
          std::abs(std::atan2(tip.y(), tip.x()) - turned)};
}

TEST(SpinningCable, KeepsItsRadiusAndHubTension) {
  const SpinErrors coarse = spinning_errors(32, 0.004), fine = spinning_errors(32, 0.002);
  // (W h)^2/12 = 8.3e-6 of the angle turned, 1.26 rad, and less of the radius and the force, which are at rest.
  EXPECT_LT(fine.angle, 2.0 * 8.3e-6 * 1.26);
  EXPECT_LT(fine.radius, 8.3e-6);
  EXPECT_LT(fine.tension, 8.3e-6);
  EXPECT_NEAR(std::log2(coarse.angle / fine.angle), 2.0, 0.2) << coarse.angle << ' ' << fine.angle;
  EXPECT_NEAR(std::log2(coarse.radius / fine.radius), 2.0, 0.5) << coarse.radius << ' ' << fine.radius;
}

struct Flight {
  Energies start;
  double momentum, angular_momentum, energy;  // largest departures from the start
};

/// Case conservation_free_cable for half a second; the line soon buckles, for half of it starts in compression.
Flight free_flight(int elements, double step) {
  SceneBuilder builder;
  builder.dry().type(s3_type()).free("from", Vec3::Zero()).free("to", Vec3(100.0, 0.0, 0.0)).line("from", "to").section("line", 100.0, elements);
  builder.scene.environment.gravity = 0.0;
  const Model model = build_model(builder.scene);
  State state = straight_rest_state(model);
  for (int i = 0; i <= elements; ++i) {
    const double S = model.lines.front().s[i];
    const std::size_t d = model.dof(0, i);
    Eigen::Map<Vec3>(&state.v[d]) = Vec3(2 * std::sin(pi * S / 100), 10 * (S - 50) / 50 + 3 * std::sin(3 * pi * S / 100), 4 * std::cos(pi * S / 100));
    Eigen::Map<Vec3>(&state.v[d + 3]) =
        Vec3(2 * pi / 100 * std::cos(pi * S / 100), 0.2 + 9 * pi / 100 * std::cos(3 * pi * S / 100), -4 * pi / 100 * std::sin(pi * S / 100));
  }
  const auto samples = undamped_motion(model, state, 0.5, 0.02, step);
  Flight flight{observe_energies(model, samples.front().state), 0.0, 0.0, 0.0};
  for (const Sample& sample : samples) {
    const Energies now = observe_energies(model, sample.state);
    flight.momentum = std::max(flight.momentum, (now.momentum - flight.start.momentum).norm());
    flight.angular_momentum = std::max(flight.angular_momentum, (now.angular_momentum - flight.start.angular_momentum).norm());
    flight.energy = std::max(flight.energy, std::abs(now.total() - flight.start.total()));
  }
  return flight;
}

TEST(FreeFlight, StartsWithTheMomentaAndEnergyOfTheCase) {
  const ReferenceCase reference("conservation_free_cable");
  const Flight flight = free_flight(64, 0.02);
  // Hermite interpolation of sin(3 pi S/100) on elements of 1.5625 m: (k l)^4/384 = 1.2e-6 of 3 m/s at most, in the mean less.
  EXPECT_LT((flight.start.momentum - vector(reference.quantity("P")["value"])).norm(), 1e-6 * 318.0);
  EXPECT_LT((flight.start.angular_momentum - vector(reference.quantity("J about origin")["value"])).norm(), 1e-6 * 49624.0);
  EXPECT_NEAR(flight.start.kinetic, reference.value("E (kinetic only at t=0)"), 1e-6 * 5979.0);
}

TEST(FreeFlight, LinearMomentumIsExactToRounding) {
  const Flight flight = free_flight(64, 0.002);
  // Newton's equations conserve it identically; each of 250 steps rounds velocities of 10 m/s on 250 kg.
  EXPECT_LT(flight.momentum, 250 * 2.2e-16 * 250.0 * 10.0);
}

TEST(FreeFlight, EnergyAndAngularMomentumDriftWithOrderTwo) {
  const Flight coarse = free_flight(64, 0.001), fine = free_flight(64, 0.0005);
  EXPECT_LT(fine.energy, 2e-5 * fine.start.total());
  // The shortest waves of the mesh are not resolved (w h = 4 at 0.001 s) and blur the order a little.
  EXPECT_NEAR(std::log2(coarse.energy / fine.energy), 2.0, 0.2) << coarse.energy << ' ' << fine.energy;
  EXPECT_NEAR(std::log2(coarse.angular_momentum / fine.angular_momentum), 2.0, 0.2) << coarse.angular_momentum << ' ' << fine.angular_momentum;
}

}  // namespace
}  // namespace hawser::test
