// Pack<W>: W doubles in one SIMD register, lanes = consecutive elements. Compiler vector types; the square root alone needs
// an intrinsic on x86, elsewhere it is a loop.
//
// Each kernel file instantiates only the width of its own instruction set, so the same templates never meet under two
// sets of flags (architecture rule 5).
#pragma once

#if defined(__SSE2__)
#include <immintrin.h>
#endif

#include <utility>

#include "assembly/small.hpp"

namespace hawser {

template <int W>
struct VectorOf;
#define HAWSER_VECTOR(W)                                                                \
  template <>                                                                           \
  struct VectorOf<W> {                                                                  \
    typedef double Type __attribute__((vector_size(8 * W)));                            \
    typedef double InMemory __attribute__((vector_size(8 * W), aligned(8), may_alias)); \
    typedef long long MaskType __attribute__((vector_size(8 * W)));                     \
  };
HAWSER_VECTOR(2)
HAWSER_VECTOR(4)
HAWSER_VECTOR(8)
#undef HAWSER_VECTOR

template <int W>
struct Pack {
  using Vector = typename VectorOf<W>::Type;
  using InMemory = typename VectorOf<W>::InMemory;  // no alignment beyond that of a double
  using Mask = typename VectorOf<W>::MaskType;
  static constexpr int width = W;

  Vector v;

  Pack() = default;
  HAWSER_INLINE Pack(double s) : v(s - Vector{}) {}
  HAWSER_INLINE Pack(const Vector& x) : v(x) {}

  HAWSER_INLINE static Pack load(const double* p) { return Pack(Vector(*reinterpret_cast<const InMemory*>(p))); }
  HAWSER_INLINE void store(double* p) const { *reinterpret_cast<InMemory*>(p) = v; }

  friend HAWSER_INLINE Pack operator+(const Pack& a, const Pack& b) { return Pack(a.v + b.v); }
  friend HAWSER_INLINE Pack operator-(const Pack& a, const Pack& b) { return Pack(a.v - b.v); }
  friend HAWSER_INLINE Pack operator*(const Pack& a, const Pack& b) { return Pack(a.v * b.v); }
  friend HAWSER_INLINE Pack operator/(const Pack& a, const Pack& b) { return Pack(a.v / b.v); }
  friend HAWSER_INLINE Pack operator-(const Pack& a) { return Pack(-a.v); }
  friend HAWSER_INLINE Mask operator<(const Pack& a, const Pack& b) { return a.v < b.v; }
  friend HAWSER_INLINE Mask operator>(const Pack& a, const Pack& b) { return a.v > b.v; }

  friend HAWSER_INLINE Pack select(const Mask& m, const Pack& yes, const Pack& no) { return Pack(m ? yes.v : no.v); }
  friend HAWSER_INLINE Pack maximum(const Pack& a, const Pack& b) { return Pack(a.v > b.v ? a.v : b.v); }
  friend HAWSER_INLINE Pack minimum(const Pack& a, const Pack& b) { return Pack(a.v < b.v ? a.v : b.v); }
  friend HAWSER_INLINE Pack magnitude(const Pack& a) { return maximum(a, -a); }
  friend HAWSER_INLINE Pack inverse_square_root(const Pack& a) {
#if defined(__AVX512F__)
    // The estimate has 14 digits of 2; each of Newton's steps doubles them. A root and a division would block their unit five times as long.
    if constexpr (W == 8) {
      const Pack half = Pack(0.5) * a;
      Pack y(Vector(_mm512_maskz_rsqrt14_pd(0xff, a.v)));
      y = y + y * (Pack(0.5) - half * y * y);
      return y + y * (Pack(0.5) - half * y * y);
    }
#endif
    return Pack(1.0) / square_root(a);
  }
  friend HAWSER_INLINE Pack square_root(const Pack& a) {
#if defined(__AVX512F__)
    if constexpr (W == 8) return Pack(Vector(_mm512_maskz_sqrt_pd(0xff, a.v)));
#endif
#if defined(__AVX__)
    if constexpr (W == 4) return Pack(Vector(_mm256_sqrt_pd(a.v)));
#endif
#if defined(__SSE2__)
    if constexpr (W == 2) return Pack(Vector(_mm_sqrt_pd(a.v)));
#endif
    Pack r = a;
    for (int i = 0; i < W; ++i) r.v[i] = __builtin_sqrt(a.v[i]);
    return r;
  }
};

/// The lanes of `before`'s last and `now`'s first W - 1: what each lane's left neighbour holds.
template <int W, int... lane>
HAWSER_INLINE Pack<W> shifted(const Pack<W>& before, const Pack<W>& now, std::integer_sequence<int, lane...>) {
  return Pack<W>(__builtin_shufflevector(before.v, now.v, (W - 1 + lane)...));
}
template <int W>
HAWSER_INLINE Pack<W> shifted(const Pack<W>& before, const Pack<W>& now) {
  return shifted(before, now, std::make_integer_sequence<int, W>{});
}

/// One stage of the transpose: swaps the off-diagonal s x s blocks of rows i and i + s.
template <int s, int W, int... lane>
HAWSER_INLINE void swap_blocks(Pack<W>& a, Pack<W>& b, std::integer_sequence<int, lane...>) {
  const auto low = __builtin_shufflevector(a.v, b.v, ((lane & s) ? W + lane - s : lane)...);
  const auto high = __builtin_shufflevector(a.v, b.v, ((lane & s) ? W + lane : lane + s)...);
  a.v = low;
  b.v = high;
}

template <int W, int s = 1>
HAWSER_INLINE void transpose(Pack<W> (&rows)[W]) {
  if constexpr (s < W) {
#pragma GCC unroll 8
    for (int i = 0; i < W; ++i)
      if (!(i & s)) swap_blocks<s>(rows[i], rows[i + s], std::make_integer_sequence<int, W>{});
    transpose<W, 2 * s>(rows);
  }
}

/// Copies a square of numbers so that rows become columns; strides in doubles from row to row.
template <int size>
HAWSER_INLINE void copy_transposed(const double* from, long from_stride, double* to, long to_stride) {
  Pack<size> rows[size];
  for (int k = 0; k < size; ++k) rows[k] = Pack<size>::load(from + from_stride * k);
  transpose<size>(rows);
  for (int k = 0; k < size; ++k) rows[k].store(to + to_stride * k);
}

}  // namespace hawser
