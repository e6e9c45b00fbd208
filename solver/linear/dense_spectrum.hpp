// Eigenvalues of small dense matrices, by LAPACK (dsyevd, dgeev). Where it fails, as on a matrix that is not finite, they are NaN.
#pragma once

#include <Eigen/Core>

namespace hawser {

/// Ascending. The lower triangle is read.
Eigen::VectorXd symmetric_eigenvalues(Eigen::MatrixXd A);
int negative_eigenvalues(const Eigen::MatrixXd& symmetric);

/// In no order.
Eigen::VectorXcd eigenvalues(Eigen::MatrixXd A);

/// With the right eigenvectors, columns of length 1.
struct Eigenpairs {
  Eigen::VectorXcd values;
  Eigen::MatrixXcd vectors;
};
Eigenpairs eigenpairs(Eigen::MatrixXd A);

}  // namespace hawser
