// A stored system as panels (assembly/matrix_panels.hpp).
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "assembly/matrix_panels.hpp"

namespace hawser::test {

/// A share of every panel's first D and b comes with the panel before.
class StoredPanels final : public MatrixPanels {
 public:
  /// A power of two is added back to numbers of its size as if it had never left.
  StoredPanels(const BlockTridiagonal& matrix, std::vector<double> b, std::span<double> out, double carried = 0.25)
      : matrix_(matrix), b_(std::move(b)), out_(out), carried_(carried) {}

  void make(int chain, int panel, double* values) override {
    const Chain& c = matrix_.chains()[chain];
    const int first = first_node_of_panel(panel), nodes = nodes_of_panel(panel, c.nodes), size = c.block * c.block;
    std::copy_n(matrix_.D(c, first), 3 * size * nodes, values);
    if (panel > 0) values[0] -= carried_;
    std::copy_n(&b_[c.dof(first)], c.block * nodes, &out_[c.dof(first)]);
    if (panel > 0) out_[c.dof(first)] -= carried_;
  }
  void add_carry(int chain, int panel, double* D_next) override {
    D_next[0] += carried_;
    const Chain& c = matrix_.chains()[chain];
    out_[c.dof(first_node_of_panel(panel + 1))] += carried_;
  }
  Symmetry symmetry() const override { return matrix_.symmetry(); }
  const BlockTridiagonal& whole() override {
    std::copy(b_.begin(), b_.end(), out_.begin());
    return matrix_;
  }

 private:
  const BlockTridiagonal& matrix_;
  std::vector<double> b_;
  std::span<double> out_;
  double carried_;
};

}  // namespace hawser::test
