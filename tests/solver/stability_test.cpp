// The softest mode of unstable and neutral equilibria, against closed forms of columns and strings.
#include "solver/stability.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "assembly/observables.hpp"
#include "bench/trial.hpp"
#include "solver/bordered_solver.hpp"
#include "solver/linear/dense_spectrum.hpp"
#include "solver/static_system.hpp"
#include "tests/support/scene_builder.hpp"
#include "tests/support/static_solution.hpp"

namespace hawser::test {
namespace {

constexpr double pi = std::numbers::pi;

/// A straight weightless line along x of unstretched length L between points `stretch` L apart.
struct Straight {
  Straight(double EA, double EI, double stretch, int elements)
      : model(build_model(SceneBuilder()
                              .dry()
                              .type(line_type("line", EA, 0.0, EI))
                              .fixed("a", {0, 0, 0})
                              .fixed("b", {stretch * L, 0, 0})
                              .line("a", "b", EI > 0.0 ? ModelChoice::beam : ModelChoice::cable)
                              .section("line", L, elements)
                              .scene)),
        state(static_start(model, StaticStart::straight)) {}

  static constexpr double L = 10.0;
  Model model;
  State state;
};

TEST(SoftestMode, OfAColumnAboveItsEulerLoadIsAHalfWaveOfKnownStiffness) {
  // Pinned, compressed by P = EA e: lambda_n = (n pi/L)^2 ((n pi/L)^2 EI - P) per length to first order in the strain e = P/EA; each twice (y and z).
  const double EI = 100.0, EA = 1.0e7, euler = pi * pi * EI / (Straight::L * Straight::L), P = 2.0 * euler;
  const Straight column(EA, EI, 1.0 - P / EA, 16);
  const std::optional<StabilityMode> mode = softest_mode(column.model, column.state, P);
  ASSERT_TRUE(mode);
  EXPECT_EQ(mode->negative_pivots, 2);
  EXPECT_EQ(negative_pivots_of_elastic_tangent(column.model, column.state), 2);
  // M counts the slopes too: (l pi/L)^2 of the displacements. What is left is strain, 2e-5, and the mesh, (pi/16)^4/720 of the bending part.
  const double expected = -std::pow(pi / Straight::L, 2) * euler / (1.0 + std::pow(pi / 16.0, 2));
  EXPECT_NEAR(mode->stiffness, expected, 1e-4 * std::abs(expected));
  EXPECT_NEAR(mode->s, 5.0, 1e-9);
  EXPECT_NEAR(mode->direction.x(), 0.0, 1e-6);
  const double largest = Eigen::Map<const Vec3>(&mode->shape[column.model.dof(0, 8)]).norm();
  EXPECT_NEAR(largest, 1.0, 1e-12);
  for (int i = 0; i <= 16; ++i) {
    const Vec3 r = Eigen::Map<const Vec3>(&mode->shape[column.model.dof(0, i)]);
    EXPECT_NEAR(r.dot(mode->direction), std::sin(pi * i / 16.0), 1e-4) << i;
  }
}

TEST(SoftestMode, ATautStringHasNone) {
  const Straight string(1.0e6, 0.0, 1.001, 16);
  EXPECT_FALSE(softest_mode(string.model, string.state, 1000.0));
}

TEST(SoftestMode, AnUnstrainedStringIsNeutralAcross) {
  const Straight string(1.0e6, 0.0, 1.0, 16);
  const std::optional<StabilityMode> mode = softest_mode(string.model, string.state, 1000.0);
  ASSERT_TRUE(mode);
  EXPECT_EQ(mode->negative_pivots, 0);
  EXPECT_LE(std::abs(mode->stiffness), 1e-6 * 1000.0 / 100.0);
  EXPECT_NEAR(mode->direction.x(), 0.0, 1e-6);
}

TEST(SoftestMode, OfACompressedStringWithAJointIsTheLeastEigenvalueOfItsCondensedTangent) {
  // In the element left of the load the string has a slope of its own there, which gives way too, in both directions across; it has no mass.
  const Model model = build_model(SceneBuilder()
                                      .dry()
                                      .type(line_type("line", 1.0e6, 0.0))
                                      .fixed("a", {0, 0, 0})
                                      .fixed("b", {9.999, 0, 0})
                                      .line("a", "b", ModelChoice::cable)
                                      .section("line", 10.0, 6)
                                      .load(5.0, weight(1e-9))
                                      .scene);
  ASSERT_EQ(model.joints.size(), 1u);
  const State state = static_start(model, StaticStart::straight);
  const Assembler assembler(model);
  Tangent tangent = assembler.make_tangent();
  std::vector<double> r(model.unknowns);
  assembler.tangent(state, {}, {}, r, tangent);
  tangent.symmetrize();
  ASSERT_EQ(tangent.negative_inner_pivots(), 2);
  const auto n = static_cast<Eigen::Index>(model.dofs);
  Eigen::MatrixXd K(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::VectorXd unit = Eigen::VectorXd::Unit(n, i);
    multiply(tangent, {unit.data(), model.dofs}, {K.col(i).data(), model.dofs});
  }
  // Ends carry half an element, and do not move.
  std::vector<Eigen::Index> moving;
  Eigen::VectorXd root(n);
  const double l = model.element.length[0];
  for (Eigen::Index i = 0; i < n; ++i) {
    const bool end = i < 6 || i >= n - 6;
    root[i] = std::sqrt(end ? 0.5 * l : l) * (i % 6 < 3 ? 1.0 : l);
    if (!end || i % 6 >= 3) moving.push_back(i);
  }
  const Eigen::MatrixXd scaled = root.cwiseInverse().asDiagonal() * K * root.cwiseInverse().asDiagonal();
  const Eigen::VectorXd eigenvalues = symmetric_eigenvalues(scaled(moving, moving));
  const std::optional<StabilityMode> mode = softest_mode(model, state, 100.0);
  ASSERT_TRUE(mode);
  EXPECT_NEAR(mode->stiffness, eigenvalues[0], 1e-6 * std::abs(eigenvalues[0]));
  EXPECT_EQ(mode->negative_pivots, 2 + (eigenvalues.array() < 0.0).count());
}

TEST(SoftestMode, AHangingCatenaryHasNone) {
  const StaticSolution solution(
      SceneBuilder().type(u40()).fixed("a", {0, 0, -500}).fixed("b", {600, 0, 0}).line("a", "b").section("U40", 900.0, 30).scene);
  EXPECT_FALSE(softest_mode(*solution.model, solution.state, solution.report.reference_force));
}

TEST(SlowestDecay, OfATautStringAndOfAColumnIsThatOfTheirHalfWave) {
  // kappa = T (pi/L)^2 of a string of tension T; of a column (pi/L)^2 ((pi/L)^2 EI - P), as above. Between them lies the strain, 1e-3 and 2e-5, and
  // what the mesh leaves, (pi/16)^4/720.
  const double strain = 1e-3, EA = 1.0e6, wave = std::pow(pi / Straight::L, 2);
  const Straight string(EA, 0.0, 1.0 + strain, 16);
  const std::optional<double> taut = slowest_decay(string.model, string.state, 1.0);
  ASSERT_TRUE(taut);
  EXPECT_NEAR(*taut, wave * EA * strain, 2.0 * strain * wave * EA * strain);
  const double EI = 100.0, stiff = 1.0e7, euler = wave * EI, P = 2.0 * euler;
  const Straight column(stiff, EI, 1.0 - P / stiff, 16);
  const std::optional<double> unstable = slowest_decay(column.model, column.state, wave * euler);
  ASSERT_TRUE(unstable);
  EXPECT_NEAR(*unstable, -wave * euler, 1e-4 * wave * euler);
}

TEST(SlowestDecay, AgreesWithTheWholeSpectrumWhereDragAndFrictionHaveNoPotential) {
  // Of the trial's draws a span in a current, a pipe on a bed with friction in a current, and legs in a current. Differences of the residual over
  // 1e-7 m leave the dense matrix 1e-4 of its small eigenvalues.
  for (const bench::Trial& trial : {bench::draw_trial(1, 7), bench::draw_trial(3, 4836), bench::draw_network(1, 2)}) {
    const Model model = build_model(trial.scene);
    State state;
    ASSERT_TRUE(solve_static(Assembler(model), {}, state).converged) << trial.kind;
    const double dense = bench::least_decay(model, state);
    const std::optional<double> slowest = slowest_decay(model, state, dense);
    ASSERT_TRUE(slowest) << trial.kind;
    EXPECT_NEAR(*slowest, dense, 1e-3 * std::abs(dense)) << trial.kind;
  }
}

}  // namespace
}  // namespace hawser::test
