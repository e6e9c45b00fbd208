#include "solver/time/line_system.hpp"

#include <gtest/gtest.h>

#include "tests/support/dynamic_scenes.hpp"
#include "tests/support/scene_builder.hpp"

namespace hawser::test {
namespace {

/// Two nodes of 10 m, pinned at the first.
Model hanging(ModelChoice family) {
  SceneBuilder builder;
  builder.dry().type(line_type("line", 1.0e6, 20.0)).fixed("top", Vec3::Zero()).free("end", Vec3(0.0, 0.0, -20.0));
  builder.line("top", "end", family).section("line", 20.0, 2);
  return build_model(builder.scene);
}

TEST(LineSystem, PrescribesThePositionsOfItsSupports) {
  SceneBuilder builder;
  builder.dry().type(u40()).fixed("a", Vec3::Zero()).fixed("b", Vec3(90.0, 0.0, 0.0)).line("a", "b").section("U40", 100.0, 3);
  const Model model = build_model(builder.scene);
  const Assembler assembler(model);
  const LineSystem system(assembler);
  const std::vector<std::size_t> expected{0, 1, 2, 18, 19, 20};
  const auto prescribed = system.prescribed();
  EXPECT_EQ(std::vector<std::size_t>(prescribed.begin(), prescribed.end()), expected);
}

TEST(LineSystem, MeasuresResidualsWithTheElementLength) {
  const Model model = hanging(ModelChoice::cable);
  const Assembler assembler(model);
  const LineSystem system(assembler);
  std::vector<double> r(model.unknowns, 0.0);
  r[model.dof(0, 1) + 1] = 3.0;
  r[model.dof(0, 2) + 4] = -50.0;  // 50 N m over 10 m
  const ScaledResidual largest = system.scaled_residual(r);
  EXPECT_DOUBLE_EQ(largest.force, 5.0);
  EXPECT_EQ(largest.unknown, model.dof(0, 2));
}

TEST(LineSystem, ResidualThatIsNotANumberIsNeverSmall) {
  const Model model = hanging(ModelChoice::cable);
  const Assembler assembler(model);
  const LineSystem system(assembler);
  for (std::size_t i = 0; i < model.unknowns; ++i) {
    std::vector<double> r(model.unknowns, 1.0);
    r[i] = NAN;
    EXPECT_TRUE(std::isnan(system.scaled_residual(r).force)) << "unknown " << i;
  }
}

TEST(LineSystem, TurnOfABarIsThatOfItsChord) {
  const Model bar = hanging(ModelChoice::bar), cable = hanging(ModelChoice::cable);
  const Assembler bar_assembler(bar), cable_assembler(cable);
  std::vector<double> d(bar.unknowns, 0.0);
  d[bar.dof(0, 2)] = 2.0;  // the end moves 2 m beside a node that stays
  EXPECT_DOUBLE_EQ(LineSystem(bar_assembler).measure_increment(d).turn, 0.2);
  d.assign(cable.unknowns, 0.0);
  d[cable.dof(0, 2)] = 2.0;
  d[cable.dof(0, 1) + 3] = 0.3;
  EXPECT_DOUBLE_EQ(LineSystem(cable_assembler).measure_increment(d).turn, 0.3);
}

TEST(LineSystem, ReferenceForceIsTheReactionOrTheLargestNodalLoad) {
  const Model model = hanging(ModelChoice::cable);
  const Assembler assembler(model);
  const LineSystem system(assembler);
  std::vector<double> r(model.unknowns, 0.0);
  EXPECT_DOUBLE_EQ(system.reference_force(r), 200.0);  // 20 N/m on the middle node
  r[2] = -450.0;                                       // at the support
  EXPECT_DOUBLE_EQ(system.reference_force(r), 450.0);
  r[model.dof(0, 2) + 2] = 1.0e6;  // elsewhere a residual is an error, not a scale
  EXPECT_DOUBLE_EQ(system.reference_force(r), 450.0);
}

}  // namespace
}  // namespace hawser::test
