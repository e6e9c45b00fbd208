// The chain solver on matrices that are declared symmetric: L Delta L^T with the same watch, inertia and pivoted fallback as LU.
#include <array>
#include <limits>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "solver/linear/linear_solver.hpp"
#include "tests/solver/linear/random_chains.hpp"
#include "tests/solver/linear/stored_panels.hpp"

namespace hawser {

namespace {

using test::Kind;
using test::Shape;

constexpr double backward_tolerance = 1e-14;  // the contract: growth limit 100 times the unit roundoff

const std::vector<Shape> shapes = {{6, 200}, {7, 131}, {3, 130}, {7, 1}, {6, 2}, {6, 129}};

BlockTridiagonal symmetric_matrix(Kind kind, std::span<const Shape> of, unsigned seed) {
  BlockTridiagonal a = test::random_matrix(kind, of, seed);
  a.declare(Symmetry::symmetric);
  return a;
}

double error_of(LinearSolver& solver, const BlockTridiagonal& matrix) {
  const std::vector<double> b = test::random_vector(matrix.dofs(), 11);
  std::vector<double> x = b;
  solver.solve(x);
  return test::backward_error(test::dense(matrix), x, b);
}

TEST(SymmetricChains, AreSolvedAsAccuratelyAsTheContractSays) {
  int fell_back = 0, eliminated = 0;
  const std::vector<Shape> short_ones = {{6, 30}, {7, 20}, {3, 20}};
  const auto solver = make_linear_solver(LinearSolverKind::chain);
  solver->analyze(symmetric_matrix(Kind::positive_definite, short_ones, 1));
  for (const Kind kind : {Kind::positive_definite, Kind::symmetric_indefinite})
    for (unsigned seed = 1; seed <= 30; ++seed) {
      const BlockTridiagonal a = symmetric_matrix(kind, short_ones, seed);
      const FactorReport report = solver->factorize(a);
      ASSERT_EQ(report.status, FactorStatus::ok);
      ++(report.fell_back ? fell_back : eliminated);
      EXPECT_LE(error_of(*solver, a), backward_tolerance) << test::name_of(kind) << ", seed " << seed;
    }
  EXPECT_GT(fell_back, 0);
  EXPECT_GE(eliminated, 30);
}

// The same bits with one thread and two, stored or made panel by panel, factors kept or not.
TEST(SymmetricChains, GiveTheSameBitsByEveryPath) {
  const std::vector<Shape> long_ones = {{6, 20001}, {7, 9000}, {6, 2500}, {3, 300}};
  const BlockTridiagonal a = symmetric_matrix(Kind::positive_definite, long_ones, 6);
  const std::vector<double> b = test::random_vector(a.dofs(), 7);
  std::vector<double> first;
  FactorReport of_first;
  for (const int threads : {1, 2}) {
    const auto solver = make_linear_solver(LinearSolverKind::chain, threads);
    solver->analyze(a);
    for (const int path : {0, 1, 2}) {
      SCOPED_TRACE(fmt::format("{} threads, path {}", threads, path));
      std::vector<double> x = b;
      test::StoredPanels panels(a, b, x, 0.0);
      const FactorReport report = path == 0   ? solver->factorize(a)
                                  : path == 1 ? solver->factorize_and_solve(panels, x)
                                              : solver->solve_once(panels, x);
      ASSERT_EQ(report.status, FactorStatus::ok);
      EXPECT_FALSE(report.fell_back);
      if (path == 0) solver->solve(x);
      if (first.empty()) first = x, of_first = report;
      EXPECT_EQ(x, first);
      EXPECT_EQ(report.smallest_pivot, of_first.smallest_pivot);
      EXPECT_EQ(report.largest_pivot, of_first.largest_pivot);
      if (path != 1) continue;
      std::vector<double> again = b;
      solver->solve(again);
      EXPECT_EQ(again, first) << "factors of panels stay";
    }
  }
}

TEST(SymmetricChains, ExchangeRowsWhereAPivotIsZero) {
  for (const bool made_in_panels : {false, true}) {
    BlockTridiagonal a = symmetric_matrix(Kind::positive_definite, shapes, 7);
    a.D(a.chains()[0], 70)[0] = a.D(a.chains()[0], 0)[0] = a.D(a.chains()[1], 130)[0] = 0.0;
    const std::vector<double> b = test::random_vector(a.dofs(), 8);
    std::vector<double> x = b;
    const auto solver = make_linear_solver(LinearSolverKind::chain);
    solver->analyze(a);
    test::StoredPanels panels(a, b, x);
    const FactorReport report = made_in_panels ? solver->factorize_and_solve(panels, x) : solver->factorize(a);
    ASSERT_EQ(report.status, FactorStatus::ok);
    EXPECT_TRUE(report.fell_back);
    EXPECT_EQ(report.negative_pivots, -1);
    if (!made_in_panels) solver->solve(x);
    EXPECT_LE(test::backward_error(test::dense(a), x, b), backward_tolerance);
  }
}

TEST(SymmetricChains, ReportNaNAndInfinity) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    BlockTridiagonal a = symmetric_matrix(Kind::positive_definite, shapes, 7);
    const Chain& c = a.chains()[1];
    a.D(c, 5)[4] = a.D(c, 5)[4 * 7] = bad;
    const auto solver = make_linear_solver(LinearSolverKind::chain);
    solver->analyze(a);
    const FactorReport report = solver->factorize(a);
    EXPECT_EQ(report.status, FactorStatus::singular);
    EXPECT_GE(report.failed_unknown, c.dof(5));
    EXPECT_LT(report.failed_unknown, c.dof(6));
  }
}

TEST(SymmetricChains, AreForgottenWithTheNextMatrix) {
  const Shape shape{6, 40};
  const auto solver = make_linear_solver(LinearSolverKind::chain);
  const BlockTridiagonal symmetric = symmetric_matrix(Kind::positive_definite, {&shape, 1}, 1);
  BlockTridiagonal twisted = symmetric;
  twisted.declare(Symmetry::unknown);
  const Chain& c = twisted.chains()[0];
  for (int i = 0; i + 1 < c.nodes; ++i) twisted.U(c, i)[3] += 0.5;
  solver->analyze(symmetric);
  for (const BlockTridiagonal* a : {&symmetric, static_cast<const BlockTridiagonal*>(&twisted), &symmetric}) {
    ASSERT_EQ(solver->factorize(*a).status, FactorStatus::ok);
    EXPECT_LE(error_of(*solver, *a), backward_tolerance);
  }
}

}  // namespace

}  // namespace hawser
