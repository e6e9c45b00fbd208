// The kernel of chain_kernel.hpp, compiled once for each instruction set by the chain_kernel*.cpp files.
//
// Everything here has internal linkage and nothing comes from other headers: an inline function shared with another file could be kept
// by the linker in the wrong instruction set. The including file defines HAWSER_WIDEST_PACK: the compiler does not define __AVX__ after a
// target pragma.
#pragma once

#include "solver/linear/chain_kernel.hpp"

#define HAWSER_INLINE __attribute__((always_inline)) inline
#define HAWSER_UNROLL _Pragma("GCC unroll 12")

namespace hawser {

namespace {

constexpr int widest_pack = HAWSER_WIDEST_PACK;

// Lanes of one pack; masks are compile-time constants once the loops around them are unrolled.
template <int Lanes>
struct Pack {
  typedef double Doubles __attribute__((vector_size(8 * Lanes)));
  typedef double Unaligned __attribute__((vector_size(8 * Lanes), aligned(8), may_alias));
  typedef long long Rows __attribute__((vector_size(8 * Lanes)));
  Doubles v;

  HAWSER_INLINE void load(const double* p) { v = *reinterpret_cast<const Unaligned*>(p); }
  HAWSER_INLINE void store(double* p) const { *reinterpret_cast<Unaligned*>(p) = v; }
};

template <>
struct Pack<1> {
  typedef double Doubles;
  double v;

  HAWSER_INLINE void load(const double* p) { v = *p; }
  HAWSER_INLINE void store(double* p) const { *p = v; }
};

// A column of Rows entries: as many of the widest packs as fit, then narrower ones (6 = 4 + 2, 3 = 2 + 1).
template <int Rows>
struct Column {
  static constexpr int lanes = Rows >= widest_pack ? widest_pack : Rows >= 2 ? 2 : 1;
  Pack<lanes> head;
  Column<Rows - lanes> tail;

  static HAWSER_INLINE typename Pack<lanes>::Doubles zeros() { return typename Pack<lanes>::Doubles{}; }
  static HAWSER_INLINE typename Pack<lanes>::Doubles ones() { return zeros() + 1.0; }

  HAWSER_INLINE void load(const double* p) { head.load(p), tail.load(p + lanes); }
  HAWSER_INLINE void store(double* p) const { head.store(p), tail.store(p + lanes); }
  HAWSER_INLINE void set_all(double s) { head.v = zeros() + s, tail.set_all(s); }
  HAWSER_INLINE void scale(double s) { head.v *= s, tail.scale(s); }
  HAWSER_INLINE void subtract(const Column& c, double s) { head.v -= c.head.v * s, tail.subtract(c.tail, s); }
  HAWSER_INLINE void add_squares(const Column& c) { head.v += c.head.v * c.head.v, tail.add_squares(c.tail); }

  HAWSER_INLINE void add_zero_times(const Column& c) { head.v += c.head.v * 0.0, tail.add_zero_times(c.tail); }
  HAWSER_INLINE void count_negatives(const Column& c) { head.v += c.head.v < 0.0 ? ones() : zeros(), tail.count_negatives(c.tail); }
  HAWSER_INLINE void keep_smaller_and_larger(const Column& c, Column& larger) {
    const auto size = c.head.v < 0.0 ? -c.head.v : c.head.v;
    head.v = size < head.v ? size : head.v;
    larger.head.v = size > larger.head.v ? size : larger.head.v;
    tail.keep_smaller_and_larger(c.tail, larger.tail);
  }

  HAWSER_INLINE double at(int i) const {
    if (i >= lanes) return tail.at(i - lanes);
    if constexpr (lanes == 1)
      return head.v;
    else
      return head.v[i];
  }
  HAWSER_INLINE double sum() const {
    double s = tail.sum();
    HAWSER_UNROLL for (int i = 0; i < lanes; ++i) s += at(i);
    return s;
  }

