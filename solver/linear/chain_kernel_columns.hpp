// Neighbouring columns of a block, worked on together, for chain_kernel_body.hpp: one by one, or two of six rows in three full packs.
#pragma once

#include "solver/linear/chain_kernel_packs.hpp"

namespace hawser {

namespace {

// Neighbouring columns of a block, worked on together: column by column.
template <int B, int Columns>
struct ColumnwisePanel {
  using Multiplier = Column<B>;
  using Squares = Column<B>;
  struct Row {
    double u[Columns];
  };
  Column<B> column[Columns];

  /// Where entry (i, j) of a block of factors lies, and its column j.
  static constexpr int place(int i, int j) { return B * j + i; }
  /// Entry (i, j), i <= j, of U_k stored by itself, and the room it takes.
  static constexpr int upper_place(int i, int j) { return place(i, j); }
  static constexpr int upper_size = B * B;
  static HAWSER_INLINE Column<B> factor_column(const double* block, int j) {
    Column<B> c;
    c.load(block + B * j);
    return c;
  }

  template <int From = 0>
  HAWSER_INLINE void load_values(const double* p) {
    load<From>(p);
  }
  template <int From = 0>
  HAWSER_INLINE void load(const double* p) {
    HAWSER_UNROLL for (int j = 0; j < Columns; ++j) column[j].template load<From>(p + B * j);
  }
  template <int From = 0>
  HAWSER_INLINE void store(double* p) const {
    HAWSER_UNROLL for (int j = 0; j < Columns; ++j) column[j].template store<From>(p + B * j);
  }
  HAWSER_INLINE double at(int i, int j) const { return column[j].at(i); }
  HAWSER_INLINE Row row(int i) const {
    Row r;
    HAWSER_UNROLL for (int j = 0; j < Columns; ++j) r.u[j] = column[j].at(i);
    return r;
  }
  /// Entries `first` and the next of column i of a block of factors, as a row.
  static HAWSER_INLINE Row transposed(const double* block, int first, int i) {
    Row r;
    HAWSER_UNROLL for (int j = 0; j < Columns; ++j) r.u[j] = block[place(first + j, i)];
    return r;
  }
  HAWSER_INLINE void add(const ColumnwisePanel& p) { HAWSER_UNROLL for (int j = 0; j < Columns; ++j) column[j].add(p.column[j]); }
  template <int From = 0>
  HAWSER_INLINE void subtract(const Multiplier& m, const Row& r) {
    HAWSER_UNROLL for (int j = 0; j < Columns; ++j) column[j].template subtract<From>(m, r.u[j]);
  }
  template <int From = 0>
  HAWSER_INLINE void subtract_from_second(const Multiplier& m, double u) {
    column[1].template subtract<From>(m, u);
  }
  template <int From = 0>
  HAWSER_INLINE void add_squares_to(Squares& sum) const {
    HAWSER_UNROLL for (int j = 0; j < Columns; ++j) sum.template add_squares<From>(column[j]);
  }

  HAWSER_INLINE Multiplier scaled_column(int j, double s) const {
    Multiplier m = column[j];
    m.scale(s);
    return m;
  }
  template <int First>
  static HAWSER_INLINE Multiplier zero_above(const Multiplier& m) {
    Multiplier result;
    result.set_all(0.0);
    result.replace_from(First, m);
    return result;
  }
  template <int At>
  static HAWSER_INLINE Multiplier with_entry(const Multiplier& m, double value) {
    Multiplier result = m, all;
    all.set_all(value);
    result.replace_from(At, all);
    result.replace_from(At + 1, m);
    return result;
  }
  template <int From = 0>
  static HAWSER_INLINE void store_columns(double* p, const Multiplier& first, const Multiplier& second) {
    first.template store<From>(p);
    if constexpr (Columns == 2) second.template store<From>(p + B);
  }
  template <int P>
  static HAWSER_INLINE void store_upper(double* block, const Multiplier& first, const Multiplier& second) {
    store_columns(block + 2 * B * P, first, second);
  }
  static HAWSER_INLINE void subtract(Column<B>& c, const Multiplier& m, double u) { c.subtract(m, u); }

