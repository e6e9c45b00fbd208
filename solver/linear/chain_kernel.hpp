// Unpivoted LU of one block-tridiagonal chain, in linear time: point elimination in block clothing.
//
//   D_k = L_k U_k   (unit lower, upper)      Y_k = L_k^-1 U(k, k+1)      X_k = L(k+1, k) U_k^-1      D_{k+1} -= X_k Y_k
//
// These are the numbers of scalar Gaussian elimination, only grouped, so the backward error is of the order of the unit roundoff times
// the growth of the entries (Golub & Van Loan, Matrix Computations, 4th ed., sections 3.3 and 4.5). The textbook form W_k = D_k^-1 U(k, k+1)
// solves with each D_k by itself and loses as many digits as D_k is ill conditioned.
//
// Values are laid out as in BlockTridiagonal: D, U, L of a node, column-major. The factors of a node take the same room in the order
// L_k\U_k (reciprocal pivots on the diagonal), Y_k, X_k.
#pragma once

#include <limits>
#include <span>

namespace hawser {

/// What the elimination tells of its own accuracy.
struct PivotWatch {
  double smallest = std::numeric_limits<double>::infinity();  // pivots, absolute
  double largest = 0.0;
  double growth_squared = 0.0;  // largest over the nodes: (Frobenius norm of the worked [L_k U_k, Y_k] / that of [D_k, U(k, k+1)])^2
  double not_finite = 0.0;      // NaN as soon as a pivot is not finite, else zero
  int negative = 0;             // pivots
};

struct ChainKernel {
  void (*factorize)(int block, int nodes, const double* values, double* factors, PivotWatch& watch);
  void (*solve)(int block, int nodes, const double* factors, double* b);
  const char* instruction_set;
};

extern const ChainKernel baseline_chain_kernel, avx2_chain_kernel, avx512_chain_kernel;

/// The kernels this processor can run, fastest first.
std::span<const ChainKernel* const> chain_kernels();

}  // namespace hawser
