// The kernel of chain_kernel.hpp, compiled once for each instruction set by the chain_kernel*.cpp files (chain_kernel_packs.hpp says how).
#pragma once

#include "solver/linear/chain_kernel.hpp"
#include "solver/linear/chain_kernel_packs.hpp"
#include "solver/linear/chain_kernel_solve.hpp"

namespace hawser {

namespace {

template <int N>
struct Index {
  static constexpr int value = N;
};

/// f(Index<0>), f(Index<1>), ... for the pairs of columns of a block, the last of which may be a single one.
template <int B, class Function>
HAWSER_INLINE void for_each_pair(Function f) {
  f(Index<0>{}), f(Index<1>{});
  if constexpr (B > 4) f(Index<2>{});
}
#define HAWSER_PAIR (auto pair) __attribute__((always_inline))

template <int B, int P>
using PairOf = Panel<B, (2 * P + 1 < B ? 2 : 1)>;

// PivotWatch of one front; entries stay in their lanes until a node is done.
template <int B>
struct Watch {
  using Squares = typename Panel<B, 2>::Squares;
  using Two = PackTypes<2>;
  Squares given, given_next, worked;
  Two::Doubles smallest, largest;
  Two::Rows negative;
  double growth_squared;

  HAWSER_INLINE void start() {
    given.set_all(0.0), given_next.set_all(0.0), worked.set_all(0.0);
    smallest = Two::filled(__builtin_inf()), largest = Two::Doubles{}, negative = Two::Rows{}, growth_squared = 0.0;
  }
  HAWSER_INLINE void note_pivots(double p, double q) {
    const Two::Doubles pivots = {p, q};
    const Two::Doubles size = (Two::Doubles)((Two::Rows)pivots & 0x7fffffffffffffff);
    smallest = Two::smaller(size, smallest), largest = Two::larger(size, largest);
    negative -= pivots < 0.0;
  }
  HAWSER_INLINE void note_pivot(double p) {
    note_pivots(p, p);
    negative += Two::Rows{0, -(p < 0.0)};
  }
  /// The first node of a run: its D has been met before.
  HAWSER_INLINE void go_on(double given_before) {
    start();
    given.set_all(1.0);
    given.set_all(given_before / given.sum());
  }
  HAWSER_INLINE void end_node() {
    const double g = worked.sum() / given.sum();
    growth_squared = g > growth_squared ? g : growth_squared;
    given = given_next;
    given_next.set_all(0.0), worked.set_all(0.0);
  }
  void add_to(PivotWatch& watch) const {
    for (int i = 0; i < 2; ++i) {
      if (smallest[i] < watch.smallest) watch.smallest = smallest[i];
      if (largest[i] > watch.largest) watch.largest = largest[i];
      watch.negative += static_cast<int>(negative[i]);
    }
    if (growth_squared > watch.growth_squared) watch.growth_squared = growth_squared;
  }
};

// The node a front is at.
template <int B>
struct Node {
  typename Panel<B, 2>::Multiplier lower[B], x[B];  // columns of L_k, zero down to the diagonal, and of X_k
  Watch<B> watch;

  // Columns 2P and 2P + 1 of L_k\U_k in place of those of D_k, and of X_k. The middle node has no X_k.
  //
  // The reciprocal of the second pivot q - l u / p is p / (p q - l u): both divisions go on at once.
  template <int P, bool HasNext>
  HAWSER_INLINE void reduce(double* diagonal, const double* given_column, double* column) {
    constexpr int first = 2 * P, second = first + 1;
    using Pair = PairOf<B, P>;
    Pair d, c;
    d.load(diagonal + B * first);
    if constexpr (HasNext) c.load_values(given_column + B * first);
    HAWSER_UNROLL for (int i = 0; i < first; ++i) {
      const auto u = d.row(i);
      d.subtract(lower[i], u);
      if constexpr (HasNext) c.subtract(x[i], u);
    }
    const double p = d.at(first, 0), reciprocal = 1.0 / p;
    const auto a = d.scaled_column(0, reciprocal);
    lower[first] = Pair::template zero_above<first + 1>(a);
    const auto with_reciprocal = Pair::template with_entry<first>(a, reciprocal);
    if constexpr (HasNext) x[first] = c.scaled_column(0, reciprocal);
    if constexpr (second == B) {
      watch.note_pivot(p), d.add_squares_to(watch.worked);
      Pair::store_columns(diagonal + B * first, with_reciprocal, with_reciprocal);
      if constexpr (HasNext) Pair::store_columns(column + B * first, x[first], x[first]);
    } else {
      const double u = d.at(first, 1), determinant = p * d.at(second, 1) - d.at(second, 0) * u, second_reciprocal = p / determinant;
      d.subtract_from_second(lower[first], u);
      d.add_squares_to(watch.worked);
      const auto b = d.scaled_column(1, second_reciprocal);
      lower[second] = Pair::template zero_above<second + 1>(b);
      Pair::store_columns(diagonal + B * first, with_reciprocal, Pair::template with_entry<second>(b, second_reciprocal));
      watch.note_pivots(p, determinant * reciprocal);
      if constexpr (HasNext) {
        c.subtract_from_second(x[first], u);
        x[second] = c.scaled_column(1, second_reciprocal);
        Pair::store_columns(column + B * first, x[first], x[second]);
      }
    }
  }
};

template <int B, Front Side>
struct Elimination {
  using At = Blocks<B, Side>;
  const double* values;
  double* factors;
  const double* next_values;
  double* next_factors;
  Node<B> node;

