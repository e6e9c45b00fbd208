// Signs of pivots against signs of eigenvalues.
#include <limits>

#include <gtest/gtest.h>

#include "solver/linear/dense_spectrum.hpp"
#include "solver/linear/linear_solver.hpp"
#include "tests/solver/linear/random_chains.hpp"

namespace hawser {

namespace {

using test::Kind;
using test::Shape;

const std::vector<Shape> shapes = {{6, 12}, {3, 1}, {3, 17}, {7, 9}};

TEST(Inertia, OfAPositiveDefiniteMatrixIsAllPositive) {
  const Inertia inertia = inertia_of_symmetric_part(test::random_matrix(Kind::positive_definite, shapes, 1));
  EXPECT_EQ(inertia.negative, 0);
  EXPECT_EQ(inertia.zero, 0);
}

TEST(Inertia, AgreesWithEigenvaluesOfTheSymmetricPart) {
  for (const Kind kind : {Kind::symmetric_indefinite, Kind::unsymmetric})
    for (unsigned seed = 1; seed <= 20; ++seed) {
      const BlockTridiagonal a = test::random_matrix(kind, shapes, seed);
      const Eigen::MatrixXd full = test::dense(a), symmetric = 0.5 * (full + full.transpose());
      const Eigen::VectorXd eigenvalues = symmetric_eigenvalues(symmetric);
      const Inertia inertia = inertia_of_symmetric_part(a);
      EXPECT_EQ(inertia.negative, (eigenvalues.array() < 0.0).count());
      EXPECT_EQ(inertia.zero, 0);
    }
}

TEST(Inertia, NamesTheFirstNegativeUnknown) {
  BlockTridiagonal a = test::random_matrix(Kind::positive_definite, shapes, 2);
  const Chain& c = a.chains()[2];
  a.D(c, 9)[2 + 3 * 2] = -1e3;
  const Inertia inertia = inertia_of_symmetric_part(a);
  EXPECT_EQ(inertia.negative, 1);
  EXPECT_EQ(inertia.first_negative, c.dof(9) + 2);
}

// Nodes joined by equal springs in all directions, tied to nothing: three rigid motions.
TEST(Inertia, CountsRigidMotionsAsZero) {
  BlockTridiagonal a(std::vector<Chain>{{.block = 3, .nodes = 50}});
  const Chain& c = a.chains()[0];
  for (int i = 0; i + 1 < c.nodes; ++i)
    for (int k = 0; k < 3; ++k) {
      const double stiffness = 1.0 + 0.37 * i + 0.11 * k;
      a.D(c, i)[4 * k] += stiffness;
      a.D(c, i + 1)[4 * k] += stiffness;
      a.U(c, i)[4 * k] = a.L(c, i)[4 * k] = -stiffness;
    }
  const Inertia inertia = inertia_of_symmetric_part(a);
  EXPECT_EQ(inertia.negative, 0);
  EXPECT_EQ(inertia.zero, 3);
}

// [0 1; 1 0] has no usable first pivot but no zero eigenvalue either.
TEST(Inertia, OfAZeroPivotWithCouplingIsOnePlusOneMinus) {
  BlockTridiagonal a(std::vector<Chain>{{.block = 3, .nodes = 1}});
  const Chain& c = a.chains()[0];
  a.D(c, 0)[1] = a.D(c, 0)[3] = 1.0;
  a.D(c, 0)[8] = 1.0;
  const Inertia inertia = inertia_of_symmetric_part(a);
  EXPECT_EQ(inertia.negative, 1);
  EXPECT_EQ(inertia.zero, 0);
}

TEST(Inertia, OfNaNIsNeverCalledPositiveDefinite) {
  BlockTridiagonal a = test::random_matrix(Kind::positive_definite, shapes, 3);
  a.D(a.chains()[0], 5)[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_GT(inertia_of_symmetric_part(a).zero, 0);
}

}  // namespace

}  // namespace hawser