  /// Takes the entries from row `first` on from c.
  HAWSER_INLINE void replace_from(int first, const Column& c) {
    if (first < lanes) {
      if constexpr (lanes == 1) {
        head.v = c.head.v;
      } else {
        typename Pack<lanes>::Rows row;
        HAWSER_UNROLL for (int i = 0; i < lanes; ++i) row[i] = i;
        head.v = row >= first ? c.head.v : head.v;
      }
    }
    tail.replace_from(first - lanes, c.tail);
  }
};

template <>
struct Column<0> {
  HAWSER_INLINE void load(const double*) {}
  HAWSER_INLINE void store(double*) const {}
  HAWSER_INLINE void set_all(double) {}
  HAWSER_INLINE void scale(double) {}
  HAWSER_INLINE void subtract(const Column&, double) {}
  HAWSER_INLINE void add_squares(const Column&) {}
  HAWSER_INLINE void add_zero_times(const Column&) {}
  HAWSER_INLINE void count_negatives(const Column&) {}
  HAWSER_INLINE void keep_smaller_and_larger(const Column&, Column&) {}
  HAWSER_INLINE double at(int) const { return 0.0; }
  HAWSER_INLINE double sum() const { return 0.0; }
  HAWSER_INLINE void replace_from(int, const Column&) {}
};

// PivotWatch by rows of a node, so that no entry leaves its lane in the loop.
template <int B>
struct ColumnWatch {
  Column<B> smallest, largest, not_finite, negative;
  double growth_squared = 0.0;