  HAWSER_INLINE void stand_at(const double* values_here, double* factors_here) {
    values = values_here, factors = factors_here;
    next_values = values + At::next, next_factors = factors + At::next;
  }
  /// Takes over the D of the front's first node.
  HAWSER_INLINE void start() {
    node.watch.start();
    for_each_pair<B>([&] HAWSER_PAIR {
      constexpr int from = At::diagonal + 2 * B * pair.value;
      PairOf<B, pair.value> d;
      d.load_values(values + from), d.store(factors + from);
      d.add_squares_to(node.watch.given);
    });
  }
  HAWSER_INLINE void advance() {
    node.watch.end_node();
    if constexpr (Side == Front::right) {
      prefetch<24 * At::block, false>(values + fetched_ahead_to_factorize * At::step);
      prefetch<24 * At::block, true>(factors + fetched_ahead_to_factorize * At::step);
    }
    values += At::step, factors += At::step, next_values += At::step, next_factors += At::step;
  }
  /// The right front leaves its share of the middle node aside, so that the left one need not wait.
  HAWSER_INLINE void meet(int nodes, double* chain_factors) {
    static constexpr double nothing[B * B] = {};
    if constexpr (Side == Front::right) next_values = nothing, next_factors = chain_factors + At::left_at_middle(nodes);
  }

