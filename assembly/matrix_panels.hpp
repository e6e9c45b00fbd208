// MatrixPanels: a system T x = b, T block tridiagonal (block_tridiagonal.hpp), made a panel of consecutive nodes at a time, so that a solver can
// eliminate rows while they are in the cache and T is never stored.
// Panels: panel.hpp.
#pragma once

#include "assembly/block_tridiagonal.hpp"
#include "assembly/panel.hpp"

namespace hawser {

class MatrixPanels {
 public:
  virtual ~MatrixPanels() = default;

  virtual Symmetry symmetry() const { return Symmetry::unknown; }

  /// Writes D, U, L of a panel's nodes, one behind the other, and their entries of b. Each panel once, in any order, by any thread. At the
  /// first node the share of the panel before is missing.
  virtual void make(int chain, int panel, double* values) = 0;

  /// Adds what a panel made contributes to the first node of the next one: to that node's D (given) and b. Once, after both were made.
  virtual void add_carry(int chain, int panel, double* D_next) = 0;

  /// The whole matrix at once, and b anew.
  virtual const BlockTridiagonal& whole() = 0;
};

}  // namespace hawser
