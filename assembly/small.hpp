// V3<S>, M3<S>: vectors and matrices of three, for any scalar S (double, a SIMD pack, an automatic-differentiation number).
//
// Kept apart from Eigen on purpose: the kernels are compiled once per instruction set, and an inline function shared with
// other files could leak the wrong instructions into them (architecture rule 5). Everything here is forced inline.
#pragma once

#include <cmath>

#define HAWSER_INLINE __attribute__((always_inline)) inline

namespace hawser {

template <class S>
struct V3 {
  S x[3];
  HAWSER_INLINE S& operator[](int i) { return x[i]; }
  HAWSER_INLINE const S& operator[](int i) const { return x[i]; }
};

template <class S>
HAWSER_INLINE V3<S> operator+(const V3<S>& a, const V3<S>& b) {
  return {{a[0] + b[0], a[1] + b[1], a[2] + b[2]}};
}
template <class S>
HAWSER_INLINE V3<S> operator-(const V3<S>& a, const V3<S>& b) {
  return {{a[0] - b[0], a[1] - b[1], a[2] - b[2]}};
}
template <class S, class T>
HAWSER_INLINE V3<S> operator*(const T& f, const V3<S>& a) {
  return {{f * a[0], f * a[1], f * a[2]}};
}
template <class S>
HAWSER_INLINE S dot(const V3<S>& a, const V3<S>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Row i, column j at m[i + 3 j].
template <class S>
struct M3 {
  S m[9];
  HAWSER_INLINE S& operator()(int i, int j) { return m[i + 3 * j]; }
  HAWSER_INLINE const S& operator()(int i, int j) const { return m[i + 3 * j]; }
};

template <class S>
HAWSER_INLINE V3<S> zero_vector() {
  const S o(0.0);
  return {{o, o, o}};
}

/// Symmetric matrix of three: the upper triangle by columns.
template <class S>
struct Symmetric3 {
  S m[6];
};
/// Where component i + 3 j of the whole matrix is kept.
inline constexpr int symmetric_index[9] = {0, 1, 3, 1, 2, 4, 3, 4, 5};

// Written out, without loops: arrays that a loop touches stay in memory until the loop is unrolled, too late for registers.

/// m += a b^T.
template <class S>
HAWSER_INLINE void add_outer(M3<S>& m, const V3<S>& a, const V3<S>& b) {
  m.m[0] = m.m[0] + b[0] * a[0];
  m.m[1] = m.m[1] + b[0] * a[1];
  m.m[2] = m.m[2] + b[0] * a[2];
  m.m[3] = m.m[3] + b[1] * a[0];
  m.m[4] = m.m[4] + b[1] * a[1];
  m.m[5] = m.m[5] + b[1] * a[2];
  m.m[6] = m.m[6] + b[2] * a[0];
  m.m[7] = m.m[7] + b[2] * a[1];
  m.m[8] = m.m[8] + b[2] * a[2];
}
/// m += a b^T, which the caller knows to be symmetric alone or with the dyads added beside it.
template <class S>
HAWSER_INLINE void add_outer(Symmetric3<S>& m, const V3<S>& a, const V3<S>& b) {
  m.m[0] = m.m[0] + b[0] * a[0];
  m.m[1] = m.m[1] + b[1] * a[0];
  m.m[2] = m.m[2] + b[1] * a[1];
  m.m[3] = m.m[3] + b[2] * a[0];
  m.m[4] = m.m[4] + b[2] * a[1];
  m.m[5] = m.m[5] + b[2] * a[2];
}

/// f I.
template <class S>
HAWSER_INLINE M3<S> isotropic_matrix(const S& f) {
  const S o(0.0);
  return {{f, o, o, o, f, o, o, o, f}};
}
template <class S>
HAWSER_INLINE Symmetric3<S> isotropic_symmetric(const S& f) {
  const S o(0.0);
  return {{f, o, f, o, o, f}};
}

/// y += f x.
template <class S, class T>
HAWSER_INLINE void add_scaled(V3<S>& y, const T& f, const V3<S>& x) {
  y[0] = y[0] + f * x[0];
  y[1] = y[1] + f * x[1];
  y[2] = y[2] + f * x[2];
}

// Branches are selects, so that one formula serves doubles and packs (architecture rule 5).
HAWSER_INLINE double select(bool condition, double yes, double no) { return condition ? yes : no; }
HAWSER_INLINE double maximum(double a, double b) { return a > b ? a : b; }
HAWSER_INLINE double minimum(double a, double b) { return a < b ? a : b; }
HAWSER_INLINE double square_root(double a) { return __builtin_sqrt(a); }
HAWSER_INLINE double magnitude(double a) { return __builtin_fabs(a); }

/// 1/sqrt(a). Packs with a fast estimate of it bring their own.
template <class S>
HAWSER_INLINE S inverse_square_root(const S& a) {
  return S(1.0) / square_root(a);
}

}  // namespace hawser