  HAWSER_INLINE void start() { smallest.set_all(__builtin_inf()), largest.set_all(0.0), not_finite.set_all(0.0), negative.set_all(0.0); }
  HAWSER_INLINE void note(const Column<B>& pivots, double growth) {
    smallest.keep_smaller_and_larger(pivots, largest);
    not_finite.add_zero_times(pivots);
    negative.count_negatives(pivots);
    growth_squared = growth > growth_squared ? growth : growth_squared;
  }
  void add_to(PivotWatch& watch) const {
    for (int i = 0; i < B; ++i) {
      if (smallest.at(i) < watch.smallest) watch.smallest = smallest.at(i);
      if (largest.at(i) > watch.largest) watch.largest = largest.at(i);
    }
    if (growth_squared > watch.growth_squared) watch.growth_squared = growth_squared;
    watch.not_finite += not_finite.sum();
    watch.negative += static_cast<int>(negative.sum());
  }
};

// Factorizes one node. In `factors`: D_k reduced by the nodes before, which becomes L_k\U_k. Leaves Y_k and X_k behind it, and D_{k+1}
// reduced in the next node's place. `last` has no U and L.
template <int B>
HAWSER_INLINE void eliminate_node(const double* __restrict values, double* __restrict factors, bool last, ColumnWatch<B>& watch) {
  constexpr int block = B * B;
  const double *upper = values + block, *lower = values + 2 * block, *next = values + 3 * block;
  Column<B> multiplier[B];  // columns of L_k, zero down to the diagonal
  Column<B> x[B], zero, pivots, given, worked;
  zero.set_all(0.0), given.set_all(0.0), worked.set_all(0.0), pivots.set_all(0.0);
  HAWSER_UNROLL for (int j = 0; j < 2 * B; ++j) {  // D and U lie one behind the other
    Column<B> column;
    column.load(values + B * j);
    given.add_squares(column);
  }
  const double given_squared = given.sum();

  HAWSER_UNROLL for (int j = 0; j < B; ++j) {
    Column<B> d;
    d.load(factors + B * j), x[j].load(lower + B * j);
    HAWSER_UNROLL for (int i = 0; i < j; ++i) {
      const double u = d.at(i);
      d.subtract(multiplier[i], u), x[j].subtract(x[i], u);
    }
    worked.add_squares(d);
    const double reciprocal = 1.0 / d.at(j);
    pivots.replace_from(j, d);
    x[j].scale(reciprocal);
    multiplier[j] = zero;
    multiplier[j].replace_from(j + 1, d);
    multiplier[j].scale(reciprocal);
    Column<B> diagonal;
    diagonal.set_all(reciprocal);
    d.replace_from(j, diagonal);
    d.replace_from(j + 1, multiplier[j]);
    d.store(factors + B * j), x[j].store(factors + 2 * block + B * j);
  }

  HAWSER_UNROLL for (int j = 0; j < B; ++j) {
    if (last) break;
    Column<B> y, d;
    y.load(upper + B * j), d.load(next + B * j);
    HAWSER_UNROLL for (int i = 0; i < B; ++i) {
      const double u = y.at(i);
      if (i + 1 < B) y.subtract(multiplier[i], u);
      d.subtract(x[i], u);
    }
    worked.add_squares(y);
    y.store(factors + block + B * j), d.store(factors + 3 * block + B * j);
  }
  watch.note(pivots, worked.sum() / given_squared);
}

template <int B>
void factorize_chain(int nodes, const double* __restrict values, double* __restrict factors, PivotWatch& watch) {
  constexpr int node_values = 3 * B * B;
  HAWSER_UNROLL for (int i = 0; i < B * B; ++i) factors[i] = values[i];
  ColumnWatch<B> local;
  local.start();
  for (int k = 0; k + 1 < nodes; ++k) {
    eliminate_node<B>(values, factors, false, local);
    values += node_values, factors += node_values;
  }
  eliminate_node<B>(values, factors, true, local);
  local.add_to(watch);
}

// Scalar on purpose: the recurrence from unknown to unknown is bound by latency, and moving entries in and out of packs doubles it.
template <int B>
__attribute__((optimize("no-tree-vectorize"))) void solve_chain(int nodes, const double* __restrict factors, double* __restrict b) {
  constexpr int block = B * B, node_values = 3 * block;
  double c[B], z[B];
  HAWSER_UNROLL for (int i = 0; i < B; ++i) z[i] = 0.0;
  for (int k = 0; k < nodes; ++k, factors += node_values, b += B) {
    HAWSER_UNROLL for (int i = 0; i < B; ++i) c[i] = b[i];
    if (k > 0) {
      HAWSER_UNROLL for (int j = 0; j < B; ++j) { HAWSER_UNROLL for (int i = 0; i < B; ++i) c[i] -= factors[B * j + i - block] * z[j]; }
    }
    HAWSER_UNROLL for (int j = 0; j < B; ++j) {
      HAWSER_UNROLL for (int i = j + 1; i < B; ++i) c[i] -= factors[B * j + i] * c[j];
      b[j] = z[j] = c[j];
    }
  }
  for (int k = nodes - 1; k >= 0; --k) {
    factors -= node_values, b -= B;
    HAWSER_UNROLL for (int i = 0; i < B; ++i) c[i] = b[i];
    if (k + 1 < nodes) {
      HAWSER_UNROLL for (int j = B - 1; j >= 0; --j) { HAWSER_UNROLL for (int i = 0; i < B; ++i) c[i] -= factors[block + B * j + i] * z[j]; }
    }
    HAWSER_UNROLL for (int j = B - 1; j >= 0; --j) {
      c[j] *= factors[B * j + j];
      HAWSER_UNROLL for (int i = 0; i < j; ++i) c[i] -= factors[B * j + i] * c[j];
      b[j] = z[j] = c[j];
    }
  }
}

void factorize(int block, int nodes, const double* values, double* factors, PivotWatch& watch) {
  if (nodes == 0) return;
  if (block == 3) factorize_chain<3>(nodes, values, factors, watch);
  if (block == 6) factorize_chain<6>(nodes, values, factors, watch);
}

void solve(int block, int nodes, const double* factors, double* b) {
  if (block == 3) solve_chain<3>(nodes, factors, b);
  if (block == 6) solve_chain<6>(nodes, factors, b);
}

}  // namespace

}  // namespace hawser
