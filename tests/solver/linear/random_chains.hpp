// Random block-tridiagonal systems for the tests of the linear solvers, and the yardsticks they are judged by.
#pragma once

#include <random>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Dense>

#include "assembly/block_tridiagonal.hpp"

namespace hawser::test {

enum class Kind {
  positive_definite,     // assembled from element matrices B^T B, plus a small multiple of the identity
  symmetric_indefinite,  // symmetric, eigenvalues of both signs, no dominant diagonal
  unsymmetric,           // no structure at all
  badly_scaled,          // unsymmetric, rows scaled by 1e-6 to 1e6
};

std::string name_of(Kind kind);

struct Shape {
  int block;
  int nodes;
};

BlockTridiagonal random_matrix(Kind kind, std::span<const Shape> shapes, unsigned seed);
std::vector<double> random_vector(std::size_t size, unsigned seed);

Eigen::MatrixXd dense(const BlockTridiagonal& matrix);

/// ||A x - b|| / (||A|| ||x|| + ||b||), infinity norms, residual in long double.
double backward_error(const Eigen::MatrixXd& a, std::span<const double> x, std::span<const double> b);

}  // namespace hawser::test
