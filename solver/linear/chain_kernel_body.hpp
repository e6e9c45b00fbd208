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
  static constexpr int block = B * B;
  const double *values, *next_values;  // of the front's node and of the next one
  double *factors, *next_factors;
  Node<B> node;

  HAWSER_INLINE void stand_at(const double* values_here, double* factors_here) {
    values = values_here, factors = factors_here;
    next_values = inwards<Side>(values, 3 * block), next_factors = inwards<Side>(factors, 3 * block);
  }
  HAWSER_INLINE void advance() {
    node.watch.end_node();
    if constexpr (Side == Front::right) {
      constexpr int ahead = 3 * block * (1 + fetched_ahead_to_factorize);
      prefetch<24 * block, false>(values - ahead), prefetch<24 * block, true>(factors - ahead);
    }
    values = inwards<Side>(values, 3 * block), factors = inwards<Side>(factors, 3 * block);
    next_values = inwards<Side>(next_values, 3 * block), next_factors = inwards<Side>(next_factors, 3 * block);
  }
  /// The right front leaves its share of the middle node aside, so that the left one need not wait.
  HAWSER_INLINE void meet(int nodes, double* chain_factors) {
    static constexpr double nothing[B * B] = {};
    if constexpr (Side == Front::right) next_values = nothing, next_factors = chain_factors + left_at_middle<B>(nodes);
  }

  template <int P>
  HAWSER_INLINE void reduce() {
    node.template reduce<P, true>(factors, inwards<Side>(values, 2 * block), inwards<Side>(factors, 2 * block));
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
    y.store(inwards<Side>(factors, block) + first), d.store(next_factors + first);
  }
  HAWSER_INLINE void reduce_node() {
    for_each_pair<B>([&] HAWSER_PAIR { reduce<pair.value>(); });
  }
  HAWSER_INLINE void update_next() {
    for_each_pair<B>([&] HAWSER_PAIR { update<pair.value>(); });
    advance();
  }
};

// Where a front begins and ends a run.
template <int B, Front Side>
HAWSER_INLINE double* begin(int nodes, FrontRun& run, double* factors) {
  double* at = factors + 3L * B * B * node_of<Side>(nodes, run.first);
  if (run.first > 0) return at;
  typename Panel<B, 2>::Squares given;
  given.set_all(0.0);
  for_each_pair<B>([&] HAWSER_PAIR {
    constexpr int from = 2 * B * pair.value;
    PairOf<B, pair.value> d;
    d.load_values(run.values + from), d.store(at + from);
    d.add_squares_to(given);
  });
  run.given = given.sum();
  return at;
}
template <int B, Front Side>
HAWSER_INLINE void end(FrontRun& run, int count, double given) {
  run.first += count, run.count -= count, run.given = given;
  run.values = inwards<Side>(run.values, 3L * B * B * count);
}

template <int B, Front Side>
void factorize_front(int nodes, FrontRun& run, double* factors, PivotWatch& watch) {
  const int count = run.count, met = nodes_of<Side>(nodes) - run.first;
  if (count == 0) return;
  Elimination<B, Side> front;
  front.stand_at(run.values, begin<B, Side>(nodes, run, factors));
  front.node.watch.go_on(run.given);
  for (int k = 1; k <= count; ++k) {
    if (k == met) front.meet(nodes, factors);
    front.reduce_node();
    front.update_next();
  }
  end<B, Side>(run, count, front.node.watch.given.sum());
  front.node.watch.add_to(watch);
}

