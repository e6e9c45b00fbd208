// Every backend on every kind of system it can take, judged by backward error.
//
// Tolerance 1e-14: the chain solver exchanges rows from a growth of 100 on, so it answers for 100 times the unit roundoff 1.1e-16; the others
// pivot and do better. A solution then agrees with the dense reference to 1e-14 times the condition number.
#include <cmath>
#include <limits>
#include <tuple>

#include <gtest/gtest.h>

#include "solver/linear/linear_solver.hpp"
#include "tests/solver/linear/random_chains.hpp"

namespace hawser {

namespace {

using test::Kind;
using test::Shape;

constexpr double backward_tolerance = 1e-14;
constexpr int systems = 8;

const std::vector<std::pair<std::string, std::vector<Shape>>> shapes = {
    {"one_node", {{6, 1}}},
    {"bars", {{3, 40}}},
    {"cable", {{6, 50}}},
    {"rod", {{7, 45}}},
    {"two_bar_lines", {{3, 7}, {3, 12}}},
    {"mixed_lines", {{6, 20}, {3, 1}, {7, 12}, {3, 30}, {6, 2}}},
};

class EveryLinearSolver : public testing::TestWithParam<std::tuple<LinearSolverKind, Kind, std::size_t>> {
 protected:
  std::unique_ptr<LinearSolver> solver() const { return make_linear_solver(std::get<0>(GetParam())); }
  Kind kind() const { return std::get<1>(GetParam()); }
  bool symmetric() const { return kind() == Kind::positive_definite || kind() == Kind::symmetric_indefinite; }
  /// Unsymmetric, or indefinite so that entries may grow: a symmetric solver may say so instead.
  bool may_refuse() const { return !solver()->takes_unsymmetric() && kind() != Kind::positive_definite; }
  BlockTridiagonal matrix(unsigned seed) const { return test::random_matrix(kind(), shapes[std::get<2>(GetParam())].second, seed); }
};

void expect_solved(LinearSolver& solver, const BlockTridiagonal& matrix, unsigned seed) {
  const Eigen::MatrixXd a = test::dense(matrix);
  const std::vector<double> b = test::random_vector(matrix.dofs(), seed);
  std::vector<double> x = b;
  solver.solve(x);
  EXPECT_LE(test::backward_error(a, x, b), backward_tolerance);

  // Rows scaled to one by powers of two first, or the reference itself would suffer from bad scaling.
  const Eigen::VectorXd scale = a.cwiseAbs().rowwise().maxCoeff().unaryExpr([](double v) { return std::exp2(-std::ilogb(v)); });
  const Eigen::FullPivLU<Eigen::MatrixXd> reference(scale.asDiagonal() * a);
  const Eigen::VectorXd exact = reference.solve(scale.cwiseProduct(Eigen::Map<const Eigen::VectorXd>(b.data(), b.size())));
  const Eigen::MatrixXd inverse = reference.inverse() * scale.asDiagonal();
  const double condition = a.cwiseAbs().rowwise().sum().maxCoeff() * inverse.cwiseAbs().rowwise().sum().maxCoeff();
  const double difference = (Eigen::Map<const Eigen::VectorXd>(x.data(), x.size()) - exact).cwiseAbs().maxCoeff();
  EXPECT_LE(difference, 4 * backward_tolerance * condition * exact.cwiseAbs().maxCoeff());  // two solutions, matrix and right-hand side each
}

TEST_P(EveryLinearSolver, AgreesWithTheDenseReferenceOrSaysItCannot) {
  const auto linear_solver = solver();
  linear_solver->analyze(matrix(0));
  int solved = 0;
  for (int seed = 1; seed <= systems; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const BlockTridiagonal a = matrix(seed);
    const FactorReport report = linear_solver->factorize(a);
    if (report.status == FactorStatus::ok) {
      expect_solved(*linear_solver, a, 100 + seed);
      ++solved;
    } else {
      EXPECT_EQ(report.status, FactorStatus::not_applicable) << report.message;
      EXPECT_FALSE(report.message.empty());
    }
  }
  if (!may_refuse()) {
    EXPECT_EQ(solved, systems);
  } else if (!symmetric()) {
    EXPECT_EQ(solved, 0);
  }
}

TEST_P(EveryLinearSolver, SolvesAgainWithTheSameFactors) {
  const auto linear_solver = solver();
  const BlockTridiagonal a = matrix(7);
  linear_solver->analyze(a);
  const FactorReport report = linear_solver->factorize(a);
  if (may_refuse() && report.status == FactorStatus::not_applicable) return;
  ASSERT_EQ(report.status, FactorStatus::ok) << report.message;
  std::vector<double> first = test::random_vector(a.dofs(), 1), second = first, other = test::random_vector(a.dofs(), 2);
  linear_solver->solve(first);
  linear_solver->solve(other);
  linear_solver->solve(second);
  EXPECT_EQ(first, second);
}

TEST_P(EveryLinearSolver, ReportsAnUnknownWithoutStiffness) {
  const auto linear_solver = solver();
  BlockTridiagonal a = matrix(3);
  linear_solver->analyze(a);
  const Chain& c = a.chains().back();
  const int node = c.nodes / 2, column = 1;
  for (int row = 0; row < c.block; ++row) {
    a.D(c, node)[row + c.block * column] = a.D(c, node)[column + c.block * row] = 0.0;
    if (node + 1 < c.nodes) a.U(c, node)[column + c.block * row] = a.L(c, node)[row + c.block * column] = 0.0;
    if (node > 0) a.U(c, node - 1)[row + c.block * column] = a.L(c, node - 1)[column + c.block * row] = 0.0;
  }
  const FactorReport report = linear_solver->factorize(a);
  if (may_refuse() && report.status == FactorStatus::not_applicable) return;
  EXPECT_EQ(report.status, FactorStatus::singular);
  EXPECT_EQ(report.failed_unknown, c.dof(node) + column);
  EXPECT_FALSE(report.message.empty());
}

TEST_P(EveryLinearSolver, ReportsNaNAndInfinityAndRecovers) {
  const auto linear_solver = solver();
  const BlockTridiagonal good = matrix(5);
  linear_solver->analyze(good);
  const FactorStatus usual = linear_solver->factorize(good).status;
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    for (const Chain& c : good.chains())
      for (const int entry : {0, c.block * c.block - 1, c.block}) {
        BlockTridiagonal a = good;
        a.D(c, c.nodes - 1)[entry] = bad;
        const FactorReport report = linear_solver->factorize(a);
        EXPECT_EQ(report.status, FactorStatus::singular);
        EXPECT_GE(report.failed_unknown, c.dof(c.nodes - 1));
        EXPECT_LT(report.failed_unknown, c.dof(c.nodes));
      }
  }
  EXPECT_EQ(linear_solver->factorize(good).status, usual);
  if (usual == FactorStatus::ok) expect_solved(*linear_solver, good, 9);
}

std::string parameter_name(const testing::TestParamInfo<EveryLinearSolver::ParamType>& info) {
  const auto& [solver, kind, shape] = info.param;
  return std::string(name_of(solver)) + "_" + test::name_of(kind) + "_" + shapes[shape].first;
}

INSTANTIATE_TEST_SUITE_P(Backends, EveryLinearSolver,
                         testing::Combine(testing::ValuesIn(all_linear_solvers().begin(), all_linear_solvers().end()),
                                          testing::Values(Kind::positive_definite, Kind::symmetric_indefinite, Kind::unsymmetric, Kind::badly_scaled),
                                          testing::Range(std::size_t{0}, shapes.size())),
                         parameter_name);

TEST(LinearSolverNames, GoBothWays) {
  for (const LinearSolverKind kind : all_linear_solvers()) {
    EXPECT_EQ(linear_solver_kind(name_of(kind)), kind);
    EXPECT_EQ(make_linear_solver(kind)->name(), name_of(kind));
  }
  EXPECT_EQ(linear_solver_kind("auto"), LinearSolverKind::automatic);
  EXPECT_EQ(make_linear_solver(LinearSolverKind::automatic)->name(), "chain");
  EXPECT_THROW(linear_solver_kind("Chain"), std::invalid_argument);
}

}  // namespace

}  // namespace hawser
