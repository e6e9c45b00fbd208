#include "tests/solver/linear/random_chains.hpp"

#include <cmath>

namespace hawser::test {

namespace {

using Random = std::mt19937;

double uniform(Random& random) { return std::uniform_real_distribution<double>(-1.0, 1.0)(random); }

// B^T B of an element between two nodes, B of 2 block rows: rank 2 block, as full elements have once supported.
void add_element(BlockTridiagonal& matrix, const Chain& c, int i, Random& random) {
  const int n = c.block;
  const Eigen::MatrixXd b = Eigen::MatrixXd::NullaryExpr(2 * n, 2 * n, [&] { return uniform(random); });
  const Eigen::MatrixXd k = b.transpose() * b;
  const auto block = [n](double* p) { return Eigen::Map<Eigen::MatrixXd>(p, n, n); };
  block(matrix.D(c, i)) += k.topLeftCorner(n, n);
  block(matrix.D(c, i + 1)) += k.bottomRightCorner(n, n);
  block(matrix.U(c, i)) += k.topRightCorner(n, n);
  block(matrix.L(c, i)) += k.bottomLeftCorner(n, n);
}

void fill_positive_definite(BlockTridiagonal& matrix, Random& random) {
  for (const Chain& c : matrix.chains()) {
    for (int i = 0; i + 1 < c.nodes; ++i) add_element(matrix, c, i, random);
    for (int i = 0; i < c.nodes; ++i)
      for (int k = 0; k < c.block; ++k) matrix.D(c, i)[k * (c.block + 1)] += 1e-3;
  }
}

void fill_unsymmetric(BlockTridiagonal& matrix, Random& random) {
  for (const Chain& c : matrix.chains())
    for (int i = 0; i < c.nodes; ++i)
      for (int k = 0; k < c.block * c.block; ++k) {
        matrix.D(c, i)[k] = uniform(random);
        if (i + 1 == c.nodes) continue;
        matrix.U(c, i)[k] = uniform(random);
        matrix.L(c, i)[k] = uniform(random);
      }
}

void scale_rows(BlockTridiagonal& matrix, Random& random) {
  for (const Chain& c : matrix.chains())
    for (int i = 0; i < c.nodes; ++i)
      for (int row = 0; row < c.block; ++row) {
        const double scale = std::pow(10.0, 6.0 * uniform(random));
        for (int k = row; k < c.block * c.block; k += c.block) {
          matrix.D(c, i)[k] *= scale;
          matrix.U(c, i)[k] *= scale;
          if (i > 0) matrix.L(c, i - 1)[k] *= scale;
        }
      }
}

}  // namespace

std::string name_of(Kind kind) {
  switch (kind) {
    case Kind::positive_definite:
      return "positive_definite";
    case Kind::symmetric_indefinite:
      return "symmetric_indefinite";
    case Kind::unsymmetric:
      return "unsymmetric";
    case Kind::badly_scaled:
      return "badly_scaled";
  }
  return {};
}

BlockTridiagonal random_matrix(Kind kind, std::span<const Shape> shapes, unsigned seed) {
  std::vector<Chain> chains;
  for (const Shape& s : shapes) chains.push_back({.block = s.block, .nodes = s.nodes});
  BlockTridiagonal matrix(chains);
  Random random(seed);
  if (kind == Kind::positive_definite)
    fill_positive_definite(matrix, random);
  else
    fill_unsymmetric(matrix, random);
  if (kind == Kind::symmetric_indefinite) matrix.symmetrize();
  if (kind == Kind::badly_scaled) scale_rows(matrix, random);
  return matrix;
}

std::vector<double> random_vector(std::size_t size, unsigned seed) {
  Random random(seed);
  std::vector<double> v(size);
  for (double& x : v) x = uniform(random);
  return v;
}

Eigen::MatrixXd dense(const BlockTridiagonal& matrix) {
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(matrix.dofs(), matrix.dofs());
  for (const Chain& c : matrix.chains()) {
    const int n = c.block;
    const auto block = [n](const double* p) { return Eigen::Map<const Eigen::MatrixXd>(p, n, n); };
    for (int i = 0; i < c.nodes; ++i) {
      a.block(c.dof(i), c.dof(i), n, n) = block(matrix.D(c, i));
      if (i + 1 == c.nodes) continue;
      a.block(c.dof(i), c.dof(i + 1), n, n) = block(matrix.U(c, i));
      a.block(c.dof(i + 1), c.dof(i), n, n) = block(matrix.L(c, i));
    }
  }
  return a;
}

double backward_error(const Eigen::MatrixXd& a, std::span<const double> x, std::span<const double> b) {
  using Vector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;
  const Vector wide_x = Eigen::Map<const Eigen::VectorXd>(x.data(), x.size()).cast<long double>();
  const Vector wide_b = Eigen::Map<const Eigen::VectorXd>(b.data(), b.size()).cast<long double>();
  const long double residual = (a.cast<long double>() * wide_x - wide_b).cwiseAbs().maxCoeff();
  const long double norm = a.cwiseAbs().rowwise().sum().maxCoeff();
  return static_cast<double>(residual / (norm * wide_x.cwiseAbs().maxCoeff() + wide_b.cwiseAbs().maxCoeff()));
}

}  // namespace hawser::test
