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

/// omega(x); leaves b - A x in residual and |A| |x| + |b| in size.
double judge(const BlockTridiagonal& matrix, std::span<const double> x, std::span<const double> b, std::span<double> residual,
             std::span<double> size) {
  for (std::size_t i = 0; i < b.size(); ++i) residual[i] = b[i], size[i] = std::abs(b[i]);
  for (const Chain& c : matrix.chains())
    for (int i = 0; i < c.nodes; ++i) {
      const std::size_t here = c.dof(i), next = c.dof(i + 1);
      add_block(c.block, matrix.D(c, i), &x[here], &residual[here], &size[here]);
      if (i + 1 == c.nodes) continue;
      add_block(c.block, matrix.U(c, i), &x[next], &residual[here], &size[here]);
      add_block(c.block, matrix.L(c, i), &x[here], &residual[next], &size[next]);
    }
  double omega = 0.0;
  for (std::size_t i = 0; i < b.size(); ++i)
    if (residual[i] != 0.0) omega = std::max(omega, std::abs(residual[i]) / size[i]);
  return omega;
}

}  // namespace

double backward_error(const BlockTridiagonal& matrix, std::span<const double> x, std::span<const double> b) {
  std::vector<double> residual(b.size()), size(b.size());
  return judge(matrix, x, b, residual, size);
}

Refinement::Refinement(const BlockTridiagonal& pattern) : residual_(pattern.dofs()), size_(pattern.dofs()), improved_(pattern.dofs()) {}

Refinement::BackwardErrors Refinement::improve(const BlockTridiagonal& matrix, LinearSolver& factorized, std::span<const double> b,
                                               std::span<double> x) {
  assert(matrix.dofs() == residual_.size() && b.size() == x.size());
  BackwardErrors errors;
  errors.before = errors.after = judge(matrix, x, b, residual_, size_);
  factorized.solve(residual_);
  for (std::size_t i = 0; i < x.size(); ++i) improved_[i] = x[i] + residual_[i];
  const double improved = judge(matrix, improved_, b, residual_, size_);
  if (!(improved < errors.before)) return errors;
  errors.after = improved;
  std::copy(improved_.begin(), improved_.end(), x.begin());
  return errors;
}

}  // namespace hawser
