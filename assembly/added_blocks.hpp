// AddedBlocks: where loads beside the sweep (joints, bodies, contact) add their blocks: to a whole matrix, or to one of which only the nodes
// touched here hold anything (the rest is never read, nor brought into the cache).
#pragma once

#include <algorithm>
#include <vector>

#include "assembly/block_tridiagonal.hpp"

namespace hawser {

class AddedBlocks {
 public:
  explicit AddedBlocks(BlockTridiagonal& matrix) : matrix_(matrix) {}

  /// Zeroes the blocks of a node when it is first touched, and marks it. touched: place() of a node -> bool.
  AddedBlocks(BlockTridiagonal& matrix, std::vector<char>& touched) : matrix_(matrix), touched_(&touched) {}

  static std::size_t place(const Chain& c, int node) { return c.dof(node) / 3; }

  double* D(const Chain& c, int node) { return touch(c, node), matrix_.D(c, node); }
  double* U(const Chain& c, int node) { return touch(c, node), matrix_.U(c, node); }
  double* L(const Chain& c, int node) { return touch(c, node), matrix_.L(c, node); }

 private:
  void touch(const Chain& c, int node) {
    if (!touched_ || (*touched_)[place(c, node)]) return;
    (*touched_)[place(c, node)] = 1;
    std::fill_n(matrix_.D(c, node), 3 * c.block * c.block, 0.0);
  }

  BlockTridiagonal& matrix_;
  std::vector<char>* touched_ = nullptr;
};

}  // namespace hawser
