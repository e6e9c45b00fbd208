// Columns of a block in registers, for chain_kernel_body.hpp.
//
// Everything here has internal linkage and nothing comes from other headers: an inline function shared with another file could be kept
// by the linker in the wrong instruction set. The including file defines HAWSER_WIDEST_PACK, 4 where AVX2 may be used and else 2: the
// compiler does not define __AVX2__ after a target pragma.
#pragma once

#define HAWSER_INLINE __attribute__((always_inline)) inline
#define HAWSER_UNROLL _Pragma("GCC unroll 12")

namespace hawser {

namespace {

constexpr int widest_pack = HAWSER_WIDEST_PACK;

template <int Lanes>
struct PackTypes;
template <>
struct PackTypes<2> {
  typedef double Doubles __attribute__((vector_size(16)));
  typedef double Unaligned __attribute__((vector_size(16), aligned(8), may_alias));
  typedef long long Rows __attribute__((vector_size(16)));
  static HAWSER_INLINE Doubles filled(double s) { return Doubles{s, s}; }
  static HAWSER_INLINE Rows rows() { return Rows{0, 1}; }
  static HAWSER_INLINE double sum(Doubles v) { return v[0] + v[1]; }
#ifdef __x86_64__  // the compiler makes two instructions of the conditional
  static HAWSER_INLINE Doubles larger(Doubles a, Doubles b) { return __builtin_ia32_maxpd(a, b); }
  static HAWSER_INLINE Doubles smaller(Doubles a, Doubles b) { return __builtin_ia32_minpd(a, b); }
#else
  static HAWSER_INLINE Doubles larger(Doubles a, Doubles b) { return a > b ? a : b; }
  static HAWSER_INLINE Doubles smaller(Doubles a, Doubles b) { return a < b ? a : b; }
#endif
};
#if HAWSER_WIDEST_PACK == 4
template <>
struct PackTypes<4> {
  typedef double Doubles __attribute__((vector_size(32)));
  typedef double Unaligned __attribute__((vector_size(32), aligned(8), may_alias));
  typedef long long Rows __attribute__((vector_size(32)));
  static HAWSER_INLINE Doubles filled(double s) { return Doubles{s, s, s, s}; }
  static HAWSER_INLINE Rows rows() { return Rows{0, 1, 2, 3}; }
  static HAWSER_INLINE double sum(Doubles v) { return PackTypes<2>::sum(__builtin_shufflevector(v, v, 0, 1) + __builtin_shufflevector(v, v, 2, 3)); }
};
#endif

template <int Lanes>
struct Pack {
  using Doubles = typename PackTypes<Lanes>::Doubles;
  using Unaligned = typename PackTypes<Lanes>::Unaligned;
  using Rows = typename PackTypes<Lanes>::Rows;
  Doubles v;

  HAWSER_INLINE void load(const double* p) { v = *reinterpret_cast<const Unaligned*>(p); }
  HAWSER_INLINE void store(double* p) const { *reinterpret_cast<Unaligned*>(p) = v; }
  HAWSER_INLINE double at(int i) const { return v[i]; }
  HAWSER_INLINE void set_all(double s) { v = PackTypes<Lanes>::filled(s); }
  HAWSER_INLINE void add_squares(const Pack& p) { v += p.v * p.v; }
  HAWSER_INLINE double sum() const { return PackTypes<Lanes>::sum(v); }

  /// Takes the entries from lane `first` on from p.
  HAWSER_INLINE void replace_from(int first, const Pack& p) { v = PackTypes<Lanes>::rows() >= first ? p.v : v; }
};

template <>
struct Pack<1> {
  double v;

  HAWSER_INLINE void load(const double* p) { v = *p; }
  HAWSER_INLINE void store(double* p) const { *p = v; }
  HAWSER_INLINE double at(int) const { return v; }
  HAWSER_INLINE void set_all(double s) { v = s; }
  HAWSER_INLINE void add_squares(const Pack& p) { v += p.v * p.v; }
  HAWSER_INLINE double sum() const { return v; }
  HAWSER_INLINE void replace_from(int first, const Pack& p) { v = first <= 0 ? p.v : v; }
};

// A column of Rows entries: as many of the widest packs as fit, then narrower ones (6 = 4 + 2, 3 = 2 + 1).
template <int Rows>
struct Column {
  static constexpr int lanes = Rows >= widest_pack ? widest_pack : Rows >= 2 ? 2 : 1;
  Pack<lanes> head;
  Column<Rows - lanes> tail;

