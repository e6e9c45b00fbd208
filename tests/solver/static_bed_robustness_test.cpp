// Static solves on beds with slopes, ridges and friction that were refused once, each for a reason of its own.
#include <gtest/gtest.h>

#include "assembly/seabed.hpp"
#include "tests/support/scene_builder.hpp"
#include "tests/support/static_solution.hpp"

namespace hawser::test {
namespace {

// A buoyant middle stands up from the bed in an arch. While the bending stiffness of the continuation falls the arch turns over; no equilibrium of
// the next model is near that of the last one then.
TEST(StaticBedRobustness, ALazyWaveThatJumpsWhileItsBendingStiffnessFallsIsFollowedInMotion) {
  SceneBuilder builder;
  builder.dry().type(line_type("heavy", 1.12e9, 0.591, 4.08)).type(line_type("buoyant", 2.23e9, -0.239, 4.08));
  builder.fixed("anchor", {0, 0, -94.6}).fixed("top", {-469.2, 192.06, 0}).line("anchor", "top");
  builder.section("heavy", 343.86, 13).section("buoyant", 169.01, 6).section("heavy", 313.31, 12);
  builder.scene.environment.depth = 94.6;
  builder.scene.environment.seabed.stiffness = 107.0;
  const StaticSolution s(builder.scene);
  EXPECT_GT(s.station(343.86 + 84.5).position.z(), s.station(343.86).position.z());
  // The ends and the bed carry the weight.
  const double weight = 0.591 * (343.86 + 313.31) - 0.239 * 169.01;
  EXPECT_NEAR(observe_seabed(*s.model, s.state, 0).force - s.line.force_to.z() - s.line.force_from.z(), weight, 1e-9 * weight);
}

// The line lies in an arc on a plane bed, where friction holds it. Strains of 3e-6 would be 13 kN, of which friction holds 1.5 N/m.
TEST(StaticBedRobustness, AStiffLineLaidInAnArcOverASlopeIsNotCompressed) {
  constexpr double w = 3.68, L = 3278.0;
  SceneBuilder builder;
  builder.dry().type(line_type("cable", 4.45e9, w, 139.0)).fixed("top", {-2261.9, -332.9, 0}).fixed("anchor", {0, 0, -533.15}).line("top", "anchor");
  builder.section("cable", L, 131);
  SeabedSpec& bed = builder.scene.environment.seabed;
  bed.bathymetry = BathymetryGrid{{-3278, 3278}, {-3278, 3278}, {-798.4, -518.8, -547.5, -267.9}};
  bed.stiffness = 156.0;
  bed.friction_axial = 0.415;
  bed.friction_lateral = 0.815;
  bed.slip = 3.73e-4;
  const StaticSolution s(builder.scene);
  EXPECT_GT(s.line.least_strain_tension, -w * L / 131);  // the load on an element
}

// The force of the bed must not jump where the line crosses the lines of the grid.
TEST(StaticBedRobustness, ATautLineOverTheRidgesOfAGridIsSolvedByNewton) {
  LineType cable = line_type("cable", 1.43e8, 58.5, 1150.0);
  cable.diameter = 0.112;
  cable.drag_normal = 1.21;
  SceneBuilder builder;
  builder.type(cable).fixed("anchor", {0, 0, -343.958}).fixed("top", {-1201.81, -180.73, 0}).line("anchor", "top").section("cable", 1420.71, 96);
  builder.current(0, {-2.42, -0.44, 0}).current(-474, {-1.59, -0.29, 0}).current(-947, {-0.385, -0.07, 0}).current(-1421, {-2.23, -0.40, 0});
  SeabedSpec& bed = builder.scene.environment.seabed;
  bed.stiffness = 3470.0;
  bed.bathymetry = BathymetryGrid{{}, {}, {-166.4, -206.9, -256.8, -301.4, -355.8, -405.4, -184.0, -236.6, -289.1, -334.7, -380.3, -423.4,
                                           -210.9, -264.2, -304.5, -351.0, -411.3, -456.6, -237.6, -280.6, -340.9, -379.4, -437.0, -474.9,
                                           -264.4, -313.9, -355.3, -415.4, -462.7, -504.4, -284.5, -341.5, -382.5, -431.4, -483.2, -534.9}};
  for (int i = 0; i < 6; ++i) {
    bed.bathymetry->x.push_back(1420.71 * (0.4 * i - 1.0));
    bed.bathymetry->y.push_back(1420.71 * (0.4 * i - 1.0));
  }
  const StaticSolution s(builder.scene);
  EXPECT_LE(s.report.iterations, 30);
}

// A pipe that hangs with a loop on a bed of a grid, whose normal is not quite the gradient of its height: it comes back from wherever it is pushed,
// yet the symmetric part of its tangent has a negative pivot.
TEST(StaticBedRobustness, APipeIsNotCalledUnstableForTheSmoothedNormalOfItsBed) {
  SceneBuilder builder;
  builder.dry().type(line_type("pipe", 2.5e10, 2.9, 2.54e6)).fixed("from", {0, 0, -949.98}).fixed("to", {-1713.2, 1342.9, 0}).line("from", "to");
  builder.section("pipe", 3073.1, 117);
  SeabedSpec& bed = builder.scene.environment.seabed;
  bed.stiffness = 244.0;
  bed.bathymetry =
      BathymetryGrid{{}, {}, {-985.2, -1077, -1155, -1231, -902.8, -940, -1029, -1147, -774.3, -864.9, -966, -1026, -701.7, -760.6, -837.7, -940.6}};
  for (int i = 0; i < 4; ++i) {
    bed.bathymetry->x.push_back(3073.1 * (2.0 * i / 3 - 1.0));
    bed.bathymetry->y.push_back(3073.1 * (2.0 * i / 3 - 1.0));
  }
  const StaticSolution s(builder.scene);
  EXPECT_EQ(s.report.negative_pivots, 0);
}

}  // namespace
}  // namespace hawser::test
