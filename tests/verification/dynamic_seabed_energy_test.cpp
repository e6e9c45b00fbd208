// What a line that falls on the bed keeps: its energy, as long as the bed neither damps nor rubs.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/dynamic_scenes.hpp"
#include "tests/support/scene_builder.hpp"

namespace hawser::test {
namespace {

struct Fall {
  double drift = 0.0, on_bed = 0.0, moving = 0.0;  // J: of the total; most in the bed; most kinetic
};

/// A line of 10 m, stretched level 0.1 m above a bed with a toe of 2 cm, sags onto it and rebounds.
Fall fall_on_the_bed(double step) {
  SceneBuilder b;
  b.dry().type(line_type("line", 1.0e5, 25.0)).fixed("a", {0, 0, -9.9}).fixed("b", {10.02, 0, -9.9}).line("a", "b").section("line", 10.0, 16);
  b.scene.environment.depth = 10.0;
  b.scene.environment.seabed.stiffness = 2.0e4;
  b.scene.environment.seabed.smoothing = 0.02;
  const Model model = build_model(b.scene);
  const State state = static_start(model, StaticStart::straight);
  const auto samples = undamped_motion(model, state, 0.6, 0.01, step);
  const double start = observe_energies(model, samples.front().state).total();
  Fall fall;
  for (const Sample& sample : samples) {
    const Energies now = observe_energies(model, sample.state);
    fall.drift = std::max(fall.drift, std::abs(now.total() - start));
    fall.on_bed = std::max(fall.on_bed, now.bed);
    fall.moving = std::max(fall.moving, now.kinetic);
  }
  return fall;
}

TEST(FallOnTheBed, KeepsItsEnergyToTheOrderOfTheStep) {
  const Fall coarse = fall_on_the_bed(0.0005), fine = fall_on_the_bed(0.00025);
  EXPECT_GT(fine.on_bed, 0.3 * fine.moving);  // the bed takes it up and gives it back
  EXPECT_LT(fine.drift, 1e-2 * fine.moving);
  EXPECT_NEAR(std::log2(coarse.drift / fine.drift), 2.0, 0.4) << coarse.drift << ' ' << fine.drift << ' ' << fine.on_bed << ' ' << fine.moving;
}

}  // namespace
}  // namespace hawser::test
