// BlockTridiagonal: the one assembled form of every tangent (architecture rule 12).
//
//   row i of a chain:   L[i-1] x[i-1] + D[i] x[i] + U[i] x[i+1] = b[i]
//
// A chain is one line's nodes, numbered along it. D[i], U[i] (row i, column i+1) and L[i] (row i+1, column i) are
// block x block, column-major and stored one behind the other, 3 block^2 doubles a node; U and L of a chain's last
// node are zero. Chains do not couple. Vectors hold the chains one after the other, block doubles a node.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "assembly/aligned.hpp"

namespace hawser {

struct Chain {
  int block = 6;  // unknowns a node: 3 (bar), 6 (cable, beam) or 7 (with a twist)
  int nodes = 0;
  std::size_t first_dof = 0;    // of node 0 in a vector of unknowns
  std::size_t first_value = 0;  // of D[0] in values()

  std::size_t dof(int node) const { return first_dof + static_cast<std::size_t>(block) * node; }
  std::size_t dofs() const { return static_cast<std::size_t>(block) * nodes; }
};

/// What is known of a matrix beforehand. A solver may read one triangle only of a symmetric one.
enum class Symmetry { unknown, symmetric };

class BlockTridiagonal {
 public:
  BlockTridiagonal() = default;

  /// Lays out the values of these chains; first_dof and first_value are set here.
  explicit BlockTridiagonal(std::vector<Chain> chains);

  std::span<const Chain> chains() const { return chains_; }
  std::size_t dofs() const { return dofs_; }

  double* D(const Chain& c, int i) { return at(c, i, 0); }
  double* U(const Chain& c, int i) { return at(c, i, 1); }
  double* L(const Chain& c, int i) { return at(c, i, 2); }
  const double* D(const Chain& c, int i) const { return at(c, i, 0); }
  const double* U(const Chain& c, int i) const { return at(c, i, 1); }
  const double* L(const Chain& c, int i) const { return at(c, i, 2); }

  std::span<double> values() { return values_; }
  std::span<const double> values() const { return values_; }

  /// As whoever made the values says; whoever makes them anew says it anew.
  Symmetry symmetry() const { return symmetry_; }
  void declare(Symmetry symmetry) { symmetry_ = symmetry; }

  void set_zero();

  /// y = A x.
  void multiply(std::span<const double> x, std::span<double> y) const;

  /// Replaces A by (A + A^T)/2.
  void symmetrize();

  /// Largest |A - A^T| over the largest |A|: 0 for a symmetric matrix.
  double asymmetry() const;

 private:
  double* at(const Chain& c, int i, int part) {
    return values_.data() + c.first_value + (3 * static_cast<std::size_t>(i) + part) * c.block * c.block;
  }
  const double* at(const Chain& c, int i, int part) const {
    return values_.data() + c.first_value + (3 * static_cast<std::size_t>(i) + part) * c.block * c.block;
  }

  std::vector<Chain> chains_;
  AlignedVector<double> values_;
  std::size_t dofs_ = 0;
  Symmetry symmetry_ = Symmetry::unknown;
};

}  // namespace hawser
