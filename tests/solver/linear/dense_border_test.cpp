// Chains with a border: one torque along a line, a rigid body at the ends of several.
//
// Elimination of the chains first is as accurate as the condition of A allows, up to 1e4 here; the tolerance of the backward error is that of the
// contract, 1e-14.
#include "solver/linear/dense_border.hpp"

#include <random>

#include <gtest/gtest.h>

#include "solver/linear/dense_spectrum.hpp"
#include "tests/solver/linear/random_chains.hpp"

namespace hawser {

namespace {

using test::Kind;
using test::Shape;

constexpr double backward_tolerance = 1e-14;

struct System {
  BlockTridiagonal A;
  Eigen::MatrixXd B, C, D;

  Eigen::MatrixXd whole() const {
    Eigen::MatrixXd m(A.dofs() + B.cols(), A.dofs() + B.cols());
    m << test::dense(A), B, C, D;
    return m;
  }
};

Eigen::MatrixXd random_block(Eigen::Index rows, Eigen::Index columns, unsigned seed) {
  const std::vector<double> v = test::random_vector(static_cast<std::size_t>(rows * columns), seed);
  return Eigen::Map<const Eigen::MatrixXd>(v.data(), rows, columns);
}

double error_of(const System& s, DenseBorder& solver, unsigned seed) {
  const std::vector<double> b = test::random_vector(s.A.dofs() + s.B.cols(), seed);
  std::vector<double> x = b;
  const std::span<double> all(x);
  solver.solve(all.first(s.A.dofs()), all.last(s.B.cols()));
  return test::backward_error(s.whole(), x, b);
}

void expect_solved(const System& s, const char* what) {
  const auto chains = make_linear_solver(LinearSolverKind::chain);
  DenseBorder solver(*chains);
  solver.analyze(s.A, static_cast<int>(s.B.cols()));
  const FactorReport report = solver.factorize(s.A, s.B, s.C, s.D);
  ASSERT_EQ(report.status, FactorStatus::ok) << what << report.message;
  EXPECT_EQ(report.negative_pivots, -1) << what;
  for (const unsigned seed : {1, 2, 3}) EXPECT_LE(error_of(s, solver, seed), backward_tolerance) << what;
}

/// An unknown that all nodes of the first chain feel.
System with_torque(int block, unsigned seed) {
  const Shape shapes[] = {{block, 60}, {3, 20}};
  System s{test::random_matrix(Kind::positive_definite, shapes, seed), {}, {}, {}};
  const auto n = static_cast<Eigen::Index>(s.A.dofs()), felt = static_cast<Eigen::Index>(s.A.chains()[0].dofs());
  s.B = Eigen::MatrixXd::Zero(n, 1), s.C = Eigen::MatrixXd::Zero(1, n);
  s.B.topRows(felt) = random_block(felt, 1, seed + 1);
  s.C.leftCols(felt) = random_block(1, felt, seed + 2);
  s.D = Eigen::MatrixXd::Constant(1, 1, 2.0);
  return s;
}

TEST(DenseBorder, HoldsATorqueThatIsConstantAlongALine) {
  for (const int block : {3, 6, 7})
    for (unsigned seed = 1; seed <= 5; ++seed) expect_solved(with_torque(block, seed), "torque");
}

TEST(DenseBorder, HoldsABodyOfSixUnknownsAtTheEndsOfLines) {
  const Shape shapes[] = {{6, 50}, {7, 40}, {3, 30}};
  for (unsigned seed = 1; seed <= 5; ++seed) {
    System s{test::random_matrix(Kind::positive_definite, shapes, seed), {}, {}, {}};
    const auto n = static_cast<Eigen::Index>(s.A.dofs());
    s.B = Eigen::MatrixXd::Zero(n, 6), s.C = Eigen::MatrixXd::Zero(6, n);
    for (const Chain& c : s.A.chains()) {
      const auto end = static_cast<Eigen::Index>(c.dof(c.nodes - 1));
      s.B.middleRows(end, c.block) = random_block(c.block, 6, seed + 1);
      s.C.middleCols(end, c.block) = random_block(6, c.block, seed + 2);
    }
    s.D = 5.0 * Eigen::MatrixXd::Identity(6, 6) + random_block(6, 6, seed + 3);
    expect_solved(s, "body");
  }
}

TEST(DenseBorder, CountsTheNegativeEigenvaluesOfASymmetricSystem) {
  for (const double d : {20.0, -3.0}) {
    System s = with_torque(7, 4);
    s.A.declare(Symmetry::symmetric);
    s.C = s.B.transpose();
    s.D(0, 0) = d;
    const auto chains = make_linear_solver(LinearSolverKind::chain);
    DenseBorder solver(*chains);
    solver.analyze(s.A, 1);
    const FactorReport report = solver.factorize(s.A, s.B, s.C, s.D);
    ASSERT_EQ(report.status, FactorStatus::ok);
    EXPECT_EQ(report.negative_pivots, negative_eigenvalues(s.whole()));
    EXPECT_LE(error_of(s, solver, 9), backward_tolerance);
  }
}

TEST(DenseBorder, SaysWhichUnknownNothingHolds) {
  System s = with_torque(6, 2);
  const auto n = static_cast<Eigen::Index>(s.A.dofs());
  System loose{s.A, Eigen::MatrixXd::Zero(n, 2), Eigen::MatrixXd::Zero(2, n), Eigen::MatrixXd::Zero(2, 2)};
  loose.B.col(0) = s.B, loose.C.row(0) = s.C, loose.D(0, 0) = 2.0;
  const auto chains = make_linear_solver(LinearSolverKind::chain);
  DenseBorder solver(*chains);
  solver.analyze(loose.A, 2);
  const FactorReport report = solver.factorize(loose.A, loose.B, loose.C, loose.D);
  EXPECT_EQ(report.status, FactorStatus::singular);
  EXPECT_EQ(report.failed_unknown, loose.A.dofs() + 1);
  EXPECT_FALSE(report.message.empty());
}

}  // namespace

}  // namespace hawser
