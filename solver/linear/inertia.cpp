// Inertia of the symmetric part S = (A + A^T)/2 by L D L^T without exchange of rows, two nodes of a chain at a time (Sylvester's law).
#include <algorithm>
#include <array>
#include <cmath>

#include "solver/linear/linear_solver.hpp"

namespace hawser {

namespace {

constexpr double zero_pivot = 1e-14;  // of the largest diagonal entry
constexpr int max_block = 7;

// Lower triangle of the two nodes at work: the first is eliminated, the second moves up.
class Window {
 public:
  explicit Window(int block) : block_(block) {}

  void load_diagonal(const double* d, int at) {
    for (int j = 0; j < block_; ++j)
      for (int i = j; i < block_; ++i) entry(at + i, at + j) = 0.5 * (d[i + block_ * j] + d[j + block_ * i]);
  }
  void load_coupling(const double* upper, const double* lower) {
    for (int j = 0; j < block_; ++j)
      for (int i = 0; i < block_; ++i) entry(block_ + i, j) = 0.5 * (lower[i + block_ * j] + upper[j + block_ * i]);
  }
  void move_up() {
    for (int j = 0; j < block_; ++j)
      for (int i = j; i < block_; ++i) entry(i, j) = entry(block_ + i, block_ + j);
  }

  /// Eliminates unknown k from the `size` unknowns at work and returns its pivot, 0 for one that has none.
  double eliminate(int k, int size, double smallest) {
    double pivot = entry(k, k), coupling = 0.0;
    for (int i = k + 1; i < size; ++i) coupling = std::max(coupling, std::abs(entry(i, k)));
    if (!std::isfinite(pivot)) return 0.0;
    if (std::abs(pivot) <= smallest) {
      if (coupling <= smallest) return 0.0;
      pivot = smallest;  // coupled to what follows: one eigenvalue of either sign, and the pivot to come carries the minus
    }
    for (int j = k + 1; j < size; ++j) {
      const double multiplier = entry(j, k) / pivot;
      for (int i = j; i < size; ++i) entry(i, j) -= entry(i, k) * multiplier;
    }
    return pivot;
  }

 private:
  double& entry(int i, int j) { return values_[i + 2 * max_block * j]; }

  int block_;
  std::array<double, 4 * max_block * max_block> values_{};
};

double largest_diagonal(const BlockTridiagonal& matrix) {
  double largest = 0.0;
  for (const Chain& c : matrix.chains())
    for (int i = 0; i < c.nodes; ++i)
      for (int k = 0; k < c.block; ++k) largest = std::max(largest, std::abs(matrix.D(c, i)[k * (c.block + 1)]));
  return largest;
}

}  // namespace

Inertia inertia_of_symmetric_part(const BlockTridiagonal& matrix) {
  const double smallest = zero_pivot * largest_diagonal(matrix);
  Inertia inertia;
  for (const Chain& c : matrix.chains()) {
    Window window(c.block);
    for (int node = 0; node < c.nodes; ++node) {
      const bool last = node + 1 == c.nodes;
      if (node == 0) window.load_diagonal(matrix.D(c, 0), 0);
      if (!last) {
        window.load_coupling(matrix.U(c, node), matrix.L(c, node));
        window.load_diagonal(matrix.D(c, node + 1), c.block);
      }
      for (int k = 0; k < c.block; ++k) {
        const double pivot = window.eliminate(k, last ? c.block : 2 * c.block, smallest);
        if (pivot < 0.0 && inertia.negative++ == 0) inertia.first_negative = c.dof(node) + k;
        if (pivot == 0.0) ++inertia.zero;
      }
      window.move_up();
    }
  }
  return inertia;
}

}  // namespace hawser
