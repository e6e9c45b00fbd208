// The branch of equilibria in the slip of static friction.
#include "solver/static_slip.hpp"

#include <gtest/gtest.h>

#include "solver/static_perturbation.hpp"
#include "tests/support/scene_builder.hpp"
#include "tests/support/static_solution.hpp"

namespace hawser::test {
namespace {

/// A chain of 740 m from an anchor to a float 600 m away and 200 m above it, on a bed with friction, in a current across.
Scene mooring(double slip) {
  LineType chain = line_type("chain", 1.0e8, 800.0);
  chain.drag_normal = 1.2;
  SceneBuilder b;
  b.type(chain).current(0.0, {0.0, 0.5, 0.0}).fixed("anchor", {0, 0, -200}).fixed("float", {600, 0, 0});
  b.line("anchor", "float").section("chain", 740.0, 80);
  b.scene.environment.depth = 200.0;
  SeabedSpec& bed = b.scene.environment.seabed;
  bed.stiffness = 8.0e4;
  bed.friction_axial = bed.friction_lateral = 0.7;
  bed.slip = slip;
  return b.scene;
}

TEST(SlipBranch, LeadsToTheEquilibriumThatNewtonFindsAtOnce) {
  const StaticSolution direct(mooring(1e-3));
  const SlipBranch branch = follow_slip(*direct.model, {}, 10.0, 3000);
  ASSERT_TRUE(branch.reached) << "at a slip of " << branch.least << " m";
  EXPECT_EQ(branch.first, 7400.0);
  EXPECT_EQ(branch.folds, 0);
  EXPECT_LE(distance(*direct.model, branch.state, direct.state), 1e-6);  // points of the branch are solved to 1e-8 of the largest reaction
}

TEST(SlipBranch, DoesNotBeginOnABedThatHoldsTheLineEvenLater) {
  const Model model = build_model(mooring(10.0));
  const SlipBranch branch = follow_slip(model, {}, 1e-3, 3000);
  EXPECT_FALSE(branch.started);
  EXPECT_EQ(branch.factorizations, 0);
}

TEST(SlipBranch, KeepsToTheFactorizationsItIsGiven) {
  const Model model = build_model(mooring(1e-3));
  const SlipBranch branch = follow_slip(model, {}, 10.0, 60);
  EXPECT_FALSE(branch.reached);
  EXPECT_LE(branch.factorizations, 2 * 60);  // a step of the branch takes five of them as a rule, ten at most
}

}  // namespace
}  // namespace hawser::test
