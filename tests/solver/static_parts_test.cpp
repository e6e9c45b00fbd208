// Networks taken apart into lines that are solved on their own.
#include "solver/static_parts.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "solver/norms.hpp"
#include "tests/support/network_scenes.hpp"
#include "tests/support/static_solution.hpp"

namespace hawser::test {
namespace {

double largest_difference(const Model& model, const State& a, const State& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < model.unknowns; ++i) largest = std::max(largest, std::abs(a.q[i] - b.q[i]));
  return largest;
}

class Apart : public ::testing::TestWithParam<ModelChoice> {};

TEST_P(Apart, LinesKeepTheirEquilibriumAndTheirEndForces) {
  const StaticSolution s(small_network(4, GetParam()));
  const Model& model = *s.model;
  for (int line = 0; line < static_cast<int>(model.lines.size()); ++line) {
    const Model alone = line_apart(model, line, s.state);
    State own = alone.make_state();
    std::copy_n(s.state.q.begin() + static_cast<std::ptrdiff_t>(model.chain(line).first_dof), alone.dofs, own.q.begin());
    std::size_t inner = alone.dofs;
    for (const Joint& joint : model.joints)
      for (int k = 0; joint.line == line && k < joint.inner_count(); ++k) own.q[inner++] = s.state.q[joint.inner + static_cast<std::size_t>(k)];
    ASSERT_EQ(inner, alone.unknowns);
    std::vector<double> r(alone.unknowns);
    const Assembler assembler(alone);
    assembler.residual(own, r);
    assembler.project(r);
    EXPECT_LE(residual_norm(alone, r), 1.001 * s.report.residual_force) << line;  // a part of the residual of the whole
    const LineResult together = observe_line(model, s.state, line), apart = observe_line(alone, own, 0);
    EXPECT_LT((together.force_from - apart.force_from).norm(), 1e-12 * together.tension_from) << line;
    EXPECT_LT((together.force_to - apart.force_to).norm(), 1e-12 * together.tension_to) << line;
  }
}

INSTANTIATE_TEST_SUITE_P(Families, Apart, ::testing::Values(ModelChoice::bar, ModelChoice::cable, ModelChoice::beam), [](const auto& test) {
  return test.param == ModelChoice::bar ? "bar" : test.param == ModelChoice::cable ? "cable" : "beam";
});

TEST(LinesApart, OfASolvedNetworkStayWhereTheyAre) {
  const StaticSolution s(small_network(4, ModelChoice::beam));
  State state = s.state;
  const LinesApart apart = solve_lines_apart(*s.model, {}, true, state);
  EXPECT_EQ(apart.unsolved, 0);
  EXPECT_LE(apart.factorizations, 2.0);  // two of every line at most: their sum counts as two of the whole
  EXPECT_LT(largest_difference(*s.model, state, s.state), 1e-7);
}

TEST(LinesApart, LeaveAResidualOnlyWhereTheyMeet) {
  const StaticSolution s(small_network(4, ModelChoice::beam));
  const Model& model = *s.model;
  State state = s.state;
  for (const Hub& hub : model.hubs)
    for (const Support& end : hub.ends) Eigen::Map<Vec3>(&state.q[model.dof(end.line, end.node)]) += Vec3(0.1, -0.1, 0.05);
  EXPECT_EQ(solve_lines_apart(model, {}, true, state).unsolved, 0);
  std::vector<double> r(model.unknowns);
  const Assembler assembler(model);
  assembler.residual(state, r);
  const double reference = reference_force(model, r);
  assembler.project(r);
  double at_hubs = 0.0;
  for (const Hub& hub : model.hubs) {
    Eigen::Map<Vec3> force(&r[model.dof(hub.ends[0].line, hub.ends[0].node)]);
    at_hubs = std::max(at_hubs, force.norm());
    force.setZero();
  }
  EXPECT_GT(at_hubs, 1e-4 * reference);
  EXPECT_LT(residual_norm(model, r), 1e-9 * reference);  // each line to 1e-10 of its own largest reaction
}

}  // namespace
}  // namespace hawser::test
