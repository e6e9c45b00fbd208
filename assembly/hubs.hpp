// hubs: free points at which several line ends meet, and the border that they add to the chains.
//
// Every end keeps its place in the vectors of unknowns. With h the position of the hubs and E the matrix that puts it into the r of every end
//   x = y + E h,   y: zero in the r of hub ends,      T x = b, summed over the ends of each hub:
//   [ A  B ] [ y ]   [ Q b   ]       A: the chains with the hub ends held,  Q: zeroes the r of hub ends
//   [ C  D ] [ h ] = [ E^T b ]       B = Q T E,  C = E^T T Q,  D = E^T T E
// A column or row of T at an end reaches over the window of the end: the 2 b unknowns of its node and of the one next to it, which follow each
// other in the chain. A residual is projected by E^T: the force balance of a hub stands at its first end, zeros at the others.
#pragma once

#include <span>
#include <vector>

#include "assembly/block_tridiagonal.hpp"
#include "assembly/model.hpp"

namespace hawser {

/// One line end at a hub. N/m, N.
struct BorderEnd {
  int hub = 0, line = 0;
  std::size_t r = 0;                                          // first unknown of its r
  std::size_t window = 0;                                     // first unknown of its window
  Eigen::Matrix<double, Eigen::Dynamic, 3, 0, 12, 3> column;  // T[window, r]
  Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 12> row;     // T[r, window]
};

struct Border {
  int hubs = 0;
  std::vector<BorderEnd> ends;  // hub by hub, in the order of Model::hubs

  bool empty() const { return ends.empty(); }

  /// Of the symmetric part of the matrix.
  void symmetrize();
};

/// A border with its places; the values are zero.
Border make_border(const Model& model);

/// Moves rows and columns of the hub ends from the assembled chains, supports constrained, into the border: the chains are A then.
void take_border(const Model& model, BlockTridiagonal& matrix, Border& border);

/// r <- E^T r at the first end of every hub, zero at the others.
void project_hubs(const Model& model, std::span<double> r);

}  // namespace hawser