  HAWSER_INLINE void load(const double* p) { head.load(p), tail.load(p + lanes); }
  HAWSER_INLINE void load(const double* p, const double* tail_at) { head.load(p), tail.load(tail_at); }
  HAWSER_INLINE void store(double* p) const { head.store(p), tail.store(p + lanes); }
  HAWSER_INLINE void set_all(double s) { head.set_all(s), tail.set_all(s); }
  HAWSER_INLINE void scale(double s) { head.v *= s, tail.scale(s); }
  HAWSER_INLINE void subtract(const Column& c, double s) { head.v -= c.head.v * s, tail.subtract(c.tail, s); }
  HAWSER_INLINE void add(const Column& c) { head.v += c.head.v, tail.add(c.tail); }
  HAWSER_INLINE void add_squares(const Column& c) { head.add_squares(c.head), tail.add_squares(c.tail); }
  HAWSER_INLINE double sum() const { return head.sum() + tail.sum(); }
  HAWSER_INLINE double at(int i) const { return i < lanes ? head.at(i) : tail.at(i - lanes); }
  HAWSER_INLINE void replace_from(int first, const Column& c) {
    if (first < lanes) head.replace_from(first, c.head);
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
  HAWSER_INLINE void add(const Column&) {}
  HAWSER_INLINE void add_squares(const Column&) {}
  HAWSER_INLINE double sum() const { return 0.0; }
  HAWSER_INLINE double at(int) const { return 0.0; }
  HAWSER_INLINE void replace_from(int, const Column&) {}
};

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
  static HAWSER_INLINE Column<B> factor_column(const double* block, int j) {
    Column<B> c;
    c.load(block + B * j);
    return c;
  }

  HAWSER_INLINE void load_values(const double* p) { load(p); }
  HAWSER_INLINE void load(const double* p) { HAWSER_UNROLL for (int j = 0; j < Columns; ++j) column[j].load(p + B * j); }
  HAWSER_INLINE void store(double* p) const { HAWSER_UNROLL for (int j = 0; j < Columns; ++j) column[j].store(p + B * j); }
  HAWSER_INLINE double at(int i, int j) const { return column[j].at(i); }
  HAWSER_INLINE Row row(int i) const {
    Row r;
    HAWSER_UNROLL for (int j = 0; j < Columns; ++j) r.u[j] = column[j].at(i);
    return r;
  }
  HAWSER_INLINE void add(const ColumnwisePanel& p) { HAWSER_UNROLL for (int j = 0; j < Columns; ++j) column[j].add(p.column[j]); }
  HAWSER_INLINE void subtract(const Multiplier& m, const Row& r) { HAWSER_UNROLL for (int j = 0; j < Columns; ++j) column[j].subtract(m, r.u[j]); }
  HAWSER_INLINE void subtract_from_second(const Multiplier& m, double u) { column[1].subtract(m, u); }
  HAWSER_INLINE void add_squares_to(Squares& sum) const { HAWSER_UNROLL for (int j = 0; j < Columns; ++j) sum.add_squares(column[j]); }

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
  static HAWSER_INLINE void store_columns(double* p, const Multiplier& first, const Multiplier& second) {
    first.store(p);
    if constexpr (Columns == 2) second.store(p + B);
  }
  static HAWSER_INLINE void subtract(Column<B>& c, const Multiplier& m, double u) { c.subtract(m, u); }
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
  static HAWSER_INLINE Column<6> factor_column(const double* block, int j) {
    Column<6> c;
    c.load(block + place(0, j), block + place(4, j));
    return c;
  }

  HAWSER_INLINE void load_values(const double* p) {
    Pack<2> lower, upper;
    Pack<4> a, b;
    a.load(p), b.load(p + 6), lower.load(p + 4), upper.load(p + 10);
    first = a.v, second = b.v;
    tails = Doubles{lower.v[0], lower.v[1], upper.v[0], upper.v[1]};
  }
  HAWSER_INLINE void load(const double* p) {
    Pack<4> a, b, c;
    a.load(p), b.load(p + 4), c.load(p + 8);
    first = a.v, second = b.v, tails = c.v;
  }
  HAWSER_INLINE void store(double* p) const { Pack<4>{first}.store(p), Pack<4>{second}.store(p + 4), Pack<4>{tails}.store(p + 8); }
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
  HAWSER_INLINE void add(const PairOfSix& p) { first += p.first, second += p.second, tails += p.tails; }
  HAWSER_INLINE void subtract(const Multiplier& m, const Row& r) { first -= m.head * r.first, second -= m.head * r.second, tails -= m.tail * r.both; }
  HAWSER_INLINE void subtract_from_second(const Multiplier& m, double u) {
    const Doubles all = {u, u, u, u};
    second -= m.head * all, tails -= select<12>(Doubles{}, m.tail) * all;
  }
  HAWSER_INLINE void add_squares_to(Squares& sum) const { sum.add_squares({first}), sum.add_squares({second}), sum.add_squares({tails}); }

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
  static HAWSER_INLINE void store_columns(double* p, const Multiplier& a, const Multiplier& b) {
    Pack<4>{a.head}.store(p), Pack<4>{b.head}.store(p + 4), Pack<4>{select<12>(a.tail, b.tail)}.store(p + 8);
  }
  static HAWSER_INLINE void subtract(Column<6>& c, const Multiplier& m, double u) {
    c.head.v -= m.head * u, c.tail.head.v -= __builtin_shufflevector(m.tail, m.tail, 0, 1) * u;
  }

 private:
  static HAWSER_INLINE Doubles lanes(Doubles v, long long i, long long j, long long k, long long l) { return __builtin_shuffle(v, Rows{i, j, k, l}); }

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
