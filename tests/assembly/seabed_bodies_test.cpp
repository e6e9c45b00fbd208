// Bodies on the seabed: how much of it they feel, and their tangent against differences of the force.
#include "assembly/seabed_bodies.hpp"

#include <gtest/gtest.h>

#include "assembly/observables.hpp"
#include "tests/support/scene_builder.hpp"

namespace hawser::test {
namespace {

constexpr double bed_stiffness = 3.0e3, light = 10.0, heavy = 25.0;  // N/m2, N/m

/// A ring on three legs, one of them laid, and a line with a clump whose end is free.
Scene ring_and_clump(const BodySpec& ring, const BodySpec& clump, const BodySpec& end) {
  SceneBuilder b;
  b.type(line_type("light", 1.0e6, light)).type(line_type("heavy", 1.0e6, heavy));
  b.fixed("anchor", {0, 0, -100})
      .fixed("left", {60, 40, 0})
      .fixed("right", {60, -40, 0})
      .free("ring", {50, 0, -100}, ring)
      .free("end", {-50, 0, -100}, end);
  b.line("anchor", "ring").section("light", 50.0, 5);
  b.line("ring", "left").section("light", 20.0, 2).section("heavy", 100.0, 5);
  b.line("right", "ring").section("light", 100.0, 5).section("heavy", 20.0, 2);
  b.line("anchor", "end").section("heavy", 30.0, 3).section("light", 20.0, 2).load(30.0, clump);
  b.scene.environment.depth = 100.0;
  b.scene.environment.seabed.stiffness = bed_stiffness;
  return b.scene;
}

TEST(SeabedBodies, CountForAsMuchOfTheHeaviestLineAroundThemAsTheyWeigh) {
  const Model model = build_model(ring_and_clump(weight(5000.0), weight(100.0), weight(300.0)));
  ASSERT_EQ(model.bodies.size(), 3u);
  EXPECT_DOUBLE_EQ(model.bodies[0].bed_length, 5000.0 / heavy);  // ring
  EXPECT_DOUBLE_EQ(model.bodies[1].bed_length, 300.0 / 12.0);    // end: k d/10 = 12 N/m is more than the 10 N/m of its line
  EXPECT_DOUBLE_EQ(model.bodies[2].bed_length, 100.0 / heavy);   // clump
}

TEST(SeabedBodies, WhatNothingPressesDownDoesNotFeelTheBed) {
  BodySpec pressed = weight(-50.0);
  pressed.force.constant = {0, 10.0, -450.0};
  const Model model = build_model(ring_and_clump(weight(0.0), weight(-100.0), pressed));
  EXPECT_EQ(model.bodies[0].bed_length, 0.0);
  EXPECT_EQ(model.bodies[2].bed_length, 0.0);
  EXPECT_DOUBLE_EQ(model.bodies[1].bed_length, 400.0 / 12.0);
}

TEST(SeabedBodies, RubFromTheOnePlaceWhereTheirLineWasLaid) {
  Scene scene = ring_and_clump(weight(5000.0), weight(100.0), weight(300.0));
  scene.environment.seabed.friction_axial = scene.environment.seabed.friction_lateral = 0.5;
  const Model one = build_model(scene);
  for (const auto& [body, x] : {std::pair{0, 50.0}, {1, -50.0}, {2, -30.0}}) {
    ASSERT_TRUE(one.bodies[body].lay.has_value()) << body;
    EXPECT_LT((*one.bodies[body].lay - Vec3(x, 0, -100)).norm(), 1e-10) << body;
  }
  scene.points[1].position.z() = -100.0;  // now the second leg has an end on the bed too
  EXPECT_FALSE(build_model(scene).bodies[0].lay.has_value());
}

struct BedCase {
  const char* name;
  double smoothing, damping, friction;
  bool bumpy;
};

class TangentOfBodies : public ::testing::TestWithParam<BedCase> {};

TEST_P(TangentOfBodies, IsTheDerivativeOfTheirForce) {
  const BedCase& bed = GetParam();
  Scene scene = ring_and_clump(weight(5000.0), weight(100.0), weight(300.0));
  SeabedSpec& spec = scene.environment.seabed;
  spec.smoothing = bed.smoothing;
  spec.damping = bed.damping;
  spec.friction_axial = bed.friction, spec.friction_lateral = 0.8 * bed.friction;
  spec.slip = 0.05;
  if (bed.bumpy)
    spec.bathymetry = BathymetryGrid{{-60, -20, 20, 70}, {-30, 5, 30}, {-100, -99, -101, -100, -98, -100, -100, -99, -101, -100, -99, -97}};
  Model model = build_model(scene);
  State state = model.make_state();
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    Body& body = model.bodies[i];
    const std::size_t d = model.dof(body.line, body.node);
    const Vec3 place(-12.0 + 30.0 * static_cast<double>(i), 7.0, 0.0), laid = place + Vec3(0.03, -0.02, 0.0);
    Eigen::Map<Vec3> r(&state.q[d]), v(&state.v[d]);
    r = place + (model.seabed->surface.height(place.x(), place.y()) - 0.04) * Vec3::UnitZ();
    v = Vec3(0.1, -0.2, -0.3);
    if (body.lay) body.lay = laid + model.seabed->surface.height(laid.x(), laid.y()) * Vec3::UnitZ();
  }
  BlockTridiagonal matrix(model.chains);
  std::vector<double> r(model.unknowns, 0.0), ahead(r), behind(r);
  add_seabed_to_bodies(model, state, r, {2.0, 3.0, 0.0}, false, AddedBlocks(matrix));
  for (const Body& body : model.bodies) {
    const std::size_t d = model.dof(body.line, body.node);
    const Chain& chain = model.chain(body.line);
    const Eigen::Map<const Eigen::MatrixXd> K(matrix.D(chain, body.node), chain.block, chain.block);
    EXPECT_LT((Eigen::Map<const Vec3>(&r[d]) + seabed_force(model, state, body)).norm(), 1e-12);
    for (int j = 0; j < 3; ++j) {
      // Of order h^2 with third derivatives of friction of its stiffness over slip^2: (1e-5/0.05)^2 = 4e-8 of it; rounding 1e-11 of it.
      const double h = 1e-5;
      const auto moved = [&](double by, std::vector<double>& out) {
        State other = state;
        other.q[d + j] += 2.0 * by, other.v[d + j] += 3.0 * by;
        std::fill(out.begin(), out.end(), 0.0);
        add_seabed_to_bodies(model, other, out);
      };
      moved(h, ahead), moved(-h, behind);
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(K(i, j), (ahead[d + i] - behind[d + i]) / (2.0 * h), 1e-7 * K.norm()) << i << j;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Beds, TangentOfBodies,
                         ::testing::Values(BedCase{"plain", 0.0, 0.0, 0.0, false}, BedCase{"toe", 0.1, 500.0, 0.0, false},
                                           BedCase{"rough", 0.0, 0.0, 0.5, false}, BedCase{"bumps", 0.01, 500.0, 0.5, true}),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(SeabedBodies, ForceIsTheGradientOfTheirEnergyOnALevelBed) {
  Scene scene = ring_and_clump(weight(5000.0), weight(100.0), weight(300.0));
  scene.environment.seabed.smoothing = 0.03;
  const Model model = build_model(scene);
  const Body& body = model.bodies[0];
  for (const double depth : {0.01, 0.05}) {
    State state = model.make_state();
    double& z = state.q[model.dof(body.line, body.node) + 2];
    const double h = 1e-5;
    const auto energy_at = [&](double at) {
      z = at;
      return seabed_energy(model, state, body);
    };
    const double slope = (energy_at(-100.0 - depth + h) - energy_at(-100.0 - depth - h)) / (2.0 * h);
    z = -100.0 - depth;
    // Central differences of a cubic: lambda k/(6 delta) h^2 = 3.4e-4 N in the toe; rounding of z, 1e-14/1e-5, of 6e5 N.
    EXPECT_NEAR(seabed_force(model, state, body).z(), -slope, 1e-3);
  }
}

}  // namespace
}  // namespace hawser::test
