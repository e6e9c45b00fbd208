// Forward and backward substitution by two fronts, for chain_kernel_body.hpp; and where the fronts find their blocks.
#pragma once

#include "solver/linear/chain_kernel.hpp"
#include "solver/linear/chain_kernel_columns.hpp"

namespace hawser {

namespace {

// Places are those of a node's D. In values a front counts blocks from there towards the middle: U or L of the front's own row after one, the other
// coupling after two, the next node's D after three; in memory the right front meets them backwards.
template <Front Side>
constexpr int nodes_of(int nodes) {
  return Side == Front::left ? nodes / 2 : nodes - 1 - nodes / 2;
}
/// The front's node k, counted from its end.
template <Front Side>
constexpr int node_of(int nodes, int k) {
  return Side == Front::left ? k : nodes - 1 - k;
}

template <Front Side, class T>
HAWSER_INLINE T* inwards(T* p, long n) {
  return Side == Front::left ? p + n : p - n;
}

// Where factors lie (chain_kernel.hpp): places in the chain, and from a node's D.
template <int B, Factors F>
struct Layout {
  static constexpr bool symmetric = F == Factors::ldlt, spent = F == Factors::spent_lu;
  static constexpr bool in_place = F == Factors::lu;  // what is left of D_k waits where L_k\U_k will be
  static constexpr int block = B * B, upper = Panel<B, 2>::upper_size, node = in_place ? 3 * block : symmetric ? 2 * block : upper + block;
  static constexpr long at(int k) { return static_cast<long>(node) * k; }
  // L\U of the middle node is needed whole.
  static constexpr bool middle_apart = spent && upper < block;
  static constexpr long middle(int nodes) { return at(middle_apart ? nodes : nodes / 2); }
  static constexpr long behind(int nodes) { return at(nodes) + (middle_apart ? block : 0); }
  static constexpr long left_at_middle(int nodes) {
    return in_place ? at(nodes - 1) + block : symmetric ? at(nodes / 2) + block : behind(nodes) + 2 * block;
  }
  // X of the nodes beside the middle one.
  static constexpr long left_column(int nodes) { return spent ? behind(nodes) : at(nodes / 2) - block; }
  static constexpr long right_column(int nodes) {
    return spent ? behind(nodes) + block : symmetric ? at(nodes / 2 + 1) + block : at(nodes / 2) + block;
  }

  template <Front Side>
  static constexpr int row = spent                             ? upper
                             : in_place&& Side == Front::right ? -block
                                                               : block;  // Y
  template <Front Side>
  static constexpr int column = symmetric              ? block
                                : Side == Front::right ? -2 * block
                                                       : 2 * block;  // X, where it is kept
};

// Processors fetch ahead by themselves of loads that go up, hardly of those that go down. Measured: nodes ahead.
constexpr int fetched_ahead_to_factorize = 3, fetched_ahead_to_solve = 8;
template <int Bytes, bool ToWrite>
HAWSER_INLINE void prefetch(const double* p) {
  HAWSER_UNROLL for (int line = 0; line < (Bytes + 63) / 64; ++line) __builtin_prefetch(reinterpret_cast<const char*>(p) + 64 * line, ToWrite, 3);
}

template <int B>
HAWSER_INLINE void subtract_product(Column<B>& c, const double* block, const double* z) {
  HAWSER_UNROLL for (int j = 0; j < B; ++j) c.subtract(Panel<B, 2>::factor_column(block, j), z[j]);
}

template <int B>
HAWSER_INLINE void solve_lower(const double* diagonal, double* z) {
  HAWSER_UNROLL for (int j = 0; j < B; ++j) { HAWSER_UNROLL for (int i = j + 1; i < B; ++i) z[i] -= diagonal[Panel<B, 2>::place(i, j)] * z[j]; }
}

template <int B, bool ByItself>
HAWSER_INLINE void solve_upper(const double* diagonal, double* z) {
  const auto u = [&](int i, int j) __attribute__((always_inline)) {
    return diagonal[ByItself ? Panel<B, 2>::upper_place(i, j) : Panel<B, 2>::place(i, j)];
  };
  HAWSER_UNROLL for (int j = B - 1; j > 0; --j) { HAWSER_UNROLL for (int i = 0; i < j; ++i) z[i] -= u(i, j) * z[j]; }
  HAWSER_UNROLL for (int j = 0; j < B; ++j) z[j] *= u(j, j);
}

// The two factors of Delta L^T: rows divided by pivots, then the columns of L again.
template <int B>
HAWSER_INLINE void divide_by_pivots(const double* diagonal, double* z) {
  HAWSER_UNROLL for (int j = 0; j < B; ++j) z[j] *= diagonal[Panel<B, 2>::place(j, j)];
}
template <int B>
HAWSER_INLINE void solve_lower_transposed(const double* diagonal, double* z) {
  HAWSER_UNROLL for (int j = B - 1; j > 0; --j) { HAWSER_UNROLL for (int i = 0; i < j; ++i) z[i] -= diagonal[Panel<B, 2>::place(j, i)] * z[j]; }
}

// One front of a solve. The products with X_k and Y_k go in packs; the triangles, bound by the latency from unknown to unknown, in scalars.
template <int B, Front Side, Factors F>
struct Substitution {
  using At = Layout<B, F>;
  static constexpr int towards_middle = Side == Front::left ? 1 : -1;
  const double* diagonal = nullptr;
  double* b = nullptr;
  double z[B] = {};  // of the node before