  template <int P>
  HAWSER_INLINE void reduce() {
    node.template reduce<P, true>(factors + At::diagonal, values + At::column, factors + At::column);
  }
  // Columns 2P and 2P + 1 of Y_k and of what is left of the next node's D.
  template <int P>
  HAWSER_INLINE void update() {
    constexpr int first = 2 * B * P;
    PairOf<B, P> y, d;
    y.load_values(values + At::row + first), d.load_values(next_values + first);
    y.add_squares_to(node.watch.given), d.add_squares_to(node.watch.given_next);
    HAWSER_UNROLL for (int i = 0; i < B; ++i) {
      const auto u = y.row(i);
      if (i + 1 < B) y.subtract(node.lower[i], u);
      d.subtract(node.x[i], u);
    }
    y.add_squares_to(node.watch.worked);
    y.store(factors + At::row + first), d.store(next_factors + first);
  }
  HAWSER_INLINE void eliminate_node() {
    for_each_pair<B>([&] HAWSER_PAIR { reduce<pair.value>(); });
    for_each_pair<B>([&] HAWSER_PAIR { update<pair.value>(); });
    advance();
  }
};

template <int B, Front Side>
void factorize_part(int nodes, FrontRun run, const double* values, double* factors, double& given, PivotWatch& watch) {
  using At = Blocks<B, Side>;
  const int all = At::nodes_of(nodes), end = run.first + run.count;
  if (run.count == 0) return;
  Elimination<B, Side> front;
  front.stand_at(values, factors + At::first(nodes) + static_cast<long>(At::step) * run.first);
  if (run.first == 0)
    front.start();
  else
    front.node.watch.go_on(given);
  for (int k = run.first; k < end; ++k) {
    if (k + 1 == all) front.meet(nodes, factors);
    front.eliminate_node();
  }
  given = front.node.watch.given.sum();
  front.node.watch.add_to(watch);
}

template <int B, Front Side>
void factorize_front(int nodes, const double* values, double* factors, PivotWatch& watch) {
  using At = Blocks<B, Side>;
  double given = 0.0;
  factorize_part<B, Side>(nodes, {Side, 0, At::nodes_of(nodes)}, values + At::first(nodes), factors, given, watch);
}

template <int B>
void factorize_both(int nodes, const double* values, double* factors, PivotWatch& watch) {
  const int pairs = Blocks<B, Front::right>::nodes_of(nodes);
  if (pairs == 0) return factorize_front<B, Front::left>(nodes, values, factors, watch);
  Elimination<B, Front::left> left;
  Elimination<B, Front::right> right;
  const auto start = [&]<Front Side>(Elimination<B, Side> & front) __attribute__((always_inline)) {
    constexpr auto first = Blocks<B, Side>::first;
    front.stand_at(values + first(nodes), factors + first(nodes));
    front.start();
  };
  start(left), start(right);
  for (int k = 0; k < pairs; ++k) {
    if (k + 1 == pairs) right.meet(nodes, factors);
    for_each_pair<B>([&] HAWSER_PAIR { left.template reduce<pair.value>(), right.template reduce<pair.value>(); });
    for_each_pair<B>([&] HAWSER_PAIR { left.template update<pair.value>(), right.template update<pair.value>(); });
    left.advance(), right.advance();
  }
  if (pairs < Blocks<B, Front::left>::nodes_of(nodes)) left.eliminate_node();
  left.node.watch.add_to(watch), right.node.watch.add_to(watch);
}

template <int B>
void factorize_middle_node(int nodes, const double* values, double* factors, PivotWatch& watch) {
  using Left = Blocks<B, Front::left>;
  double* middle = factors + Left::middle(nodes);
  const double* from_right = factors + Left::left_at_middle(nodes);
  Node<B> node;
  node.watch.start();
  for_each_pair<B>([&] HAWSER_PAIR {
    constexpr int first = 2 * B * pair.value;
    PairOf<B, pair.value> d, r;
    d.load_values(values + first), d.add_squares_to(node.watch.given);
    if (nodes > 1) d.load(middle + first);
    if (nodes > 2) r.load(from_right + first), d.add(r);
    d.store(middle + first);
    node.template reduce<pair.value, false>(middle, nullptr, nullptr);
  });
  node.watch.end_node();
  node.watch.add_to(watch);
  for (int i = 0; i < B; ++i) watch.not_finite += 0.0 * middle[Panel<B, 2>::place(i, i)];  // a NaN anywhere before has come to here
}

// With 6 unknowns a node one front already fills the processor's window of instructions: both at once are no faster.
template <int B>
void factorize_any(int nodes, const double* values, double* factors, Front front, PivotWatch& watch) {
  if constexpr (B == 3) {
    if (front == Front::both) return factorize_both<B>(nodes, values, factors, watch);
  }
  if (front != Front::right) factorize_front<B, Front::left>(nodes, values, factors, watch);
  if (front != Front::left) factorize_front<B, Front::right>(nodes, values, factors, watch);
}

template <int B>
void factorize_run_any(int nodes, FrontRun run, const double* values, double* factors, double& given, PivotWatch& watch) {
  if (run.front == Front::left)
    factorize_part<B, Front::left>(nodes, run, values, factors, given, watch);
  else
    factorize_part<B, Front::right>(nodes, run, values, factors, given, watch);
}

template <int B>
void forward_run_any(int nodes, FrontRun run, const double* factors, double* b) {
  if (run.front == Front::left)
    forward_part<B, Front::left>(nodes, run, factors, b);
  else
    forward_part<B, Front::right>(nodes, run, factors, b);
}

template <int B>
void forward_any(int nodes, const double* factors, double* b, Front front) {
  if (front == Front::both) forward_both<B>(nodes, factors, b);
  if (front == Front::left) forward_front<B, Front::left>(nodes, factors, b);
  if (front == Front::right) forward_front<B, Front::right>(nodes, factors, b);
}

template <int B>
void backward_any(int nodes, const double* factors, double* b, Front front) {
  if (front == Front::both) backward_both<B>(nodes, factors, b);
  if (front == Front::left) backward_front<B, Front::left>(nodes, factors, b);
  if (front == Front::right) backward_front<B, Front::right>(nodes, factors, b);
}

void factorize(int block, int nodes, const double* values, double* factors, Front front, PivotWatch& watch) {
  block == 3 ? factorize_any<3>(nodes, values, factors, front, watch) : factorize_any<6>(nodes, values, factors, front, watch);
}

void factorize_run(int block, int nodes, FrontRun run, const double* values, double* factors, double& given, PivotWatch& watch) {
  block == 3 ? factorize_run_any<3>(nodes, run, values, factors, given, watch) : factorize_run_any<6>(nodes, run, values, factors, given, watch);
}

void factorize_middle(int block, int nodes, const double* values, double* factors, PivotWatch& watch) {
  block == 3 ? factorize_middle_node<3>(nodes, values, factors, watch) : factorize_middle_node<6>(nodes, values, factors, watch);
}

void forward(int block, int nodes, const double* factors, double* b, Front front) {
  block == 3 ? forward_any<3>(nodes, factors, b, front) : forward_any<6>(nodes, factors, b, front);
}

void forward_run(int block, int nodes, FrontRun run, const double* factors, double* b) {
  block == 3 ? forward_run_any<3>(nodes, run, factors, b) : forward_run_any<6>(nodes, run, factors, b);
}

void solve_middle(int block, int nodes, const double* factors, double* b) {
  block == 3 ? solve_middle_node<3>(nodes, factors, b) : solve_middle_node<6>(nodes, factors, b);
}

void backward(int block, int nodes, const double* factors, double* b, Front front) {
  block == 3 ? backward_any<3>(nodes, factors, b, front) : backward_any<6>(nodes, factors, b, front);
}

}  // namespace

}  // namespace hawser