/// The next `count` nodes of both fronts, in turn.
template <int B>
void factorize_in_turn(int nodes, int count, FrontRun& left_run, FrontRun& right_run, double* factors, PivotWatch& watch) {
  const int met = nodes_of<Front::right>(nodes) - right_run.first;
  Elimination<B, Front::left> left;
  Elimination<B, Front::right> right;
  left.stand_at(left_run.values, begin<B, Front::left>(nodes, left_run, factors));
  right.stand_at(right_run.values, begin<B, Front::right>(nodes, right_run, factors));
  left.node.watch.go_on(left_run.given), right.node.watch.go_on(right_run.given);
  for (int k = 1; k <= count; ++k) {
    if (k == met) right.meet(nodes, factors);
    for_each_pair<B>([&] HAWSER_PAIR { left.template reduce<pair.value>(), right.template reduce<pair.value>(); });
    for_each_pair<B>([&] HAWSER_PAIR { left.template update<pair.value>(), right.template update<pair.value>(); });
    left.advance(), right.advance();
  }
  end<B, Front::left>(left_run, count, left.node.watch.given.sum()), end<B, Front::right>(right_run, count, right.node.watch.given.sum());
  left.node.watch.add_to(watch), right.node.watch.add_to(watch);
}

// With 6 unknowns a node one front already fills the processor's window of instructions: in turn is no faster.
template <int B>
void factorize_runs(int nodes, FrontRun& left, FrontRun& right, double* factors, PivotWatch& watch) {
  const int shared = left.count < right.count ? left.count : right.count;
  if constexpr (B == 3) {
    if (shared > 0) factorize_in_turn<B>(nodes, shared, left, right, factors, watch);
  }
  factorize_front<B, Front::left>(nodes, left, factors, watch);
  factorize_front<B, Front::right>(nodes, right, factors, watch);
}

template <int B>
void factorize_middle_node(int nodes, const double* values, double* factors, PivotWatch& watch) {
  double* middle = factors + at_middle<B>(nodes);
  const double* from_right = factors + left_at_middle<B>(nodes);
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

template <int B>
void factorize_any(int nodes, const double* values, double* factors, Front front, PivotWatch& watch) {
  FrontRun left{0, front == Front::right ? 0 : nodes_of<Front::left>(nodes), values};
  FrontRun right{0, front == Front::left ? 0 : nodes_of<Front::right>(nodes), values + 3L * B * B * (nodes - 1)};
  factorize_runs<B>(nodes, left, right, factors, watch);
}

template <int B>
void eliminate_runs_any(int nodes, FrontRun& left, FrontRun& right, double* factors, double* b, PivotWatch& watch) {
  const FrontRun left_run = left, right_run = right;
  factorize_runs<B>(nodes, left, right, factors, watch);
  forward_runs<B>(nodes, left_run, right_run, factors, b);
}

template <int B>
void forward_any(int nodes, const double* factors, double* b, Front front) {
  const FrontRun left{0, front == Front::right ? 0 : nodes_of<Front::left>(nodes), nullptr};
  const FrontRun right{0, front == Front::left ? 0 : nodes_of<Front::right>(nodes), nullptr};
  forward_runs<B>(nodes, left, right, factors, b);
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

void eliminate_runs(int block, int nodes, FrontRun& left, FrontRun& right, double* factors, double* b, PivotWatch& watch) {
  block == 3 ? eliminate_runs_any<3>(nodes, left, right, factors, b, watch) : eliminate_runs_any<6>(nodes, left, right, factors, b, watch);
}

void factorize_middle(int block, int nodes, const double* values, double* factors, PivotWatch& watch) {
  block == 3 ? factorize_middle_node<3>(nodes, values, factors, watch) : factorize_middle_node<6>(nodes, values, factors, watch);
}

void forward(int block, int nodes, const double* factors, double* b, Front front) {
  block == 3 ? forward_any<3>(nodes, factors, b, front) : forward_any<6>(nodes, factors, b, front);
}

void solve_middle(int block, int nodes, const double* factors, double* b) {
  block == 3 ? solve_middle_node<3>(nodes, factors, b) : solve_middle_node<6>(nodes, factors, b);
}

void backward(int block, int nodes, const double* factors, double* b, Front front) {
  block == 3 ? backward_any<3>(nodes, factors, b, front) : backward_any<6>(nodes, factors, b, front);
}

}  // namespace

}  // namespace hawser