  /// y_j -= z . column j of a block of factors.
  static HAWSER_INLINE void subtract_transposed(double* y, const double* block, const Column<B>& z) {
    HAWSER_UNROLL for (int j = 0; j < B; ++j) y[j] -= factor_column(block, j).dot(z);
  }
};

#if HAWSER_WIDEST_PACK == 4
// Two columns of six as three full packs: rows 0 to 3 of either, and rows 4 and 5 of both. Factors are stored in this order.
struct PairOfSix {
  using Doubles = Pack<4>::Doubles;
  using Rows = Pack<4>::Rows;
  struct Multiplier {
    Doubles head, tail;  // rows 4 and 5 twice
  };
  using Squares = Pack<4>;
  struct Row {
    Doubles first, second, both;
  };
  Doubles first, second, tails;

  static constexpr int place(int i, int j) { return 12 * (j / 2) + (i < 4 ? 4 * (j % 2) + i : 2 * (j % 2) + i + 4); }
  // Of the columns of U_k, in pairs: rows 0 and 1, rows 0 to 3, all rows.
  static constexpr int upper_place(int i, int j) { return j < 2 ? 2 * j + i : j < 4 ? 4 * (j - 1) + i : place(i, j) - 12; }
  static constexpr int upper_size = 24;
  static HAWSER_INLINE Column<6> factor_column(const double* block, int j) {
    Column<6> c;
    c.load_parts(block + place(0, j), block + place(4, j));
    return c;
  }

  template <int From = 0>
  HAWSER_INLINE void load_values(const double* p) {
    Pack<2> lower, upper;
    lower.load(p + 4), upper.load(p + 10);
    load_heads<From>(p, p + 6);
    tails = Doubles{lower.v[0], lower.v[1], upper.v[0], upper.v[1]};
  }
  template <int From = 0>
  HAWSER_INLINE void load(const double* p) {
    Pack<4> c;
    c.load(p + 8);
    load_heads<From>(p, p + 4);
    tails = c.v;
  }
  template <int From = 0>
  HAWSER_INLINE void store(double* p) const {
    if constexpr (From < 4) Pack<4>{first}.store(p), Pack<4>{second}.store(p + 4);
    Pack<4>{tails}.store(p + 8);
  }
  HAWSER_INLINE double at(int i, int j) const { return i >= 4 ? tails[2 * j + i - 4] : j == 0 ? first[i] : second[i]; }
  HAWSER_INLINE Row row(int i) const {
    if (i >= 4) {
      const long long k = i - 4;
      return {lanes(tails, k, k, k, k), lanes(tails, k + 2, k + 2, k + 2, k + 2), lanes(tails, k, k, k + 2, k + 2)};
    }
    Row r{lanes(first, i, i, i, i), lanes(second, i, i, i, i), {}};
    r.both = select<12>(r.first, r.second);
    return r;
  }
  static HAWSER_INLINE Row transposed(const double* block, int at, int i) {
    Row r{PackTypes<4>::filled(block[place(at, i)]), PackTypes<4>::filled(block[place(at + 1, i)]), {}};
    r.both = select<12>(r.first, r.second);
    return r;
  }
  HAWSER_INLINE void add(const PairOfSix& p) { first += p.first, second += p.second, tails += p.tails; }
  template <int From = 0>
  HAWSER_INLINE void subtract(const Multiplier& m, const Row& r) {
    if constexpr (From < 4) first -= m.head * r.first, second -= m.head * r.second;
    tails -= m.tail * r.both;
  }
  template <int From = 0>
  HAWSER_INLINE void subtract_from_second(const Multiplier& m, double u) {
    const Doubles all = {u, u, u, u};
    if constexpr (From < 4) second -= m.head * all;
    tails -= select<12>(Doubles{}, m.tail) * all;
  }
  template <int From = 0>
  HAWSER_INLINE void add_squares_to(Squares& sum) const {
    if constexpr (From < 4) sum.add_squares({first}), sum.add_squares({second});
    sum.add_squares({tails});
  }

