// What only the chain solver promises: when it exchanges rows, what it counts, what it costs in memory.
#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "solver/linear/dense_spectrum.hpp"
#include "solver/linear/linear_solver.hpp"
#include "tests/solver/linear/random_chains.hpp"

namespace hawser {

namespace {

using test::Kind;
using test::Shape;

constexpr double backward_tolerance = 1e-14;  // growth limit 100 times the unit roundoff

double error_of(LinearSolver& solver, const BlockTridiagonal& matrix) {
  const std::vector<double> b = test::random_vector(matrix.dofs(), 11);
  std::vector<double> x = b;
  solver.solve(x);
  return test::backward_error(test::dense(matrix), x, b);
}

// Congruence S A S with S from 10^-decades to 10^decades keeps a matrix positive definite and makes its blocks ill conditioned.
void scale_unknowns(BlockTridiagonal& matrix, double decades) {
  const std::vector<double> exponent = test::random_vector(matrix.dofs(), 5);
  for (const Chain& c : matrix.chains())
    for (int i = 0; i < c.nodes; ++i)
      for (int k = 0; k < c.block * c.block; ++k) {
        const auto scale = [&](int at) { return std::pow(10.0, decades * exponent[at]); };
        const int row = k % c.block, column = k / c.block, here = static_cast<int>(c.dof(i)), next = here + c.block;
        matrix.D(c, i)[k] *= scale(here + row) * scale(here + column);
        if (i + 1 == c.nodes) continue;
        matrix.U(c, i)[k] *= scale(here + row) * scale(next + column);
        matrix.L(c, i)[k] *= scale(next + row) * scale(here + column);
      }
}

TEST(ChainSolver, KeepsFullAccuracyWithIllConditionedDiagonalBlocks) {
  const Shape shape{6, 60};
  for (unsigned seed = 1; seed <= 10; ++seed) {
    BlockTridiagonal a = test::random_matrix(Kind::positive_definite, {&shape, 1}, seed);
    scale_unknowns(a, 5.0);
    const auto solver = make_linear_solver(LinearSolverKind::chain);
    solver->analyze(a);
    const FactorReport report = solver->factorize(a);
    EXPECT_EQ(report.status, FactorStatus::ok);
    EXPECT_FALSE(report.fell_back);
    EXPECT_EQ(report.negative_pivots, 0);
    // No growth in a positive definite matrix: a few units of roundoff.
    EXPECT_LE(error_of(*solver, a), 5e-16);
  }
}

TEST(ChainSolver, ExchangesRowsWhenAPivotIsZeroOrTinyAndReturnsWhenItIsNot) {
  const Shape shape{6, 30};
  const BlockTridiagonal good = test::random_matrix(Kind::positive_definite, {&shape, 1}, 1);
  const auto solver = make_linear_solver(LinearSolverKind::chain);
  solver->analyze(good);
  for (const int node : {0, 15, 29})
    for (const double pivot : {0.0, 1e-300, 1e-20, -1e-9}) {
      // Unknowns 0 and 1 of a node coupled to each other and to nothing else: [pivot 1; 1 0].
      BlockTridiagonal a = good;
      const Chain& c = a.chains()[0];
      for (const int k : {0, 1})
        for (int other = 0; other < 6; ++other) {
          a.D(c, node)[k + 6 * other] = a.D(c, node)[other + 6 * k] = 0.0;
          if (node < 29) a.U(c, node)[k + 6 * other] = a.L(c, node)[other + 6 * k] = 0.0;
          if (node > 0) a.U(c, node - 1)[other + 6 * k] = a.L(c, node - 1)[k + 6 * other] = 0.0;
        }
      a.D(c, node)[0] = pivot;
      a.D(c, node)[1] = a.D(c, node)[6] = 1.0;
      const FactorReport report = solver->factorize(a);
      ASSERT_EQ(report.status, FactorStatus::ok) << report.message;
      EXPECT_TRUE(report.fell_back);
      EXPECT_EQ(report.negative_pivots, -1);
      EXPECT_LE(error_of(*solver, a), backward_tolerance);

      EXPECT_FALSE(solver->factorize(good).fell_back);
      EXPECT_LE(error_of(*solver, good), backward_tolerance);
    }
}

TEST(ChainSolver, CountsTheNegativeEigenvaluesOfASymmetricMatrixInEitherForm) {
  const std::vector<Shape> shapes = {{6, 15}, {3, 20}, {7, 8}};
  int indefinite[2] = {};
  for (unsigned seed = 1; seed <= 20; ++seed) {
    BlockTridiagonal a = test::random_matrix(Kind::positive_definite, shapes, seed);
    for (const Chain& c : a.chains())
      for (int i = 0; i < c.nodes; ++i)
        for (int k = 0; k < c.block; ++k) a.D(c, i)[k * (c.block + 1)] -= 0.05 * seed;
    const Eigen::VectorXd eigenvalues = symmetric_eigenvalues(test::dense(a));
    for (const Symmetry symmetry : {Symmetry::unknown, Symmetry::symmetric}) {
      a.declare(symmetry);
      const auto solver = make_linear_solver(LinearSolverKind::chain);
      solver->analyze(a);
      const FactorReport report = solver->factorize(a);
      ASSERT_EQ(report.status, FactorStatus::ok);
      if (report.fell_back) continue;
      EXPECT_EQ(report.negative_pivots, (eigenvalues.array() < 0.0).count());
      indefinite[symmetry == Symmetry::symmetric] += report.negative_pivots > 0;
    }
  }
  EXPECT_GT(indefinite[0], 0);
  EXPECT_GT(indefinite[1], 0);
}

TEST(ChainSolver, HoldsThreeBlocksANode) {
  const std::vector<Shape> shapes = {{6, 1000}, {3, 1000}};
  const auto solver = make_linear_solver(LinearSolverKind::chain);
  solver->analyze(test::random_matrix(Kind::positive_definite, shapes, 1));
  EXPECT_EQ(solver->bytes(), 1000 * 3 * (36 + 9) * sizeof(double));
}

TEST(ChainSolver, SolvesAHundredThousandNodes) {
  const Shape shape{6, 100000};
  const BlockTridiagonal a = test::random_matrix(Kind::positive_definite, {&shape, 1}, 3);
  const auto solver = make_linear_solver(LinearSolverKind::chain);
  solver->analyze(a);
  ASSERT_EQ(solver->factorize(a).status, FactorStatus::ok);
  std::vector<double> x = test::random_vector(a.dofs(), 4), product(a.dofs());
  const std::vector<double> b = x;
  solver->solve(x);
  a.multiply(x, product);
  double residual = 0.0, norm_x = 0.0, norm_a = 0.0;
  for (std::size_t i = 0; i < b.size(); ++i) {
    residual = std::max(residual, std::abs(product[i] - b[i]));
    norm_x = std::max(norm_x, std::abs(x[i]));
  }
  for (const double v : a.values()) norm_a = std::max(norm_a, std::abs(v));  // below the infinity norm: the stricter yardstick
  EXPECT_LE(residual, backward_tolerance * (norm_a * norm_x + 1.0));
}

TEST(ChainSolver, GivesTheSameBitsWithTwoThreads) {
  for (const Shape shape : {Shape{6, 20001}, Shape{3, 20000}, Shape{7, 12000}}) {
    const BlockTridiagonal a = test::random_matrix(Kind::positive_definite, {&shape, 1}, 6);
    const std::vector<double> b = test::random_vector(a.dofs(), 7);
    std::vector<double> x[2] = {b, b};
    FactorReport report[2];
    for (const int threads : {1, 2}) {
      const auto solver = make_linear_solver(LinearSolverKind::chain, threads);
      solver->analyze(a);
      report[threads - 1] = solver->factorize(a);
      solver->solve(x[threads - 1]);
    }
    EXPECT_EQ(x[0], x[1]);
    EXPECT_EQ(report[0].negative_pivots, report[1].negative_pivots);
    EXPECT_EQ(report[0].smallest_pivot, report[1].smallest_pivot);
    EXPECT_EQ(report[0].largest_pivot, report[1].largest_pivot);
  }
}

}  // namespace

}  // namespace hawser
