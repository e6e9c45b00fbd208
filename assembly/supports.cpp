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

void constrain(const Model& model, const Support& support, double* D_at, double* U_at, double* L_at) {
  const int b = model.chain(support.line).block;
  const Block Q = projector(support, b);
  BlockMap D(D_at, b, b), U(U_at, b, b), L(L_at, b, b);
  Block held = Block::Identity(b, b) - Q;
  for (int first = 0; first < b; first += 3) held.middleRows(first, 3) *= diagonal_scale(D, first);
  const Block projected = Q * D * Q;
  D = projected + held;
  if (support.node == 0) {
    U = (Q * U).eval();
    L = (L * Q).eval();
  } else {
    U = (U * Q).eval();
    L = (Q * L).eval();
  }
}

void constrain(const Model& model, const Support& support, BlockTridiagonal& matrix) {
  const Chain& c = model.chain(support.line);
  const int coupling = std::max(support.node - 1, 0);
  constrain(model, support, matrix.D(c, support.node), matrix.U(c, coupling), matrix.L(c, coupling));
}

void project_support(const Model& model, const Support& support, std::span<double> r) {
  const std::size_t d = model.dof(support.line, support.node);
  if (support.position) std::fill_n(&r[d], 3, 0.0);
  if (!support.clamped || model.chain(support.line).block != 6) return;
  Eigen::Map<Vec3> slope(&r[d + 3]);
  slope = support.direction.dot(slope) * support.direction;
}

}  // namespace hawser