  HAWSER_INLINE void start_at(int node, const double* factors, double* chain_b) {
    diagonal = factors + At::at(node), b = chain_b + static_cast<long>(B) * node;
  }
  HAWSER_INLINE void fetch_ahead(int direction) {
    if (direction < 0) prefetch<8 * At::node, false>(diagonal + direction * fetched_ahead_to_solve * At::node);
  }
  HAWSER_INLINE void move(int nodes) { diagonal += At::node * nodes, b += B * nodes; }

  HAWSER_INLINE void forward() {
    Column<B> c;
    c.load(b);
    subtract_product<B>(c, diagonal + At::template column<Side> - towards_middle * At::node, z);
    end_forward(c);
  }
  HAWSER_INLINE void end_forward(const Column<B>& c) {
    HAWSER_UNROLL for (int i = 0; i < B; ++i) z[i] = c.at(i);
    solve_lower<B>(diagonal, z);
    HAWSER_UNROLL for (int i = 0; i < B; ++i) b[i] = z[i];
    fetch_ahead(towards_middle);
    move(towards_middle);
  }
  HAWSER_INLINE void backward() {
    Column<B> c;
    if constexpr (At::symmetric) {
      c.gather(z);
      HAWSER_UNROLL for (int i = 0; i < B; ++i) z[i] = b[i];
      divide_by_pivots<B>(diagonal, z);
      Panel<B, 2>::subtract_transposed(z, diagonal + At::template column<Side>, c);
      solve_lower_transposed<B>(diagonal, z);
    } else {
      c.load(b);
      subtract_product<B>(c, diagonal + At::template row<Side>, z);
      HAWSER_UNROLL for (int i = 0; i < B; ++i) z[i] = c.at(i);
      solve_upper<B, At::spent>(diagonal, z);
    }
    HAWSER_UNROLL for (int i = 0; i < B; ++i) b[i] = z[i];
    fetch_ahead(-towards_middle);
    move(-towards_middle);
  }
  /// Before the run's first node, after which it goes on; an end node is met here.
  HAWSER_INLINE void begin_forward(int nodes, FrontRun& run, const double* factors, double* chain_b) {
    if (run.count == 0) return;
    start_at(node_of<Side>(nodes, run.first), factors, chain_b);
    if (run.first > 0) {
      HAWSER_UNROLL for (int i = 0; i < B; ++i) z[i] = b[i - towards_middle * B];
    } else {
      Column<B> c;
      c.load(b);
      end_forward(c);
      --run.count;
    }
  }
  HAWSER_INLINE void start_backward(int nodes, const double* factors, double* chain_b) {
    start_at(nodes / 2, factors, chain_b);
    HAWSER_UNROLL for (int i = 0; i < B; ++i) z[i] = b[i];
    move(-towards_middle);
  }
};

/// Both fronts in turn as far as both go.
template <int B, Factors F>
void forward_runs(int nodes, FrontRun left_run, FrontRun right_run, const double* factors, double* b) {
  Substitution<B, Front::left, F> left;
  Substitution<B, Front::right, F> right;
  left.begin_forward(nodes, left_run, factors, b), right.begin_forward(nodes, right_run, factors, b);
  for (; left_run.count > 0 && right_run.count > 0; --left_run.count, --right_run.count) left.forward(), right.forward();
  for (; left_run.count > 0; --left_run.count) left.forward();
  for (; right_run.count > 0; --right_run.count) right.forward();
}

template <int B, Factors F>
void solve_middle_node(int nodes, const double* factors, double* b) {
  using At = Layout<B, F>;
  const double* diagonal = factors + At::middle(nodes);
  b += static_cast<long>(B) * (nodes / 2);
  Column<B> c;
  c.load(b);
  if (nodes > 1) subtract_product<B>(c, factors + At::left_column(nodes), b - B);
  if (nodes > 2) subtract_product<B>(c, factors + At::right_column(nodes), b + B);
  c.store(b);
  solve_lower<B>(diagonal, b);
  if constexpr (At::symmetric)
    divide_by_pivots<B>(diagonal, b), solve_lower_transposed<B>(diagonal, b);
  else
    solve_upper<B, false>(diagonal, b);
}

template <int B, Front Side, Factors F>
void backward_front(int nodes, const double* factors, double* b) {
  Substitution<B, Side, F> front;
  front.start_backward(nodes, factors, b);
  for (int k = nodes_of<Side>(nodes); k > 0; --k) front.backward();
}

template <int B, Factors F>
void backward_both(int nodes, const double* factors, double* b) {
  const int pairs = nodes_of<Front::right>(nodes);
  Substitution<B, Front::left, F> left;
  Substitution<B, Front::right, F> right;
  left.start_backward(nodes, factors, b), right.start_backward(nodes, factors, b);
  for (int k = 0; k < pairs; ++k) left.backward(), right.backward();
  if (pairs < nodes_of<Front::left>(nodes)) left.backward();
}

}  // namespace

}  // namespace hawser
