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
  /// The D of the front's node has been met before.
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

  // Columns 2P and 2P + 1 of L_k\U_k from those of D_k, and of X_k, which is written where a place is given. The middle node has no X_k.
  //
  // The reciprocal of the second pivot q - l u / p is p / (p q - l u): both divisions go on at once.
  template <int P, bool HasNext>
  HAWSER_INLINE void reduce(const double* diagonal, const double* given_column, double* worked, double* column) {
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
      Pair::store_columns(worked + B * first, with_reciprocal, with_reciprocal);
      if (HasNext && column) Pair::store_columns(column + B * first, x[first], x[first]);
    } else {
      const double u = d.at(first, 1), determinant = p * d.at(second, 1) - d.at(second, 0) * u, second_reciprocal = p / determinant;
      d.subtract_from_second(lower[first], u);
      d.add_squares_to(watch.worked);
      const auto b = d.scaled_column(1, second_reciprocal);
      lower[second] = Pair::template zero_above<second + 1>(b);
      Pair::store_columns(worked + B * first, with_reciprocal, Pair::template with_entry<second>(b, second_reciprocal));
      watch.note_pivots(p, determinant * reciprocal);
      if constexpr (HasNext) {
        c.subtract_from_second(x[first], u);
        x[second] = c.scaled_column(1, second_reciprocal);
        if (column) Pair::store_columns(column + B * first, x[first], x[second]);
      }
    }
  }
};

// A front that goes from node to node. Where not all is kept, D_k waits beside the factors, so that these are written once.
template <int B, Front Side, Keep K>
struct Elimination {
  using At = Layout<B, K>;
  static constexpr int block = B * B, towards_middle = Side == Front::left ? 1 : -1;
  const double *values, *next_values;  // of the front's node and of the next one
  double *factors, *column;            // column: where X_k goes, if it is kept
  double *b, *next_b;                  // nullptr: none
  double *diagonal, *next_diagonal;    // D_k and D_{k+1}
  double* first_factors;               // of the chain
  alignas(32) double waiting[B * B];
  double aside[B] = {};  // a share of the middle node's b, which is taken anew from X
  Node<B> node;

  HAWSER_INLINE void begin(int nodes, FrontRun& run, double* chain_factors, double* chain_b) {
    const int k = node_of<Side>(nodes, run.first);
    first_factors = chain_factors, factors = chain_factors + At::at(k);
    values = run.values, next_values = inwards<Side>(values, 3 * block);
    b = chain_b ? chain_b + static_cast<long>(B) * k : nullptr, next_b = chain_b ? b + towards_middle * B : nullptr;
    diagonal = At::all ? factors : waiting, next_diagonal = At::all ? inwards<Side>(factors, At::node) : waiting;
    column = At::all ? factors + At::template column<Side> : nullptr;
    if (run.first == 0) run.given = take_over(values, diagonal);
    if (run.first > 0 && !At::all) copy(factors, waiting);
    node.watch.go_on(run.given);
  }
  HAWSER_INLINE void end(FrontRun& run, int count, PivotWatch& watch) {
    run.first += count, run.count -= count, run.given = node.watch.given.sum();
    run.values = values;
    if (!At::all && next_diagonal == waiting) copy(waiting, factors);
    node.watch.add_to(watch);
  }
  /// Before the last node. The right front leaves its share of the middle node aside, so that the left one need not wait; b of the middle takes
  /// both shares later.
  HAWSER_INLINE void meet(int nodes) {
    static constexpr double nothing[B * B] = {};
    if constexpr (Side == Front::right) next_values = nothing, next_diagonal = first_factors + At::left_at_middle(nodes);
    if constexpr (Side == Front::left && !At::all) next_diagonal = first_factors + At::at(nodes / 2);
    if constexpr (!At::all) column = first_factors + (Side == Front::left ? At::left_column(nodes) : At::right_column(nodes));
    next_b = aside;
  }

