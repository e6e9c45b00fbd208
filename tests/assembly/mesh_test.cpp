#include "assembly/mesh.hpp"

#include <gtest/gtest.h>

#include "tests/support/scene_samples.hpp"

namespace hawser {
namespace {

LineMesh mesh_of(const Scene& scene) { return mesh_line(scene.lines[0], scene.line_types); }

TEST(Mesh, LoadsAndSectionChangesGetNodes) {
  const LineMesh mesh = mesh_of(test::loaded_line(20, 10.0, 10.0));
  for (double s : {25.0, 60.0, 80.0}) EXPECT_NEAR(mesh.s[nearest_node(mesh.s, s)], s, 1.0e-12);
  EXPECT_EQ(mesh.s.size(), 21u);
  EXPECT_EQ(mesh.s.back(), 105.0);
}

TEST(Mesh, ALoadOnANodeOfTheEvenMeshKeepsIt) {
  Scene scene = test::loaded_line(20, 0.0, 0.0);
  scene.lines[0].loads.clear();
  const LineMesh plain = mesh_of(scene);
  LoadSpec load;
  load.at = plain.s[5];
  load.body.mass = 1.0;
  scene.lines[0].loads = {load};
  EXPECT_EQ(mesh_of(scene).s, plain.s);
}

TEST(Mesh, SlopeJumpsFreelyWithoutBendingAndScaledWithBendingOnBothSides) {
  const auto kinds = [](double left, double right) {
    std::vector<Jump> out;
    for (const MeshJoint& j : mesh_of(test::loaded_line(20, left, right)).joints) out.push_back(j.jump);
    return out;
  };
  EXPECT_EQ(kinds(0.0, 0.0), (std::vector<Jump>{Jump::free, Jump::free, Jump::free}));
  EXPECT_EQ(kinds(5.0, 9.0), (std::vector<Jump>{Jump::scaled, Jump::scaled, Jump::scaled}));
  EXPECT_EQ(kinds(5.0, 0.0), (std::vector<Jump>{Jump::scaled, Jump::free, Jump::free}));
}

TEST(Mesh, SectionsOfTheSameStiffnessShareTheSlope) {
  Scene scene = test::loaded_line(20, 5.0, 5.0);
  scene.line_types[1].EA = scene.line_types[0].EA;
  scene.lines[0].loads.clear();
  EXPECT_TRUE(mesh_of(scene).joints.empty());
}

TEST(Mesh, AMomentAloneLeavesTheTensionContinuous) {
  Scene scene = test::loaded_line(20, 5.0, 5.0);
  scene.line_types[1].EA = scene.line_types[0].EA;
  LoadSpec moment;
  moment.at = 30.0;
  moment.moment.constant = {0.0, 1.0, 0.0};
  scene.lines[0].loads = {moment};
  EXPECT_TRUE(mesh_of(scene).joints.empty());
}

TEST(Mesh, SpreadLoadIsSharedByLength) {
  const std::vector<double> nodes{0.0, 1.0, 3.0, 6.0};
  const auto parts = spread_over(nodes, 0.5, 4.5);
  ASSERT_EQ(parts.size(), 3u);
  EXPECT_DOUBLE_EQ(parts[0].share + parts[1].share + parts[2].share, 1.0);
  EXPECT_DOUBLE_EQ(parts[0].xi0, 0.5);
  EXPECT_DOUBLE_EQ(parts[2].xi1, 0.5);
  EXPECT_DOUBLE_EQ(parts[1].share, 0.5);
}

TEST(Mesh, CoarsenedHalvesTheElements) {
  const Scene scene = test::loaded_line(20, 0.0, 0.0);
  EXPECT_EQ(coarsened(scene).lines[0].sections[0].elements, 6);
}

}  // namespace
}  // namespace hawser