  HAWSER_INLINE Multiplier scaled_column(int j, double s) const {
    const Doubles all = {s, s, s, s};
    if (j == 0) return {first * all, lanes(tails, 0, 1, 0, 1) * all};
    return {second * all, lanes(tails, 2, 3, 2, 3) * all};
  }
  template <int First>
  static HAWSER_INLINE Multiplier zero_above(const Multiplier& m) {
    constexpr int tail = First <= 4 ? 15 : First == 5 ? 10 : 0;
    return {select<(15 << First) & 15>(Doubles{}, m.head), select<tail>(Doubles{}, m.tail)};
  }
  template <int At>
  static HAWSER_INLINE Multiplier with_entry(const Multiplier& m, double value) {
    const Doubles all = {value, value, value, value};
    if constexpr (At < 4) return {select<1 << At>(m.head, all), m.tail};
    return {m.head, select < At == 4 ? 5 : 10 > (m.tail, all)};
  }
  template <int From = 0>
  static HAWSER_INLINE void store_columns(double* p, const Multiplier& a, const Multiplier& b) {
    if constexpr (From < 4) Pack<4>{a.head}.store(p), Pack<4>{b.head}.store(p + 4);
    Pack<4>{select<12>(a.tail, b.tail)}.store(p + 8);
  }
  template <int P>
  static HAWSER_INLINE void store_upper(double* block, const Multiplier& a, const Multiplier& b) {
    double* p = block + upper_place(0, 2 * P);
    if constexpr (P == 0) Pack<4>{__builtin_shufflevector(a.head, b.head, 0, 1, 4, 5)}.store(p);
    if constexpr (P == 1) Pack<4>{a.head}.store(p), Pack<4>{b.head}.store(p + 4);
    if constexpr (P == 2) store_columns(p, a, b);
  }
  static HAWSER_INLINE void subtract(Column<6>& c, const Multiplier& m, double u) {
    c.head.v -= m.head * u, c.tail.head.v -= __builtin_shufflevector(m.tail, m.tail, 0, 1) * u;
  }

  static HAWSER_INLINE void subtract_transposed(double* y, const double* block, const Column<6>& z) {
    const Doubles tail = __builtin_shufflevector(z.tail.head.v, z.tail.head.v, 0, 1, 0, 1);
    HAWSER_UNROLL for (int j = 0; j < 6; j += 2) {
      PairOfSix c;
      c.load(block + 6 * j);
      const Doubles a = c.first * z.head.v, b = c.second * z.head.v, both = c.tails * tail;
      const auto p = half(a, 0) + half(a, 1) + half(both, 0), q = half(b, 0) + half(b, 1) + half(both, 1);
      y[j] -= p[0] + p[1], y[j + 1] -= q[0] + q[1];
    }
  }

 private:
  static HAWSER_INLINE PackTypes<2>::Doubles half(Doubles v, int i) {
    return i == 0 ? __builtin_shufflevector(v, v, 0, 1) : __builtin_shufflevector(v, v, 2, 3);
  }
  template <int From>
  HAWSER_INLINE void load_heads(const double* a, const double* b) {
    Pack<4> p, q;
    if constexpr (From < 4) p.load(a), q.load(b);
    if constexpr (From >= 4) p.set_all(0.0), q.set_all(0.0);
    first = p.v, second = q.v;
  }
  static HAWSER_INLINE Doubles lanes(Doubles v, long long i, long long j, long long k, long long l) {
#ifdef __clang__  // which has no such shuffle
    return Doubles{v[i], v[j], v[k], v[l]};
#else
    return __builtin_shuffle(v, Rows{i, j, k, l});
#endif
  }

  // Lanes whose bit is set from b, the others from a. The integer form of the instruction: the other one takes the place of a product.
  template <int Bits>
  static HAWSER_INLINE Doubles select(Doubles a, Doubles b) {
    typedef int Halves __attribute__((vector_size(32)));
    constexpr int halves = (Bits & 1 ? 3 : 0) | (Bits & 2 ? 12 : 0) | (Bits & 4 ? 48 : 0) | (Bits & 8 ? 192 : 0);
    return (Doubles)__builtin_ia32_pblendd256((Halves)a, (Halves)b, halves);
  }
};
#endif

template <int B, int Columns>
struct PanelOf {
  using Type = ColumnwisePanel<B, Columns>;
};
#if HAWSER_WIDEST_PACK == 4
template <>
struct PanelOf<6, 2> {
  using Type = PairOfSix;
};
#endif
template <int B, int Columns>
using Panel = typename PanelOf<B, Columns>::Type;

}  // namespace

}  // namespace hawser
