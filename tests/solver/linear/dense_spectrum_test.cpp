// Eigenvalues that are known, and pairs that must satisfy their equation.
#include "solver/linear/dense_spectrum.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace hawser {
namespace {

constexpr int n = 12;
constexpr double rounding = 1e-14 * n;

/// A chain of springs between walls: eigenvalues 2 - 2 cos(k pi/(n+1)).
Eigen::MatrixXd springs() {
  Eigen::MatrixXd A = 2.0 * Eigen::MatrixXd::Identity(n, n);
  for (int i = 0; i + 1 < n; ++i) A(i, i + 1) = A(i + 1, i) = -1.0;
  return A;
}

double frequency(int k) { return 2.0 - 2.0 * std::cos(k * std::numbers::pi / (n + 1)); }

TEST(DenseSpectrum, OfAChainOfSpringsIsTheKnownOneAscending) {
  const Eigen::VectorXd values = symmetric_eigenvalues(springs());
  for (int k = 1; k <= n; ++k) EXPECT_NEAR(values[k - 1], frequency(k), rounding);
}

TEST(DenseSpectrum, CountsTheEigenvaluesBelowZero) {
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(n, n);
  for (int k = 0; k < n; ++k) EXPECT_EQ(negative_eigenvalues(springs() - 0.5 * (frequency(k) + frequency(k + 1)) * one), k);
}

TEST(DenseSpectrum, PairsOfAnUnsymmetricMatrixSatisfyTheirEquation) {
  // A cyclic shift has the n-th roots of one, all but two of them in complex pairs; stretched, its vectors are not orthogonal.
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
  for (int i = 0; i < n; ++i) A((i + 1) % n, i) = 1.0 + 0.5 * (i % 3);
  const Eigenpairs pairs = eigenpairs(A);
  const Eigen::MatrixXcd error = A * pairs.vectors - pairs.vectors * pairs.values.asDiagonal();
  EXPECT_LE(error.cwiseAbs().maxCoeff(), rounding * A.norm());
  double product = 1.0;
  for (int i = 0; i < n; ++i) product *= A((i + 1) % n, i);
  const double modulus = std::pow(product, 1.0 / n);
  const Eigen::VectorXcd alone = eigenvalues(A);
  int complex = 0;
  for (int k = 0; k < n; ++k) {
    EXPECT_NEAR(pairs.vectors.col(k).norm(), 1.0, rounding);
    EXPECT_NEAR(std::abs(pairs.values[k]), modulus, rounding * A.norm());
    EXPECT_LE((alone.array() - pairs.values[k]).abs().minCoeff(), rounding * A.norm());
    complex += std::abs(pairs.values[k].imag()) > rounding * A.norm();
  }
  EXPECT_EQ(complex, n - 2);
}

TEST(DenseSpectrum, OfAMatrixThatIsNotFiniteIsNot) {
  Eigen::MatrixXd A = springs();
  A(3, 2) = NAN;
  EXPECT_TRUE(std::isnan(symmetric_eigenvalues(A)[0]));
  EXPECT_TRUE(std::isnan(eigenvalues(A)[0].real()));
  EXPECT_EQ(negative_eigenvalues(A), 0);
}

}  // namespace
}  // namespace hawser
