// Where a tangent of statics is said to be symmetric it is, entry by entry, and nothing that breaks the symmetry is overlooked.
//
// The tolerance is for rounding: an entry and its mirror image are sums of some tens of products, formed in different orders, each a few units of
// roundoff (2.2e-16) of the largest entry at most. What is meant to break the symmetry does so by many decades more.
#include "assembly/symmetry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <string>

#include "assembly/assembler.hpp"
#include "tests/support/network_scenes.hpp"
#include "tests/support/scene_samples.hpp"
#include "tests/support/shaken_chords.hpp"

namespace hawser {
namespace {

constexpr double rounding = 64 * 2.2e-16, broken = 1e-9;

/// Between the supports and shaken, at rest.
State resting_state(const Model& model) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  State state = test::shaken_chords(model, 1.0, random);
  model.reset_joints(state);
  for (std::size_t i = model.dofs; i < model.unknowns; ++i) state.q[i] += 0.05 * u(random);
  return state;
}

double asymmetry(const Model& model, const State& state, const TangentFloor& floor) {
  const Assembler assembler(model);
  Tangent tangent = assembler.make_tangent();
  std::vector<double> r(model.unknowns);
  assembler.tangent(state, TangentWeights{}, floor, r, tangent);
  return tangent.chain.asymmetry();
}

constexpr TangentFloor exact{}, floored{5.0e3, true, true};

void expect_symmetric(const Scene& scene, const std::string& what) {
  const Model model = build_model(scene);
  const State state = resting_state(model);
  EXPECT_EQ(static_symmetry(model, state), Symmetry::symmetric) << what;
  for (const TangentFloor& floor : {exact, floored}) EXPECT_LE(asymmetry(model, state, floor), rounding) << what;
}

/// Everything a line can carry but a current: clump, forces, change of section, drag and added mass that rest.
Scene still(double EI_left, double EI_right, ModelChoice family = ModelChoice::automatic) {
  Scene scene = test::loaded_line(150, EI_left, EI_right, family);
  scene.environment.current.clear();
  return scene;
}

Scene on_bed(Scene scene) {
  scene.environment.depth = 70.0;
  scene.environment.seabed.smoothing = 0.01;
  scene.environment.seabed.damping = 1.0e3;
  return scene;
}

TEST(StaticSymmetry, IsThatOfEveryFamilyInStillWater) {
  expect_symmetric(still(0.0, 0.0, ModelChoice::bar), "bar");
  expect_symmetric(still(0.0, 0.0), "cable");
  expect_symmetric(still(500.0, 900.0), "beam");
  expect_symmetric(still(500.0, 0.0), "beam and cable");
}

TEST(StaticSymmetry, StaysWithClampedEnds) {
  Scene scene = still(500.0, 900.0);
  scene.lines[0].from_end = {true, {0.4, 0.1, 1.0}};
  scene.lines[0].to_end = {true, {1.0, -0.2, 0.3}};
  expect_symmetric(scene, "clamped");
}

TEST(StaticSymmetry, IsThatOfTheChainsOfANetwork) {
  for (const ModelChoice family : {ModelChoice::cable, ModelChoice::beam}) {
    Scene scene = test::network_with_ring(8, family);
    scene.environment.current.clear();
    expect_symmetric(scene, "network");
  }
}

TEST(StaticSymmetry, StaysOnALevelBedWithoutFriction) {
  expect_symmetric(on_bed(still(0.0, 0.0, ModelChoice::bar)), "bar");
  expect_symmetric(on_bed(still(500.0, 900.0)), "beam");
}

TEST(StaticSymmetry, StaysInACurrentThatDragsNothing) {
  Scene scene = test::loaded_line(150, 500.0, 900.0);
  for (LineType& type : scene.line_types) type.drag_normal = type.drag_tangential = 0.0;
  for (LoadSpec& load : scene.lines[0].loads) load.body.drag_area = 0.0;
  expect_symmetric(scene, "no drag");
}

/// What changes a scene or a state that is symmetric.
struct Breach {
  const char* name;
  std::function<void(Scene&)> of_scene;
  std::function<void(State&)> of_state;
};

BathymetryGrid bumpy() {
  BathymetryGrid grid;
  for (int i = 0; i < 12; ++i) grid.x.push_back(-20.0 + 10.0 * i), grid.y.push_back(-40.0 + 10.0 * i);
  for (int j = 0; j < 12; ++j)
    for (int i = 0; i < 12; ++i) grid.z.push_back(-60.0 + 3.0 * std::sin(1.0 * i + 2.0 * j));
  return grid;
}

TEST(StaticSymmetry, IsNotClaimedWhereALoadHasNoEnergy) {
  const auto same = [](State&) {};
  const auto unchanged = [](Scene&) {};
  const Breach breaches[] = {
      {"current on a line",
       [](Scene& s) {
         s.environment.current = {{0.0, 0.8, 0.3}};
       },
       same},
      {"sheared current on a body",
       [](Scene& s) {
         s.environment.current = {{0.0, 0.8, 0.3}, {-90.0, 0.1, 0.0}};
         for (LineType& type : s.line_types) type.drag_normal = type.drag_tangential = 0.0;
       },
       same},
      {"moment",
       [](Scene& s) {
         s.lines[0].loads[0].moment.constant = {0.0, 300.0, 200.0};
       },
       same},
      {"friction",
       [](Scene& s) {
         s = on_bed(s);
         s.environment.seabed.friction_axial = s.environment.seabed.friction_lateral = 0.5;
       },
       same},
      {"soundings",
       [](Scene& s) {
         s = on_bed(s);
         s.environment.seabed.bathymetry = bumpy();
       },
       same},
      {"velocity", unchanged, [](State& s) { s.v[60] = 0.3; }},
      {"acceleration", unchanged, [](State& s) { s.a[61] = 1.0; }},
  };
  for (const Breach& breach : breaches) {
    Scene scene = still(500.0, 900.0);
    breach.of_scene(scene);
    const Model model = build_model(scene);
    State state = resting_state(model);
    breach.of_state(state);
    EXPECT_EQ(static_symmetry(model, state), Symmetry::unknown) << breach.name;
    EXPECT_GE(asymmetry(model, state, exact), broken) << breach.name;
  }
}

TEST(StaticSymmetry, IsSaidAnewWithEveryAssembly) {
  const Model model = build_model(still(500.0, 900.0));
  const Assembler assembler(model);
  Tangent tangent = assembler.make_tangent();
  std::vector<double> r(model.unknowns), b(model.dofs);
  const State state = resting_state(model);
  TangentPanels panels = assembler.tangent_panels(state, TangentWeights{}, exact, r, tangent, b);
  EXPECT_EQ(panels.whole().symmetry(), Symmetry::unknown);
  panels.declare(Symmetry::symmetric);
  EXPECT_EQ(panels.whole().symmetry(), Symmetry::symmetric);
  assembler.tangent(state, TangentWeights{1.0, 40.0, 1600.0}, exact, r, tangent);
  EXPECT_EQ(tangent.chain.symmetry(), Symmetry::unknown);
}

}  // namespace
}  // namespace hawser
