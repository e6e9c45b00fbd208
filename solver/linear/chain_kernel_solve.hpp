// Forward and backward substitution by two fronts, for chain_kernel_body.hpp; and where the fronts find their blocks.
#pragma once

#include "solver/linear/chain_kernel.hpp"
#include "solver/linear/chain_kernel_packs.hpp"

namespace hawser {

namespace {

// Where the blocks of a front's node lie, from the first of the four it works on: the right front meets them in the opposite order.
template <int B, Front Side>
struct Blocks {
  static constexpr int block = B * B;
  static constexpr bool left = Side == Front::left;
  static constexpr int diagonal = left ? 0 : 3 * block, row = left ? block : 2 * block, column = left ? 2 * block : block,
                       next = left ? 3 * block : 0;
  static constexpr int step = left ? 3 * block : -3 * block;

  static constexpr int nodes_of(int nodes) { return left ? nodes / 2 : nodes - 1 - nodes / 2; }
  static constexpr long first(int nodes) { return left ? 0 : 3L * block * (nodes - 2); }
  static constexpr long middle(int nodes) { return 3L * block * (nodes / 2); }
  static constexpr long left_at_middle(int nodes) { return 3L * block * (nodes - 1) + block; }
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

template <int B>
HAWSER_INLINE void solve_upper(const double* diagonal, double* z) {
  HAWSER_UNROLL for (int j = B - 1; j > 0; --j) { HAWSER_UNROLL for (int i = 0; i < j; ++i) z[i] -= diagonal[Panel<B, 2>::place(i, j)] * z[j]; }
  HAWSER_UNROLL for (int j = 0; j < B; ++j) z[j] *= diagonal[Panel<B, 2>::place(j, j)];
}

// One front of a solve. The products with X_k and Y_k go in packs; the triangles, bound by the latency from unknown to unknown, in scalars.
template <int B, Front Side>
struct Substitution {
  static constexpr bool left = Side == Front::left;
  static constexpr int block = B * B, towards_middle = left ? 1 : -1;
  const double* diagonal;
  double* b;
  double z[B];  // of the node before

  HAWSER_INLINE void start_at(int node, const double* factors, double* chain_b) {
    diagonal = factors + 3L * block * node, b = chain_b + static_cast<long>(B) * node;
  }
  HAWSER_INLINE void fetch_ahead(int direction) {
    if (direction < 0) prefetch<24 * block, false>(diagonal + direction * fetched_ahead_to_solve * 3 * block);
  }
  HAWSER_INLINE void move(int nodes) { diagonal += 3 * block * nodes, b += B * nodes; }

  template <bool Outermost>
  HAWSER_INLINE void forward() {
    Column<B> c;
    c.load(b);
    if constexpr (!Outermost) subtract_product<B>(c, diagonal - towards_middle * block, z);
    HAWSER_UNROLL for (int i = 0; i < B; ++i) z[i] = c.at(i);
    solve_lower<B>(diagonal, z);
    HAWSER_UNROLL for (int i = 0; i < B; ++i) b[i] = z[i];
    fetch_ahead(towards_middle);
    move(towards_middle);
  }
  HAWSER_INLINE void backward() {
    Column<B> c;
    c.load(b);
    subtract_product<B>(c, diagonal + towards_middle * block, z);
    HAWSER_UNROLL for (int i = 0; i < B; ++i) z[i] = c.at(i);
    solve_upper<B>(diagonal, z);
    HAWSER_UNROLL for (int i = 0; i < B; ++i) b[i] = z[i];
    fetch_ahead(-towards_middle);
    move(-towards_middle);
  }
  HAWSER_INLINE void start_forward(int nodes, const double* factors, double* chain_b) {
    start_at(left ? 0 : nodes - 1, factors, chain_b);
    forward<true>();
  }
  /// At the front's node k, after those before it.
  HAWSER_INLINE void go_on_forward(int nodes, int k, const double* factors, double* chain_b) {
    start_at(left ? k : nodes - 1 - k, factors, chain_b);
    HAWSER_UNROLL for (int i = 0; i < B; ++i) z[i] = b[i - towards_middle * B];
  }
  HAWSER_INLINE void start_backward(int nodes, const double* factors, double* chain_b) {
    start_at(nodes / 2, factors, chain_b);
    HAWSER_UNROLL for (int i = 0; i < B; ++i) z[i] = b[i];
    move(-towards_middle);
  }
};

template <int B, Front Side>
void forward_part(int nodes, FrontRun run, const double* factors, double* b) {
  if (run.count == 0) return;
  Substitution<B, Side> front;
  int k = run.first;
  if (k == 0)
    front.start_forward(nodes, factors, b), ++k;
  else
    front.go_on_forward(nodes, k, factors, b);
  for (; k < run.first + run.count; ++k) front.template forward<false>();
}

template <int B, Front Side>
void forward_front(int nodes, const double* factors, double* b) {
  forward_part<B, Side>(nodes, {Side, 0, Blocks<B, Side>::nodes_of(nodes)}, factors, b);
}

template <int B>
void forward_both(int nodes, const double* factors, double* b) {
  const int pairs = Blocks<B, Front::right>::nodes_of(nodes);
  if (pairs == 0) return forward_front<B, Front::left>(nodes, factors, b);
  Substitution<B, Front::left> left;
  Substitution<B, Front::right> right;
  left.start_forward(nodes, factors, b), right.start_forward(nodes, factors, b);
  for (int k = 1; k < pairs; ++k) left.template forward<false>(), right.template forward<false>();
  if (pairs < Blocks<B, Front::left>::nodes_of(nodes)) left.template forward<false>();
}

template <int B>
void solve_middle_node(int nodes, const double* factors, double* b) {
  const int middle = nodes / 2, block = B * B;
  const double* diagonal = factors + 3L * block * middle;
  b += static_cast<long>(B) * middle;
  Column<B> c;
  c.load(b);
  if (nodes > 1) subtract_product<B>(c, diagonal - block, b - B);
  if (nodes > 2) subtract_product<B>(c, diagonal + block, b + B);
  c.store(b);
  solve_lower<B>(diagonal, b);
  solve_upper<B>(diagonal, b);
}

template <int B, Front Side>
void backward_front(int nodes, const double* factors, double* b) {
  Substitution<B, Side> front;
  front.start_backward(nodes, factors, b);
  for (int k = Blocks<B, Side>::nodes_of(nodes); k > 0; --k) front.backward();
}

template <int B>
void backward_both(int nodes, const double* factors, double* b) {
  const int pairs = Blocks<B, Front::right>::nodes_of(nodes);
  Substitution<B, Front::left> left;
  Substitution<B, Front::right> right;
  left.start_backward(nodes, factors, b), right.start_backward(nodes, factors, b);
  for (int k = 0; k < pairs; ++k) left.backward(), right.backward();
  if (pairs < Blocks<B, Front::left>::nodes_of(nodes)) left.backward();
}

}  // namespace

}  // namespace hawser
