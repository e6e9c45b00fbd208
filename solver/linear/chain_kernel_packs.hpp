// Packs of doubles and a column of a block in registers, for chain_kernel_body.hpp.
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

// A column of Rows entries: as many of the widest packs as fit, then narrower ones (6 = 4 + 2, 3 = 2 + 1). Seven rows are two packs of four, both of
// which hold row 3.
//
// Where a row `From` is given, packs that lie above it wholly take no part: they are zero once loaded, and neither read nor written.
template <int Rows>
struct Column {
  static constexpr int lanes = Rows >= widest_pack ? widest_pack : Rows >= 2 ? 2 : 1;
  static constexpr int below = Rows == 7 && lanes == 4 ? 3 : lanes;  // the first row of the tail
  static constexpr int in_tail(int row) { return row > below ? row - below : 0; }
  Pack<lanes> head;
  Column<Rows - below> tail;

  template <int From = 0>
  HAWSER_INLINE void load(const double* p) {
    if constexpr (From < lanes) head.load(p);
    if constexpr (From >= lanes) head.set_all(0.0);
    tail.template load<in_tail(From)>(p + below);
  }
  HAWSER_INLINE void load_parts(const double* p, const double* tail_at) { head.load(p), tail.load(tail_at); }
  template <int From = 0>
  HAWSER_INLINE void store(double* p) const {
    if constexpr (From < lanes) head.store(p);
    tail.template store<in_tail(From)>(p + below);
  }
  /// From scalars that may still be in registers: a load so soon after their stores would wait for the cache.
  HAWSER_INLINE void gather(const double* p) { head.gather(p), tail.gather(p + below); }
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
  HAWSER_INLINE void multiply(const Column& c) { head.v *= c.head.v, tail.multiply(c.tail); }
  /// Of rows from `From` on, each once.
  template <int From = 0>
  HAWSER_INLINE double sum() const {
    Pack<lanes> counted = head;
    if constexpr (From > 0) counted.set_all(0.0), counted.replace_from(From, head);
    return counted.sum() + tail.template sum<lanes - below>();
  }
  HAWSER_INLINE double dot(const Column& c) const {
    Column product = *this;
    product.multiply(c);
    return product.sum();
  }
  HAWSER_INLINE double at(int i) const { return i < lanes ? head.at(i) : tail.at(i - below); }
  HAWSER_INLINE void replace_from(int first, const Column& c) {
    if (first < lanes) head.replace_from(first, c.head);
    tail.replace_from(first - below, c.tail);
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
  HAWSER_INLINE void multiply(const Column&) {}
  template <int>
  HAWSER_INLINE double sum() const {
    return 0.0;
  }
  HAWSER_INLINE double at(int) const { return 0.0; }
  HAWSER_INLINE void replace_from(int, const Column&) {}
};

}  // namespace

}  // namespace hawser
