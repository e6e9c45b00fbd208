// Unpivoted LU, or L Delta L^T, of one block-tridiagonal chain from both ends, in linear time: point elimination in block clothing.
//
//   left front    D_k = L_k U_k   Y_k = L_k^-1 U(k, k+1)   X_k = L(k+1, k) U_k^-1   D_{k+1} -= X_k Y_k     k = 0, 1, ... m-1
//   right front   D_k = L_k U_k   Y_k = L_k^-1 L(k, k-1)   X_k = U(k-1, k) U_k^-1   D_{k-1} -= X_k Y_k     k = n-1, n-2, ... m+1
//   middle        D_m = L_m U_m   after both, m = n/2      (L_k unit lower, U_k upper triangular)
//
// These are the numbers of scalar Gaussian elimination in the order of the fronts, only grouped, so the backward error is of the order of the
// unit roundoff times the growth of the entries (Golub & Van Loan, Matrix Computations, 4th ed., sections 3.3 and 4.5). The textbook form
// W_k = D_k^-1 U(k, k+1) solves with each D_k by itself and loses as many digits as D_k is ill conditioned.
//
// The fronts do not depend on each other. One core can take them in turn, so that one works while the other waits; two threads take one each.
// The numbers are the same bits either way.
//
// Of a symmetric matrix D_k = L_k Delta_k L_k^T and X_k Delta_k = Y_k^T: the entries of Delta_k L_k^T and Y_k are columns that are there already.
// Only the diagonal blocks and one coupling of each pair are read (L by the left front, U by the right one), and of a diagonal block only the packs
// of a column that hold entries on or below the diagonal.
//
// Values are laid out as in BlockTridiagonal: D, U, L of a node, column-major. Factors::lu take the same room, block for block: L_k\U_k in
// the place of D_k, Y_k and X_k in the places of the couplings they come from; the order within a block is the kernel's own. The columns of U_k are
// divided by their pivots, and the diagonal holds the reciprocal pivots. U of the last node, unused, carries what the right front leaves at D_m.
// Factors::spent_lu are U_k, as far as its packs hold entries on or above the diagonal, and Y_k, one behind the other; after the last node blocks
// that belong to the middle one: L\U, X of its neighbours and what the right front leaves. Factors::ldlt are L_k\Delta_k and X_k, one behind the
// other; the X of the middle node, unused, carries what the right front leaves at D_m.
#pragma once

#include <limits>
#include <span>

namespace hawser {

/// What the elimination tells of its own accuracy.
struct PivotWatch {
  double smallest = std::numeric_limits<double>::infinity();  // pivots, absolute
  double largest = 0.0;
  double growth_squared = 0.0;  // largest over the nodes: (Frobenius norm of the worked [L_k U_k, Y_k] over that of [D_k, U(k, k+1)])^2, as read
  double not_finite = 0.0;      // NaN as soon as a pivot is not finite, else zero
  int negative = 0;             // pivots

  void add(const PivotWatch& other);
};

enum class Front { left, right, both };

/// What an elimination leaves.
enum class Factors {
  lu,        // for any right-hand side
  spent_lu,  // where b was reduced with it: what its own backward substitution reads, 0.56 to two thirds
  ldlt,      // of a symmetric matrix, for any right-hand side: two thirds as well
};

/// The next nodes of a front, counted from its end of the chain: 0 is the end node. The middle node is not among them.
struct FrontRun {
  int first = 0, count = 0;
  const double* values = nullptr;  // of the node `first`
  double given = 0.0;              // the kernel's, from run to run
};

/// block: 3, 6 or 7 unknowns a node.
struct ChainKernel {
  /// The front or fronts up to the middle node, which `factorize_middle` completes. Not for spent_lu.
  void (*factorize)(int block, int nodes, Factors form, const double* values, double* factors, Front front, PivotWatch& watch);

  /// A run of either front, for values that are made as they are eliminated, and the reduction of their b; a count may be zero. The runs move on:
  /// `first` behind their nodes, `count` to zero.
  void (*eliminate_runs)(int block, int nodes, Factors form, FrontRun& left, FrontRun& right, double* factors, double* b, PivotWatch& watch);

  /// `values`: of the middle node.
  void (*factorize_middle)(int block, int nodes, Factors form, const double* values, double* factors, PivotWatch& watch);

  /// b becomes the solution: forward with both fronts (not for spent_lu), the middle, backward with both fronts.
  void (*forward)(int block, int nodes, Factors form, const double* factors, double* b, Front front);
  void (*solve_middle)(int block, int nodes, Factors form, const double* factors, double* b);
  void (*backward)(int block, int nodes, Factors form, const double* factors, double* b, Front front);

  const char* instruction_set;
};

extern const ChainKernel baseline_chain_kernel, avx2_chain_kernel, avx512_chain_kernel;

/// The kernels this processor can run, fastest first. HAWSER_SIMD=base|avx2 leaves out the wider ones.
std::span<const ChainKernel* const> chain_kernels();

}  // namespace hawser
