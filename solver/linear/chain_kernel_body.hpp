// The kernel of chain_kernel.hpp, compiled once for each instruction set by the chain_kernel*.cpp files (chain_kernel_packs.hpp says how).
#pragma once

#include "solver/linear/chain_kernel.hpp"
#include "solver/linear/chain_kernel_columns.hpp"
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
  if constexpr (B > 6) f(Index<3>{});
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
//
// With L Delta L^T rows of Delta_k L_k^T and of Y_k are read as columns of L_k Delta_k and X_k Delta_k, and of D only packs that hold entries on or
// below the diagonal are formed.
template <int B, Factors F>
struct Node {
  static constexpr bool symmetric = F == Factors::ldlt;
  static constexpr bool upper_by_itself = F == Factors::spent_lu;  // but for the middle node
  typename Panel<B, 2>::Multiplier lower[B], x[B];                 // columns of L_k, zero down to the diagonal, and of X_k
  alignas(32) double worked_lower[symmetric ? B * B : 1], worked_x[symmetric ? B * B : 1];
  Watch<B> watch;

  /// The first row of D that is needed in columns 2P and 2P + 1.
  template <int P>
  static constexpr int from = symmetric ? 2 * P : 0;

  // Columns 2P and 2P + 1 of L_k\U_k from those of D_k, and of X_k, which is written where a place is given. The middle node has no X_k.
  //
  // The reciprocal of the second pivot q - l u / p is p / (p q - l u): both divisions go on at once.
  template <int P, bool HasNext>
  HAWSER_INLINE void reduce(const double* diagonal, const double* given_column, double* worked, double* column) {
    constexpr int first = 2 * P, second = first + 1, rows = from<P>;
    using Pair = PairOf<B, P>;
    Pair d, c;
    d.template load<rows>(diagonal + B * first);
    if constexpr (HasNext) c.load_values(given_column + B * first);
    if constexpr (HasNext && symmetric) c.add_squares_to(watch.given);
    HAWSER_UNROLL for (int i = 0; i < first; ++i) {
      const auto u = symmetric ? Pair::transposed(worked_lower, first, i) : d.row(i);
      d.template subtract<rows>(lower[i], u);
      if constexpr (HasNext) c.subtract(x[i], u);
    }
    const double p = d.at(first, 0), reciprocal = 1.0 / p;
    const auto a = d.scaled_column(0, reciprocal);
    lower[first] = Pair::template zero_above<first + 1>(a);
    const auto with_reciprocal = Pair::template with_entry<first>(a, reciprocal);
    if constexpr (HasNext) x[first] = c.scaled_column(0, reciprocal);
    if constexpr (second == B) {
      watch.note_pivot(p), d.template add_squares_to<rows>(watch.worked);
      store_worked<P, HasNext>(worked, with_reciprocal, with_reciprocal);
      if (HasNext && column) Pair::store_columns(column + B * first, x[first], x[first]);
    } else {
      const double l = d.at(second, 0), u = symmetric ? l : d.at(first, 1);
      const double determinant = p * d.at(second, 1) - l * u, second_reciprocal = p / determinant;
      d.template subtract_from_second<rows>(lower[first], u);
      d.template add_squares_to<rows>(watch.worked);
      if constexpr (symmetric && second + 1 < B) d.template store<rows>(worked_lower + B * first);
      const auto b = d.scaled_column(1, second_reciprocal);
      lower[second] = Pair::template zero_above<second + 1>(b);
      store_worked<P, HasNext>(worked, with_reciprocal, Pair::template with_entry<second>(b, second_reciprocal));
      watch.note_pivots(p, determinant * reciprocal);
      if constexpr (HasNext) {
        c.subtract_from_second(x[first], u);
        x[second] = c.scaled_column(1, second_reciprocal);
        if (column) Pair::store_columns(column + B * first, x[first], x[second]);
      }
    }
    if constexpr (HasNext && symmetric) c.add_squares_to(watch.worked), c.store(worked_x + B * first);
  }

 private:
  template <int P, bool HasNext, class Multiplier>
  static HAWSER_INLINE void store_worked(double* block, const Multiplier& first, const Multiplier& second) {
    if constexpr (HasNext && upper_by_itself)
      PairOf<B, P>::template store_upper<P>(block, first, second);
    else
      PairOf<B, P>::template store_columns<from<P>>(block + 2 * B * P, first, second);
  }
};

// A front that goes from node to node. What is left of D_k waits beside the factors where these are not in its place, so that they are written once.
template <int B, Front Side, Factors F>
struct Elimination {
  using At = Layout<B, F>;
  static constexpr int block = B * B, towards_middle = Side == Front::left ? 1 : -1;
  const double *values, *next_values;  // of the front's node and of the next one
  double *factors, *column;            // column: where X_k goes, if it is kept
  double *b, *next_b;                  // nullptr: none
  double *diagonal, *next_diagonal;    // D_k and D_{k+1}
  double* first_factors;               // of the chain
  alignas(32) double waiting[B * B] = {};
  double aside[B] = {};  // a share of the middle node's b, which is taken anew from X
  Node<B, F> node;