  template <int P>
  HAWSER_INLINE void reduce() {
    node.template reduce<P, true>(diagonal, inwards<Side>(values, 2 * block), factors, column);
  }
  // Columns 2P and 2P + 1 of Y_k and of what is left of the next node's D.
  template <int P>
  HAWSER_INLINE void update() {
    constexpr int first = 2 * B * P;
    PairOf<B, P> y, d;
    y.load_values(inwards<Side>(values, block) + first), d.load_values(next_values + first);
    y.add_squares_to(node.watch.given), d.add_squares_to(node.watch.given_next);
    HAWSER_UNROLL for (int i = 0; i < B; ++i) {
      const auto u = y.row(i);
      if (i + 1 < B) y.subtract(node.lower[i], u);
      d.subtract(node.x[i], u);
    }
    y.add_squares_to(node.watch.worked);
    y.store(factors + At::template row<Side> + first), d.store(next_diagonal + first);
  }
  HAWSER_INLINE void reduce_right_hand_side() {
    if (!b) return;
    Column<B> c, next;
    c.load(b);
    next.load(next_b);
    HAWSER_UNROLL for (int i = 0; i < B; ++i) {
      const double z = c.at(i);
      if (i + 1 < B) Panel<B, 2>::subtract(c, node.lower[i], z);
      Panel<B, 2>::subtract(next, node.x[i], z);
    }
    c.store(b), next.store(next_b);
    b += towards_middle * B, next_b += towards_middle * B;
  }
  HAWSER_INLINE void advance() {
    node.watch.end_node();
    if constexpr (Side == Front::right) {
      prefetch<24 * block, false>(values - 3 * block * (1 + fetched_ahead_to_factorize));
      prefetch<8 * At::node, true>(factors - At::node * (1 + fetched_ahead_to_factorize));
    }
    values = inwards<Side>(values, 3 * block), next_values = inwards<Side>(next_values, 3 * block);
    factors = inwards<Side>(factors, At::node);
    if (At::all) diagonal = factors, next_diagonal = inwards<Side>(factors, At::node), column = factors + At::template column<Side>;
  }
  HAWSER_INLINE void eliminate_node() {
    for_each_pair<B>([&] HAWSER_PAIR { reduce<pair.value>(); });
    for_each_pair<B>([&] HAWSER_PAIR { update<pair.value>(); });
    reduce_right_hand_side();
    advance();
  }

 private:
  /// The first D of the front: the sum of its squares.
  static double take_over(const double* given, double* to) {
    typename Panel<B, 2>::Squares sum;
    sum.set_all(0.0);
    for_each_pair<B>([&] HAWSER_PAIR {
      constexpr int from = 2 * B * pair.value;
      PairOf<B, pair.value> d;
      d.load_values(given + from), d.store(to + from);
      d.add_squares_to(sum);
    });
    return sum.sum();
  }
  static void copy(const double* from, double* to) {
    for (int i = 0; i < block; ++i) to[i] = from[i];
  }
};

template <int B, Front Side, Keep K>
void factorize_front(int nodes, FrontRun& run, double* factors, double* b, PivotWatch& watch) {
  const int count = run.count, met = nodes_of<Side>(nodes) - run.first;
  if (count == 0) return;
  Elimination<B, Side, K> front;
  front.begin(nodes, run, factors, b);
  for (int k = 1; k <= count; ++k) {
    if (k == met) front.meet(nodes);
    front.eliminate_node();
  }
  front.end(run, count, watch);
}

/// The next `count` nodes of both fronts, in turn.
template <int B, Keep K>
void factorize_in_turn(int nodes, int count, FrontRun& left_run, FrontRun& right_run, double* factors, double* b, PivotWatch& watch) {
  const int left_met = nodes_of<Front::left>(nodes) - left_run.first, right_met = nodes_of<Front::right>(nodes) - right_run.first;
  Elimination<B, Front::left, K> left;
  Elimination<B, Front::right, K> right;
  left.begin(nodes, left_run, factors, b), right.begin(nodes, right_run, factors, b);
  for (int k = 1; k <= count; ++k) {
    if (k == left_met) left.meet(nodes);
    if (k == right_met) right.meet(nodes);
    for_each_pair<B>([&] HAWSER_PAIR { left.template reduce<pair.value>(), right.template reduce<pair.value>(); });
    for_each_pair<B>([&] HAWSER_PAIR { left.template update<pair.value>(), right.template update<pair.value>(); });
    left.reduce_right_hand_side(), right.reduce_right_hand_side();
    left.advance(), right.advance();
  }
  left.end(left_run, count, watch), right.end(right_run, count, watch);
}

// With 6 unknowns a node one front already fills the processor's window of instructions: in turn is no faster.
template <int B, Keep K>
void eliminate_runs_of(int nodes, FrontRun& left, FrontRun& right, double* factors, double* b, PivotWatch& watch) {
  const int shared = left.count < right.count ? left.count : right.count;
  if constexpr (B == 3) {
    if (shared > 0) factorize_in_turn<B, K>(nodes, shared, left, right, factors, b, watch);
  }
  factorize_front<B, Front::left, K>(nodes, left, factors, b, watch);
  factorize_front<B, Front::right, K>(nodes, right, factors, b, watch);
}

