#include "assembly/supports.hpp"

#include <algorithm>

namespace hawser {

namespace {

using Block = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;
using BlockMap = Eigen::Map<Block>;

Block projector(const Support& support, int b) {
  Block Q = Block::Identity(b, b);
  if (support.position) Q.topLeftCorner(3, 3).setZero();
  if (b == 6 && support.clamped) Q.bottomRightCorner(3, 3) = support.direction * support.direction.transpose();
  return Q;
}

/// Mean size of the diagonal over rows [first, first + 3).
double diagonal_scale(const BlockMap& D, int first) {
  const double mean = D.diagonal().segment(first, 3).cwiseAbs().mean();
  return mean > 0.0 ? mean : 1.0;
}

}  // namespace

void constrain(const Model& model, const Support& support, BlockTridiagonal& matrix) {
  const Chain& c = model.chain(support.line);
  const int b = c.block, i = support.node;
  const Block Q = projector(support, b);
  const auto map = [b](double* p) { return BlockMap(p, b, b); };
  BlockMap D = map(matrix.D(c, i));
  Block held = Block::Identity(b, b) - Q;
  for (int first = 0; first < b; first += 3) held.middleRows(first, 3) *= diagonal_scale(D, first);
  const Block projected = Q * D * Q;
  D = projected + held;
  if (i + 1 < c.nodes) {
    map(matrix.U(c, i)) = (Q * map(matrix.U(c, i))).eval();
    map(matrix.L(c, i)) = (map(matrix.L(c, i)) * Q).eval();
  }
  if (i > 0) {
    map(matrix.U(c, i - 1)) = (map(matrix.U(c, i - 1)) * Q).eval();
    map(matrix.L(c, i - 1)) = (Q * map(matrix.L(c, i - 1))).eval();
  }
}

void project_support(const Model& model, const Support& support, std::span<double> r) {
  const std::size_t d = model.dof(support.line, support.node);
  if (support.position) std::fill_n(&r[d], 3, 0.0);
  if (!support.clamped || model.chain(support.line).block != 6) return;
  Eigen::Map<Vec3> slope(&r[d + 3]);
  slope = support.direction.dot(slope) * support.direction;
}

}  // namespace hawser