  HAWSER_INLINE void begin(int nodes, FrontRun& run, double* chain_factors, double* chain_b) {
    const int k = node_of<Side>(nodes, run.first);
    first_factors = chain_factors, factors = chain_factors + At::at(k);
    values = run.values, next_values = inwards<Side>(values, 3 * block);
    b = chain_b ? chain_b + static_cast<long>(B) * k : nullptr, next_b = chain_b ? b + towards_middle * B : nullptr;
    diagonal = At::in_place ? factors : waiting, next_diagonal = At::in_place ? inwards<Side>(factors, At::node) : waiting;
    column = !At::spent ? factors + At::template column<Side> : nullptr;
    if (run.first == 0) run.given = take_over(values, diagonal);
    if (run.first > 0 && !At::in_place) copy(factors, waiting);
    node.watch.go_on(run.given);
  }
  HAWSER_INLINE void end(FrontRun& run, int count, PivotWatch& watch) {
    run.first += count, run.count -= count, run.given = node.watch.given.sum();
    run.values = values;
    if (!At::in_place && next_diagonal == waiting) copy(waiting, factors);
    node.watch.add_to(watch);
  }
  /// Before the last node. The right front leaves its share of the middle node aside, so that the left one need not wait; b of the middle takes
  /// both shares later.
  HAWSER_INLINE void meet(int nodes) {
    static constexpr double nothing[B * B] = {};
    if constexpr (Side == Front::right) next_values = nothing, next_diagonal = first_factors + At::left_at_middle(nodes);
    if constexpr (Side == Front::left && !At::in_place) next_diagonal = first_factors + At::middle(nodes);
    if constexpr (At::spent) column = first_factors + (Side == Front::left ? At::left_column(nodes) : At::right_column(nodes));
    next_b = aside;
  }

  template <int P>
  HAWSER_INLINE void reduce() {
    node.template reduce<P, true>(diagonal, inwards<Side>(values, 2 * block), factors, column);
  }
  // Columns 2P and 2P + 1 of Y_k, where it is not Delta_k X_k^T, and of what is left of the next node's D.
  template <int P>
  HAWSER_INLINE void update() {
    constexpr int first = 2 * B * P, rows = Node<B, F>::template from<P>;
    PairOf<B, P> y, d;
    d.template load_values<rows>(next_values + first), d.template add_squares_to<rows>(node.watch.given_next);
    if constexpr (At::symmetric) {
      HAWSER_UNROLL for (int i = 0; i < B; ++i) d.template subtract<rows>(node.x[i], PairOf<B, P>::transposed(node.worked_x, 2 * P, i));
    } else {
      y.load_values(inwards<Side>(values, block) + first), y.add_squares_to(node.watch.given);
      HAWSER_UNROLL for (int i = 0; i < B; ++i) {
        const auto u = y.row(i);
        if (i + 1 < B) y.subtract(node.lower[i], u);
        d.subtract(node.x[i], u);
      }
      y.add_squares_to(node.watch.worked);
      y.store(factors + At::template row<Side> + first);
    }
    d.template store<rows>(next_diagonal + first);
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
    if (At::in_place) diagonal = factors, next_diagonal = inwards<Side>(factors, At::node);
    if (!At::spent) column = factors + At::template column<Side>;
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
      constexpr int first = 2 * B * pair.value, rows = Node<B, F>::template from<pair.value>;
      PairOf<B, pair.value> d;
      d.template load_values<rows>(given + first), d.template store<rows>(to + first);
      d.template add_squares_to<rows>(sum);
    });
    return sum.sum();
  }
  static void copy(const double* from, double* to) {
    for (int i = 0; i < block; ++i) to[i] = from[i];
  }
};

template <int B, Front Side, Factors F>
void factorize_front(int nodes, FrontRun& run, double* factors, double* b, PivotWatch& watch) {
  const int count = run.count, met = nodes_of<Side>(nodes) - run.first;
  if (count == 0) return;
  Elimination<B, Side, F> front;
  front.begin(nodes, run, factors, b);
  for (int k = 1; k <= count; ++k) {
    if (k == met) front.meet(nodes);
    front.eliminate_node();
  }
  front.end(run, count, watch);
}