template <int B, Keep K>
void factorize_middle_node(int nodes, const double* values, double* factors, PivotWatch& watch) {
  double* middle = factors + Layout<B, K>::at(nodes / 2);
  const double* from_right = factors + Layout<B, K>::left_at_middle(nodes);
  Node<B> node;
  node.watch.start();
  for_each_pair<B>([&] HAWSER_PAIR {
    constexpr int first = 2 * B * pair.value;
    PairOf<B, pair.value> d, r;
    d.load_values(values + first), d.add_squares_to(node.watch.given);
    if (nodes > 1) d.load(middle + first);
    if (nodes > 2) r.load(from_right + first), d.add(r);
    d.store(middle + first);
    node.template reduce<pair.value, false>(middle, nullptr, middle, nullptr);
  });
  node.watch.end_node();
  node.watch.add_to(watch);
  for (int i = 0; i < B; ++i) watch.not_finite += 0.0 * middle[Panel<B, 2>::place(i, i)];  // a NaN anywhere before has come to here
}

template <int B>
void factorize_any(int nodes, const double* values, double* factors, Front front, PivotWatch& watch) {
  FrontRun left{0, front == Front::right ? 0 : nodes_of<Front::left>(nodes), values};
  FrontRun right{0, front == Front::left ? 0 : nodes_of<Front::right>(nodes), values + 3L * B * B * (nodes - 1)};
  eliminate_runs_of<B, Keep::all>(nodes, left, right, factors, nullptr, watch);
}

template <int B>
void forward_any(int nodes, const double* factors, double* b, Front front) {
  const FrontRun left{0, front == Front::right ? 0 : nodes_of<Front::left>(nodes), nullptr};
  const FrontRun right{0, front == Front::left ? 0 : nodes_of<Front::right>(nodes), nullptr};
  forward_runs<B>(nodes, left, right, factors, b);
}

template <int B, Keep K>
void backward_any(int nodes, const double* factors, double* b, Front front) {
  if (front == Front::both) backward_both<B, K>(nodes, factors, b);
  if (front == Front::left) backward_front<B, Front::left, K>(nodes, factors, b);
  if (front == Front::right) backward_front<B, Front::right, K>(nodes, factors, b);
}

template <Keep K>
struct Kept {
  static constexpr Keep value = K;
};
template <class Function>
void with_layout(int block, Keep keep, Function f) {
  if (block == 3) return keep == Keep::all ? f(Index<3>{}, Kept<Keep::all>{}) : f(Index<3>{}, Kept<Keep::solution>{});
  keep == Keep::all ? f(Index<6>{}, Kept<Keep::all>{}) : f(Index<6>{}, Kept<Keep::solution>{});
}

void factorize(int block, int nodes, const double* values, double* factors, Front front, PivotWatch& watch) {
  block == 3 ? factorize_any<3>(nodes, values, factors, front, watch) : factorize_any<6>(nodes, values, factors, front, watch);
}

void eliminate_runs(int block, int nodes, Keep keep, FrontRun& left, FrontRun& right, double* factors, double* b, PivotWatch& watch) {
  with_layout(block, keep, [&](auto size, auto kept) { eliminate_runs_of<size.value, kept.value>(nodes, left, right, factors, b, watch); });
}

void factorize_middle(int block, int nodes, Keep keep, const double* values, double* factors, PivotWatch& watch) {
  with_layout(block, keep, [&](auto size, auto kept) { factorize_middle_node<size.value, kept.value>(nodes, values, factors, watch); });
}

void forward(int block, int nodes, const double* factors, double* b, Front front) {
  block == 3 ? forward_any<3>(nodes, factors, b, front) : forward_any<6>(nodes, factors, b, front);
}

void solve_middle(int block, int nodes, Keep keep, const double* factors, double* b) {
  with_layout(block, keep, [&](auto size, auto kept) { solve_middle_node<size.value, kept.value>(nodes, factors, b); });
}

void backward(int block, int nodes, Keep keep, const double* factors, double* b, Front front) {
  with_layout(block, keep, [&](auto size, auto kept) { backward_any<size.value, kept.value>(nodes, factors, b, front); });
}

}  // namespace

}  // namespace hawser
