#include "solver/linear/refinement.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace hawser {

namespace {

/// r -= A x and size += |A| |x| of one block.
void add_block(int n, const double* a, const double* x, double* r, double* size) {
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const double product = a[i + n * j] * x[j];
      r[i] -= product;
      size[i] += std::abs(product);
    }
}

}  // namespace

Refinement::Refinement(const BlockTridiagonal& pattern) : residual_(pattern.dofs()), size_(pattern.dofs()), improved_(pattern.dofs()) {}

double Refinement::look(const BlockTridiagonal& matrix, std::span<const double> b, std::span<const double> x) {
  for (std::size_t i = 0; i < b.size(); ++i) residual_[i] = b[i], size_[i] = std::abs(b[i]);
  for (const Chain& c : matrix.chains())
    for (int i = 0; i < c.nodes; ++i) {
      const std::size_t here = c.dof(i), next = c.dof(i + 1);
      add_block(c.block, matrix.D(c, i), &x[here], &residual_[here], &size_[here]);
      if (i + 1 == c.nodes) continue;
      add_block(c.block, matrix.U(c, i), &x[next], &residual_[here], &size_[here]);
      add_block(c.block, matrix.L(c, i), &x[here], &residual_[next], &size_[next]);
    }
  double omega = 0.0;
  for (std::size_t i = 0; i < b.size(); ++i)
    if (residual_[i] != 0.0) omega = std::max(omega, std::abs(residual_[i]) / size_[i]);
  return omega;
}

Refinement::BackwardErrors Refinement::improve(const BlockTridiagonal& matrix, LinearSolver& factorized, std::span<const double> b,
                                               std::span<double> x) {
  assert(matrix.dofs() == residual_.size() && b.size() == x.size());
  BackwardErrors errors;
  errors.before = errors.after = look(matrix, b, x);
  factorized.solve(residual_);
  for (std::size_t i = 0; i < x.size(); ++i) improved_[i] = x[i] + residual_[i];
  const double improved = look(matrix, b, improved_);
  if (!(improved < errors.before)) return errors;
  errors.after = improved;
  std::copy(improved_.begin(), improved_.end(), x.begin());
  return errors;
}

}  // namespace hawser
