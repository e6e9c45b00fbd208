// One step of refinement: it repairs what elimination without exchanges lost, and leaves a good solution alone.
#include "solver/linear/refinement.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/solver/linear/random_chains.hpp"

namespace hawser {

namespace {

using test::Kind;
using test::Shape;

/// max_i |A x - b|_i / (|A| |x| + |b|)_i, in long double.
double componentwise(const BlockTridiagonal& matrix, std::span<const double> x, std::span<const double> b) {
  using Vector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;
  const auto a = test::dense(matrix).cast<long double>().eval();
  const Vector wide_x = Eigen::Map<const Eigen::VectorXd>(x.data(), x.size()).cast<long double>();
  const Vector wide_b = Eigen::Map<const Eigen::VectorXd>(b.data(), b.size()).cast<long double>();
  const Vector size = a.cwiseAbs() * wide_x.cwiseAbs() + wide_b.cwiseAbs();
  return static_cast<double>(((a * wide_x - wide_b).cwiseAbs().array() / size.array()).maxCoeff());
}

constexpr double roundoff = 1.1e-16;

struct Solved {
  FactorReport report;
  Refinement::BackwardErrors errors;
  double true_before = 0.0, true_after = 0.0;
};

Solved solve_and_refine(const BlockTridiagonal& a, unsigned seed) {
  const std::vector<double> b = test::random_vector(a.dofs(), seed);
  const auto solver = make_linear_solver(LinearSolverKind::chain);
  solver->analyze(a);
  Solved solved{solver->factorize(a), {}};
  std::vector<double> x = b;
  solver->solve(x);
  solved.true_before = componentwise(a, x, b);
  solved.errors = Refinement(a).improve(a, *solver, b, x);
  solved.true_after = componentwise(a, x, b);
  return solved;
}

// A row of A has at most 3 n entries, n = 7 unknowns a node: what is looked at and what can be reached are good to 3 n + 1 = 22 units of roundoff.
constexpr double reachable = 22 * roundoff;

// Pivots that are small against their columns: entries grow, short of the limit at which the solver exchanges rows.
TEST(Refinement, LowersTheErrorWhereEliminationLosesDigits) {
  int repaired = 0;
  for (const int block : {3, 6, 7})
    for (unsigned seed = 1; seed <= 20; ++seed) {
      const Shape shape{block, 30};
      BlockTridiagonal a = test::random_matrix(Kind::positive_definite, {&shape, 1}, seed);
      const Chain& c = a.chains()[0];
      for (const int node : {0, 9, 29}) a.D(c, node)[0] = 0.05;
      const Solved solved = solve_and_refine(a, seed);
      ASSERT_EQ(solved.report.status, FactorStatus::ok);
      if (solved.report.fell_back) continue;
      EXPECT_NEAR(solved.errors.before, solved.true_before, reachable);
      EXPECT_NEAR(solved.errors.after, solved.true_after, reachable);
      EXPECT_LE(solved.true_after, reachable) << "block " << block << ", seed " << seed;
      if (solved.true_before > 20 * roundoff && solved.true_after < 0.2 * solved.true_before) ++repaired;
    }
  EXPECT_GE(repaired, 10);
}

TEST(Refinement, NeverMakesASolutionWorse) {
  for (const Kind kind : {Kind::positive_definite, Kind::symmetric_indefinite, Kind::unsymmetric, Kind::badly_scaled})
    for (unsigned seed = 1; seed <= 20; ++seed) {
      const std::vector<Shape> shapes = {{6, 20}, {3, 11}, {7, 9}};
      const Solved solved = solve_and_refine(test::random_matrix(kind, shapes, seed), seed);
      ASSERT_EQ(solved.report.status, FactorStatus::ok);
      EXPECT_LE(solved.errors.after, solved.errors.before);
      EXPECT_LE(solved.true_after, solved.true_before + reachable) << test::name_of(kind) << ", seed " << seed;
    }
}

TEST(Refinement, TakesAnUnknownWithoutLoadForSolved) {
  const Shape shape{3, 4};
  BlockTridiagonal a = test::random_matrix(Kind::positive_definite, {&shape, 1}, 1);
  const auto solver = make_linear_solver(LinearSolverKind::chain);
  solver->analyze(a);
  ASSERT_EQ(solver->factorize(a).status, FactorStatus::ok);
  std::vector<double> b(a.dofs()), x(a.dofs());
  const Refinement::BackwardErrors errors = Refinement(a).improve(a, *solver, b, x);
  EXPECT_EQ(errors.before, 0.0);
  EXPECT_EQ(errors.after, 0.0);
}

}  // namespace

}  // namespace hawser
