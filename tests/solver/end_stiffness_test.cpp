// The end stiffness against closed forms and against the change of the end force between two equilibria.
#include "solver/end_stiffness.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "assembly/assembler.hpp"
#include "assembly/observables.hpp"
#include "tests/support/scene_builder.hpp"
#include "tests/support/static_solution.hpp"

namespace hawser::test {
namespace {

Scene span(const Vec3& top, double current, double EI = 0.0, ModelChoice model = ModelChoice::automatic) {
  LineType type = u40();
  type.EI = EI;
  SceneBuilder b;
  b.type(type).fixed("bottom", {0, 0, -300}).fixed("top", top).line("bottom", "top", model).section("U40", 500.0, 40);
  if (EI > 0.0) b.clamp_to({0.2, 0.1, 1.0});
  if (current != 0.0) b.current(0.0, {0.3, current, 0});
  return b.scene;
}

/// Central differences of the force and moment that the support at the `to` end exerts, step h in one coordinate.
Eigen::VectorXd measured_column(const std::function<Scene(double)>& scene, double h, bool moment) {
  const auto reaction = [&](double step) {
    const StaticSolution s(scene(step), StaticStart::catenary, 1e-12);
    Eigen::VectorXd f(moment ? 6 : 3);
    f.head(3) = -s.line.force_to;
    if (moment) f.tail(3) = -s.line.moment_to;
    return f;
  };
  return (reaction(h) - reaction(-h)) / (2.0 * h);
}

TEST(EndStiffness, AStraightTautLineHasEAOverLAlongItAndTOverTheChordAcross) {
  // Weightless: L = 99 m pulled to 100 m. Along: EA/L; across: T/chord.
  const double EA = 1.0e6, T = EA * (100.0 / 99.0 - 1.0);
  const Scene scene = SceneBuilder()
                          .dry()
                          .type(line_type("wire", EA, 0.0))
                          .fixed("a", {0, 0, 0})
                          .fixed("b", {100, 0, 0})
                          .line("a", "b")
                          .section("wire", 99.0, 8)
                          .scene;
  const StaticSolution s(scene);
  const std::vector<EndStiffness> ends = end_stiffness(*s.model, s.state);
  ASSERT_EQ(ends.size(), 2u);
  for (const EndStiffness& end : ends) {
    const Mat3 expected = Vec3(EA / 99.0, T / 100.0, T / 100.0).asDiagonal();
    EXPECT_LT((end.value - expected).norm(), 1e-9 * EA / 99.0) << end.value;  // rounding times the condition of 8 elements
  }
  EXPECT_TRUE(ends[0].at_from);
  EXPECT_FALSE(ends[1].at_from);
}

TEST(EndStiffness, IsTheDerivativeOfTheEndForceOfEveryFamilyInACurrent) {
  for (const ModelChoice model : {ModelChoice::bar, ModelChoice::cable}) {
    const Vec3 top(300, 0, 0);
    const StaticSolution s(span(top, 0.4, 0.0, model));
    const Eigen::MatrixXd K = end_stiffness(*s.model, s.state)[1].value;
    for (int axis = 0; axis < 3; ++axis) {
      const auto moved = [&](double h) { return span(top + h * Vec3::Unit(axis), 0.4, 0.0, model); };
      const Eigen::VectorXd column = measured_column(moved, 0.1, false);
      // Central differences: (h/L)^2 of the stiffness with h = 0.1 m and L = 100 m (the scale of the shape), ten times over.
      EXPECT_LT((K.col(axis) - column).norm(), 1e-5 * K.norm()) << axis << "\n" << K << "\n" << column;
    }
  }
}

TEST(EndStiffness, AClampedEndHasSixBySixWithForcesAndMoments) {
  const Vec3 top(300, 0, 0), direction = Vec3(0.2, 0.1, 1.0).normalized();
  const double EI = 2.0e4;
  const StaticSolution s(span(top, 0.4, EI));
  const Eigen::MatrixXd K = end_stiffness(*s.model, s.state)[1].value;
  ASSERT_EQ(K.rows(), 6);
  ASSERT_EQ(end_stiffness(*s.model, s.state)[0].value.rows(), 3);  // the other end is pinned
  for (int column = 0; column < 6; ++column) {
    const Vec3 axis = Vec3::Unit(column % 3);
    const auto moved = [&](double h) {
      Scene scene = span(column < 3 ? Vec3(top + h * axis) : top, 0.4, EI);
      if (column >= 3) scene.lines[0].to_end.direction = Eigen::AngleAxisd(h, axis) * direction;
      return scene;
    };
    const double h = column < 3 ? 0.1 : 1e-3;
    const Eigen::VectorXd expected = measured_column(moved, h, true);
    // Forces and moments differ in unit: each block against its own size. Central differences: h^2 over the square of the scale of the
    // shape (100 m, 1 rad), ten times over.
    const int first = column < 3 ? 0 : 3;
    const double tolerance = 1e-5;
    EXPECT_LT((K.col(column).head(3) - expected.head(3)).norm(), tolerance * K.block(0, first, 3, 3).norm()) << column;
    EXPECT_LT((K.col(column).tail(3) - expected.tail(3)).norm(), tolerance * K.block(3, first, 3, 3).norm()) << column;
  }
}

TEST(EndStiffness, IsSymmetricInStillWater) {
  const StaticSolution s(span({300, 0, 0}, 0.0));
  for (const EndStiffness& end : end_stiffness(*s.model, s.state)) {
    EXPECT_LT((end.value - end.value.transpose()).norm(), 1e-9 * end.value.norm());
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<Mat3>(Mat3(end.value)).eigenvalues().minCoeff(), 0.0);  // a stable line pulls back
  }
}

TEST(EndStiffness, ALineWithAFreeEndFollowsItsSupportWithoutForce) {
  const StaticSolution s(SceneBuilder()
                             .type(u40())
                             .current(0.0, {0.5, 0, 0})
                             .fixed("top", {0, 0, 0})
                             .free("end", {0, 0, -500}, weight(3000.0))
                             .line("top", "end")
                             .section("U40", 500.0, 20)
                             .scene);
  const std::vector<EndStiffness> ends = end_stiffness(*s.model, s.state);
  ASSERT_EQ(ends.size(), 1u);
  // A uniform current: moving all changes nothing. Rounding: eps times the stiffness of an element EA/l = 1.6e6 N/m times the
  // condition of the line, EA/l over its pendulum stiffness T/L = 6 N/m.
  EXPECT_LT(ends[0].value.norm(), 2.2e-16 * 1.6e6 * (1.6e6 / 6.0));
}

}  // namespace
}  // namespace hawser::test
