// Statics of points and clumps that lie on the seabed, against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "assembly/observables.hpp"
#include "assembly/seabed_bodies.hpp"
#include "solver/statics.hpp"
#include "tests/support/scene_builder.hpp"

namespace hawser::test {
namespace {

constexpr double depth = 100.0, bed = 3.0e3;

SceneBuilder on_bed(double smoothing = 0.0) {
  SceneBuilder b;
  b.scene.environment.depth = depth;
  b.scene.environment.seabed.stiffness = bed;
  b.scene.environment.seabed.smoothing = smoothing;
  return b;
}

State solved(const Model& model, const StaticOptions& options = {}) {
  State state = model.make_state();
  const StaticReport report = solve_static(Assembler(model), options, state);
  EXPECT_TRUE(report.converged && report.stable) << report.failure.what;
  return state;
}

Vec3 place_of(const Model& model, const State& state, const Body& body) { return Eigen::Map<const Vec3>(&state.q[model.dof(body.line, body.node)]); }

constexpr double rope_weight = 15.0;  // N/m; more than k d/10 = 12 N/m

/// A clump of `W` where two slack lines meet; their other ends are 40 m above the bed.
Model clump_between(double W, double smoothing = 0.0) {
  SceneBuilder b = on_bed(smoothing);
  b.type(line_type("rope", 1.0e6, rope_weight)).fixed("left", {-80, 0, -60}).fixed("right", {80, 0, -60}).free("clump", {0, 0, -100}, weight(W));
  b.line("left", "clump").section("rope", 100.0, 50).line("clump", "right").section("rope", 100.0, 50);
  return build_model(b.scene);
}

TEST(StaticBodiesOnBed, AClumpBetweenSlackLinesIsCarriedWhollyAndSinksAsTheLinesDo) {
  for (const double smoothing : {0.0, 0.02}) {
    // Pressure k g, or k g^2/2 delta in a toe of width delta.
    const double g = smoothing == 0.0 ? rope_weight / bed : std::sqrt(2.0 * smoothing * rope_weight / bed);
    for (const double W : {1.0, 500.0, 50000.0}) {
      const Model model = clump_between(W, smoothing);
      const State state = solved(model);
      const Body& clump = model.bodies.front();
      // Lines that lie 40 m along exert nothing upward; what is left of their touchdown falls by more than a half from element to element.
      EXPECT_NEAR(-depth - place_of(model, state, clump).z(), g, 1e-6 * g) << W;
      EXPECT_NEAR(seabed_force(model, state, clump).z(), W, 1e-6 * (W + rope_weight)) << W;
      EXPECT_NEAR(observe_energies(model, state).bed - observe_energies(clump_between(0.0, smoothing), state).bed, seabed_energy(model, state, clump),
                  1e-9 * W);
    }
  }
}

TEST(StaticBodiesOnBed, WithoutContactOfItsOwnItsLinesWouldLetItSinkForMetres) {
  Model model = clump_between(50000.0);
  model.bodies[0].bed_length = 0.0;
  const State state = solved(model);
  EXPECT_NEAR(-depth - place_of(model, state, model.bodies[0]).z(), 4.1, 0.1);  // measured: why the contact is there
}

/// A line hangs from a point above the bed and is too short to reach it, but for the clump that stretches it. The tension at the clump
/// follows from L + (T L + w L^2/2)/EA = depth + g, lambda k g = W - T.
TEST(StaticBodiesOnBed, TheBedTakesOfAHangingClumpWhatItsLineDoesNot) {
  constexpr double L = 98.5, EA = 1.0e5, w = 10.0, W = 3000.0;
  SceneBuilder b = on_bed();
  b.type(line_type("rope", EA, w)).fixed("top", {0, 0, 0}).free("clump", {0, 0, -99}, weight(W)).line("top", "clump").section("rope", L, 20);
  const Model model = build_model(b.scene);
  const State state = solved(model);
  const double k = model.bodies[0].bed_length * bed;
  const double T = (depth + W / k - L - 0.5 * w * L * L / EA) / (L / EA + 1.0 / k), g = (W - T) / k;
  ASSERT_GT(T, 0.2 * W);
  ASSERT_LT(T, 0.8 * W);
  const PointResult clump = observe_points(model, state)[1];
  const double noise = 1e-9 * W;             // residuals end below 1e-10 of the reaction W
  const double of_line = 0.5 * bed * g * g;  // what the bed does to the last millimetres of the line
  EXPECT_EQ(clump.bed, seabed_force(model, state, model.bodies[0]));
  EXPECT_NEAR(clump.bed.z() + clump.force.z(), W, noise);
  EXPECT_NEAR(clump.force.z(), T, 2.0 * of_line);
  EXPECT_LT(of_line, 1e-5 * W);
}

/// A clump at the end of a line that slides along itself without friction, pulled by F: F = EA u/L + mu W f(u/d), f the law of friction.
TEST(StaticBodiesOnBed, FrictionHoldsAClumpWhereItsLineWasLaid) {
  constexpr double L = 50.0, EA = 1.0e6, W = 2000.0, mu = 0.5, slip = 1.0e-3, sink = rope_weight / bed;
  for (const double F : {300.0, 990.0, 1500.0}) {
    SceneBuilder b = on_bed();
    b.scene.environment.seabed.friction_lateral = mu;
    b.scene.environment.seabed.slip = slip;
    BodySpec clump = weight(W);
    clump.force.constant = {F, 0, 0};
    b.type(line_type("rope", EA, rope_weight)).fixed("anchor", {0, 0, -depth - sink}).free("clump", {L, 0, -depth}, clump);
    b.line("anchor", "clump").section("rope", L, 10);
    const Model model = build_model(b.scene);
    const State state = solved(model);
    double low = 0.0, high = F * L / EA;
    for (int i = 0; i < 100; ++i) {
      const double u = 0.5 * (low + high);
      const double x = std::min(u / slip, 1.0), f = x * (15.0 - 10.0 * x * x + 3.0 * std::pow(x, 4)) / 8.0;
      (EA * u / L + mu * W * f < F ? low : high) = u;
    }
    const Vec3 place = place_of(model, state, model.bodies[0]);
    // Of its lateral friction the line keeps the square of `upright_slope` along itself.
    const double of_line = upright_slope * upright_slope * mu * rope_weight * L;
    EXPECT_NEAR(place.x() - L, low, of_line / (EA / L)) << F;
    EXPECT_NEAR(place.z(), -depth - sink, 1e-9 * sink + 1e-13 * depth) << F;  // residuals end below 1e-10 of W
    EXPECT_NEAR(observe_line(model, state, 0).tension_to, EA * low / L, of_line) << F;
  }
}

}  // namespace
}  // namespace hawser::test
