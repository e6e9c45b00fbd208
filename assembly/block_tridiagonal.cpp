#include "assembly/block_tridiagonal.hpp"

#include <algorithm>
#include <cmath>

namespace hawser {

BlockTridiagonal::BlockTridiagonal(std::vector<Chain> chains) : chains_(std::move(chains)) {
  std::size_t value = 0;
  for (Chain& c : chains_) {
    c.first_dof = dofs_;
    c.first_value = value;
    dofs_ += c.dofs();
    value += std::size_t{3} * c.block * c.block * c.nodes;
  }
  values_.assign(value, 0.0);
}

void BlockTridiagonal::set_zero() { std::fill(values_.begin(), values_.end(), 0.0); }

namespace {

void add_product(int n, const double* a, const double* x, double* y) {
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) y[i] += a[i + n * j] * x[j];
}

}  // namespace

void BlockTridiagonal::multiply(std::span<const double> x, std::span<double> y) const {
  std::fill(y.begin(), y.end(), 0.0);
  for (const Chain& c : chains_)
    for (int i = 0; i < c.nodes; ++i) {
      add_product(c.block, D(c, i), &x[c.dof(i)], &y[c.dof(i)]);
      if (i + 1 == c.nodes) continue;
      add_product(c.block, U(c, i), &x[c.dof(i + 1)], &y[c.dof(i)]);
      add_product(c.block, L(c, i), &x[c.dof(i)], &y[c.dof(i + 1)]);
    }
}

void BlockTridiagonal::symmetrize() {
  for (const Chain& c : chains_) {
    const int n = c.block;
    for (int i = 0; i < c.nodes; ++i) {
      double *d = D(c, i), *u = U(c, i), *l = L(c, i);
      for (int col = 0; col < n; ++col)
        for (int row = 0; row < n; ++row) {
          if (row < col) d[row + n * col] = d[col + n * row] = 0.5 * (d[row + n * col] + d[col + n * row]);
          u[row + n * col] = l[col + n * row] = 0.5 * (u[row + n * col] + l[col + n * row]);
        }
    }
  }
}

double BlockTridiagonal::asymmetry() const {
  double difference = 0.0, largest = 0.0;
  for (const Chain& c : chains_) {
    const int n = c.block;
    for (int i = 0; i < c.nodes; ++i) {
      const double *d = D(c, i), *u = U(c, i), *l = L(c, i);
      for (int col = 0; col < n; ++col)
        for (int row = 0; row < n; ++row) {
          difference = std::max({difference, std::abs(d[row + n * col] - d[col + n * row]), std::abs(u[row + n * col] - l[col + n * row])});
          largest = std::max({largest, std::abs(d[row + n * col]), std::abs(u[row + n * col])});
        }
    }
  }
  return largest > 0.0 ? difference / largest : 0.0;
}

}  // namespace hawser
