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
  static HAWSER_INLINE Doubles gathered(const double* p) { return Doubles{p[0], p[1]}; }
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
  static HAWSER_INLINE Doubles gathered(const double* p) { return Doubles{p[0], p[1], p[2], p[3]}; }
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
  HAWSER_INLINE void gather(const double* p) { v = PackTypes<Lanes>::gathered(p); }
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
  HAWSER_INLINE void gather(const double* p) { v = *p; }
  HAWSER_INLINE double at(int) const { return v; }
  HAWSER_INLINE void set_all(double s) { v = s; }
  HAWSER_INLINE void add_squares(const Pack& p) { v += p.v * p.v; }
  HAWSER_INLINE double sum() const { return v; }
  HAWSER_INLINE void replace_from(int first, const Pack& p) { v = first <= 0 ? p.v : v; }
};

// A column of Rows entries: as many of the widest packs as fit, then narrower ones (7 = 4 + 2 + 1, 6 = 4 + 2, 3 = 2 + 1).
//
// Where a row `From` is given, packs that lie above it wholly take no part: they are zero once loaded, and neither read nor written.
template <int Rows>
struct Column {
  static constexpr int lanes = Rows >= widest_pack ? widest_pack : Rows >= 2 ? 2 : 1;
  static constexpr int in_tail(int row) { return row > lanes ? row - lanes : 0; }
  Pack<lanes> head;
  Column<Rows - lanes> tail;

  template <int From = 0>
  HAWSER_INLINE void load(const double* p) {
    if constexpr (From < lanes) head.load(p);
    if constexpr (From >= lanes) head.set_all(0.0);
    tail.template load<in_tail(From)>(p + lanes);
  }
  HAWSER_INLINE void load_parts(const double* p, const double* tail_at) { head.load(p), tail.load(tail_at); }
  template <int From = 0>
  HAWSER_INLINE void store(double* p) const {
    if constexpr (From < lanes) head.store(p);
    tail.template store<in_tail(From)>(p + lanes);
  }
  /// From scalars that may still be in registers: a load so soon after their stores would wait for the cache.
  HAWSER_INLINE void gather(const double* p) { head.gather(p), tail.gather(p + lanes); }
  HAWSER_INLINE void set_all(double s) { head.set_all(s), tail.set_all(s); }
  HAWSER_INLINE void scale(double s) { head.v *= s, tail.scale(s); }
  template <int From = 0>
  HAWSER_INLINE void subtract(const Column& c, double s) {
    if constexpr (From < lanes) head.v -= c.head.v * s;
    tail.template subtract<in_tail(From)>(c.tail, s);
  }
  HAWSER_INLINE void add(const Column& c) { head.v += c.head.v, tail.add(c.tail); }
  template <int From = 0>
  HAWSER_INLINE void add_squares(const Column& c) {
    if constexpr (From < lanes) head.add_squares(c.head);
    tail.template add_squares<in_tail(From)>(c.tail);
  }
  HAWSER_INLINE double dot(const Column& c) const { return Pack<lanes>{head.v * c.head.v}.sum() + tail.dot(c.tail); }
  HAWSER_INLINE double sum() const { return head.sum() + tail.sum(); }
  HAWSER_INLINE double at(int i) const { return i < lanes ? head.at(i) : tail.at(i - lanes); }
  HAWSER_INLINE void replace_from(int first, const Column& c) {
    if (first < lanes) head.replace_from(first, c.head);
    tail.replace_from(first - lanes, c.tail);
  }
};

template <>
struct Column<0> {
  template <int>
  HAWSER_INLINE void load(const double*) {}
  HAWSER_INLINE void load(const double*) {}
  template <int>
  HAWSER_INLINE void store(double*) const {}
  HAWSER_INLINE void gather(const double*) {}
  HAWSER_INLINE void set_all(double) {}
  HAWSER_INLINE void scale(double) {}
  template <int>
  HAWSER_INLINE void subtract(const Column&, double) {}
  HAWSER_INLINE void add(const Column&) {}
  template <int>
  HAWSER_INLINE void add_squares(const Column&) {}
  HAWSER_INLINE double dot(const Column&) const { return 0.0; }
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
