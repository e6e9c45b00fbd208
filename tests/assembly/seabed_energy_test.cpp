// The energy of the bed: against closed forms, and as the potential of the force.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "assembly/observables.hpp"
#include "assembly/seabed.hpp"
#include "tests/support/scene_builder.hpp"

namespace hawser {
namespace {

using test::SceneBuilder;

struct Bed {
  const char* name;
  ModelChoice model;
  double smoothing;
  Vec3 plane;  // z = plane.x x + plane.y y + plane.z
};

/// A line of four elements of 4 m along x.
Model line_over(const Bed& bed) {
  SceneBuilder builder;
  builder.dry().type(test::line_type("t", 1.0e5, 12.0, bed.model == ModelChoice::beam ? 20.0 : 0.0));
  builder.fixed("a", {0, 0, 0}).fixed("b", {16, 0, 0}).line("a", "b", bed.model).section("t", 16.0, 4);
  SeabedSpec& spec = builder.scene.environment.seabed;
  spec.stiffness = 2.0e3;
  spec.smoothing = bed.smoothing;
  builder.scene.environment.depth = -bed.plane.z();
  const auto height = [&](double x, double y) { return bed.plane.x() * x + bed.plane.y() * y + bed.plane.z(); };
  if (!bed.plane.head<2>().isZero(0.0))
    spec.bathymetry = BathymetryGrid{{0.0, 10.0}, {-5.0, 5.0}, {height(0, -5), height(10, -5), height(0, 5), height(10, 5)}};
  return build_model(builder.scene);
}

class SeabedEnergy : public ::testing::TestWithParam<Bed> {};

TEST_P(SeabedEnergy, IsThePotentialOfTheForce) {
  const Model model = line_over(GetParam());
  State state = model.make_state();
  std::mt19937 random(5);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  const Vec3 plane = GetParam().plane;
  std::vector<double> direction(model.unknowns);
  for (double& d : direction) d = u(random);
  for (int i = 0; i <= 4; ++i) {
    const std::size_t d = model.dof(0, i);
    const double x = 4.0 * i, above = i % 2 == 0 ? 0.05 : -0.1;  // through the bed and its toe, up and down
    Eigen::Map<Vec3>(&state.q[d]) = Vec3(x, 0.0, plane.x() * x + plane.z() + above) + 0.02 * Vec3(u(random), u(random), u(random));
    if (model.chain(0).block == 6) Eigen::Map<Vec3>(&state.q[d + 3]) = Vec3(1.0, 0.0, plane.x()) + 0.01 * Vec3(u(random), u(random), u(random));
  }
  std::vector<double> force(model.unknowns, 0.0);
  add_seabed(model, state, force);
  double slope = 0.0;
  for (std::size_t i = 0; i < force.size(); ++i) slope += force[i] * direction[i];
  const auto energy = [&](double step) {
    State moved = state;
    for (std::size_t i = 0; i < moved.q.size(); ++i) moved.q[i] += step * direction[i];
    return observe_energies(model, moved).bed;
  };
  EXPECT_GT(energy(0.0), 1.0);
  const double h = 1e-5;
  // Central differences err by h^2 U'''/6 = 1e-10 * 2000/(6 * 0.02) * 16 m, and by 1e-16/h of the energy of a few joules.
  EXPECT_NEAR((energy(h) - energy(-h)) / (2.0 * h), slope, 1e-5 + 1e-9 * std::abs(slope));
}

INSTANTIATE_TEST_SUITE_P(Beds, SeabedEnergy,
                         ::testing::Values(Bed{"LevelBar", ModelChoice::bar, 0.0, {0, 0, -10}},
                                           Bed{"LevelCable", ModelChoice::cable, 0.0, {0, 0, -10}},
                                           Bed{"ToeBar", ModelChoice::bar, 0.02, {0, 0, -10}}, Bed{"ToeBeam", ModelChoice::beam, 0.02, {0, 0, -10}},
                                           Bed{"SlopeCable", ModelChoice::cable, 0.0, {0.3, -0.1, -10}},
                                           Bed{"SlopeWithToe", ModelChoice::beam, 0.02, {-0.2, 0.4, -10}}),
                         [](const auto& test) { return test.param.name; });

TEST(SeabedEnergy, OfALineThatLiesOnALevelBedIsThatOfASpringUnderItsWeight) {
  const Model model = line_over({"", ModelChoice::cable, 0.0, {0, 0, -10}});
  State state = model.make_state();
  const double w = 12.0, k = 2.0e3;
  for (int i = 0; i <= 4; ++i) {
    Eigen::Map<Vec3>(&state.q[model.dof(0, i)]) = Vec3(4.0 * i, 0.0, -10.0 - w / k);
    Eigen::Map<Vec3>(&state.q[model.dof(0, i) + 3]) = Vec3::UnitX();
  }
  EXPECT_NEAR(observe_seabed(model, state, 0).force, w * 16.0, 1e-10 * w * 16.0);  // it rests: k times a difference of heights of 10 m
  EXPECT_NEAR(observe_energies(model, state).bed, w * w / (2.0 * k) * 16.0, 1e-10 * w * w / (2.0 * k) * 16.0);
}

TEST(ContactEnergy, GrowsByThePressureAcrossTheToe) {
  const SeabedLaw law{3.0e3, 0.04, 0.0, 0.0, 0.0, 1e-4};
  EXPECT_EQ(contact_energy(law, -1.0), 0.0);
  EXPECT_NEAR(contact_energy(law, 0.04), 3.0e3 * 0.04 * 0.04 / 6.0, 1e-12);
  for (const double g : {0.01, 0.039, 0.04, 0.041, 0.3}) {
    const double h = 1e-6;
    EXPECT_NEAR((contact_energy(law, g + h) - contact_energy(law, g - h)) / (2.0 * h), contact_pressure(law, g), 1e-5) << g;
  }
}

}  // namespace
}  // namespace hawser