/// The next `count` nodes of both fronts, in turn.
template <int B, Factors F>
void factorize_in_turn(int nodes, int count, FrontRun& left_run, FrontRun& right_run, double* factors, double* b, PivotWatch& watch) {
  const int left_met = nodes_of<Front::left>(nodes) - left_run.first, right_met = nodes_of<Front::right>(nodes) - right_run.first;
  Elimination<B, Front::left, F> left;
  Elimination<B, Front::right, F> right;
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

// LU with 6 unknowns a node and more already fills the processor's window of instructions with one front: in turn is no faster.
template <int B, Factors F>
void eliminate_runs_of(int nodes, FrontRun& left, FrontRun& right, double* factors, double* b, PivotWatch& watch) {
  const int shared = left.count < right.count ? left.count : right.count;
  if constexpr (B == 3 || (B == 6 && F == Factors::ldlt)) {
    if (shared > 0) factorize_in_turn<B, F>(nodes, shared, left, right, factors, b, watch);
  }
  factorize_front<B, Front::left, F>(nodes, left, factors, b, watch);
  factorize_front<B, Front::right, F>(nodes, right, factors, b, watch);
}

template <int B, Factors F>
void factorize_middle_node(int nodes, const double* values, double* factors, PivotWatch& watch) {
  double* middle = factors + Layout<B, F>::middle(nodes);
  const double* from_right = factors + Layout<B, F>::left_at_middle(nodes);
  Node<B, F> node;
  node.watch.start();
  for_each_pair<B>([&] HAWSER_PAIR {
    constexpr int first = 2 * B * pair.value, rows = Node<B, F>::template from<pair.value>;
    PairOf<B, pair.value> d, r;
    d.template load_values<rows>(values + first), d.template add_squares_to<rows>(node.watch.given);
    if (nodes > 1) d.template load<rows>(middle + first);
    if (nodes > 2) r.template load<rows>(from_right + first), d.add(r);
    d.template store<rows>(middle + first);
    node.template reduce<pair.value, false>(middle, nullptr, middle, nullptr);
  });
  node.watch.end_node();
  node.watch.add_to(watch);
  for (int i = 0; i < B; ++i) watch.not_finite += 0.0 * middle[Panel<B, 2>::place(i, i)];  // a NaN anywhere before has come to here
}

template <int B, Factors F>
void factorize_any(int nodes, const double* values, double* factors, Front front, PivotWatch& watch) {
  FrontRun left{0, front == Front::right ? 0 : nodes_of<Front::left>(nodes), values};
  FrontRun right{0, front == Front::left ? 0 : nodes_of<Front::right>(nodes), values + 3L * B * B * (nodes - 1)};
  eliminate_runs_of<B, F>(nodes, left, right, factors, nullptr, watch);
}

template <int B, Factors F>
void forward_any(int nodes, const double* factors, double* b, Front front) {
  const FrontRun left{0, front == Front::right ? 0 : nodes_of<Front::left>(nodes), nullptr};
  const FrontRun right{0, front == Front::left ? 0 : nodes_of<Front::right>(nodes), nullptr};
  forward_runs<B, F>(nodes, left, right, factors, b);
}

template <int B, Factors F>
void backward_any(int nodes, const double* factors, double* b, Front front) {
  if (front == Front::both) backward_both<B, F>(nodes, factors, b);
  if (front == Front::left) backward_front<B, Front::left, F>(nodes, factors, b);
  if (front == Front::right) backward_front<B, Front::right, F>(nodes, factors, b);
}

template <Factors F>
struct Form {
  static constexpr Factors value = F;
};
/// f(Index<block>, known).
template <class Known, class Function>
void with_block(int block, Known known, Function f) {
  block == 3 ? f(Index<3>{}, known) : block == 6 ? f(Index<6>{}, known) : f(Index<7>{}, known);
}
/// f(Index<block>, Form<form>).
template <class Function>
void with_kept(int block, Factors form, Function f) {
  form == Factors::ldlt ? with_block(block, Form<Factors::ldlt>{}, f) : with_block(block, Form<Factors::lu>{}, f);
}
template <class Function>
void with_any(int block, Factors form, Function f) {
  form == Factors::spent_lu ? with_block(block, Form<Factors::spent_lu>{}, f) : with_kept(block, form, f);
}

void factorize(int block, int nodes, Factors form, const double* values, double* factors, Front front, PivotWatch& watch) {
  with_kept(block, form, [&](auto size, auto known) { factorize_any<size.value, known.value>(nodes, values, factors, front, watch); });
}

void eliminate_runs(int block, int nodes, Factors form, FrontRun& left, FrontRun& right, double* factors, double* b, PivotWatch& watch) {
  with_any(block, form, [&](auto size, auto known) { eliminate_runs_of<size.value, known.value>(nodes, left, right, factors, b, watch); });
}

void factorize_middle(int block, int nodes, Factors form, const double* values, double* factors, PivotWatch& watch) {
  with_any(block, form, [&](auto size, auto known) { factorize_middle_node<size.value, known.value>(nodes, values, factors, watch); });
}

void forward(int block, int nodes, Factors form, const double* factors, double* b, Front front) {
  with_kept(block, form, [&](auto size, auto known) { forward_any<size.value, known.value>(nodes, factors, b, front); });
}

void solve_middle(int block, int nodes, Factors form, const double* factors, double* b) {
  with_any(block, form, [&](auto size, auto known) { solve_middle_node<size.value, known.value>(nodes, factors, b); });
}

void backward(int block, int nodes, Factors form, const double* factors, double* b, Front front) {
  with_any(block, form, [&](auto size, auto known) { backward_any<size.value, known.value>(nodes, factors, b, front); });
}

}  // namespace

}  // namespace hawser
