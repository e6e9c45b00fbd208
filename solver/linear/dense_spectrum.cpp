#include "solver/linear/dense_spectrum.hpp"

#include <lapacke.h>

#include <complex>
#include <limits>

namespace hawser {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// dgeev; `vectors` may be null. Columns k and k+1 of a complex pair hold the real and the imaginary part of its first vector.
Eigen::VectorXcd general(Eigen::MatrixXd& A, Eigen::MatrixXd* vectors) {
  const auto n = static_cast<lapack_int>(A.rows());
  Eigen::VectorXd real(n), imaginary(n);
  double none = 0.0;
  const lapack_int failed = LAPACKE_dgeev(LAPACK_COL_MAJOR, 'N', vectors ? 'V' : 'N', n, A.data(), n, real.data(), imaginary.data(), &none, 1,
                                          vectors ? vectors->data() : &none, vectors ? n : 1);
  if (failed != 0) real.setConstant(nan);
  Eigen::VectorXcd values(n);
  values.real() = real;
  values.imag() = imaginary;
  return values;
}

}  // namespace

Eigen::VectorXd symmetric_eigenvalues(Eigen::MatrixXd A) {
  const auto n = static_cast<lapack_int>(A.rows());
  Eigen::VectorXd values(n);
  if (n > 0 && LAPACKE_dsyevd(LAPACK_COL_MAJOR, 'N', 'L', n, A.data(), n, values.data()) != 0) values.setConstant(nan);
  return values;
}

int negative_eigenvalues(const Eigen::MatrixXd& symmetric) { return static_cast<int>((symmetric_eigenvalues(symmetric).array() < 0.0).count()); }

Eigen::VectorXcd eigenvalues(Eigen::MatrixXd A) { return general(A, nullptr); }

Eigenpairs eigenpairs(Eigen::MatrixXd A) {
  Eigen::MatrixXd parts(A.rows(), A.cols());
  Eigenpairs pairs{general(A, &parts), parts.cast<std::complex<double>>()};
  for (Eigen::Index k = 0; k + 1 < parts.cols(); ++k) {
    if (pairs.values[k].imag() <= 0.0) continue;
    pairs.vectors.col(k).imag() = parts.col(k + 1);
    pairs.vectors.col(k + 1) = pairs.vectors.col(k).conjugate();
  }
  return pairs;
}

}  // namespace hawser
