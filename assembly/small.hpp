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
HAWSER_INLINE M3<S> zero_matrix() {
  const S o(0.0);
  return {{o, o, o, o, o, o, o, o, o}};
}
template <class S>
HAWSER_INLINE V3<S> zero_vector() {
  const S o(0.0);
  return {{o, o, o}};
}

/// m += f a b^T.
template <class S>
HAWSER_INLINE void add_outer(M3<S>& m, const S& f, const V3<S>& a, const V3<S>& b) {
  for (int j = 0; j < 3; ++j) {
    const S fb = f * b[j];
    for (int i = 0; i < 3; ++i) m(i, j) = m(i, j) + fb * a[i];
  }
}

/// m += f I.
template <class S>
HAWSER_INLINE void add_identity(M3<S>& m, const S& f) {
  for (int i = 0; i < 3; ++i) m(i, i) = m(i, i) + f;
}

/// y += f x.
template <class S, class T>
HAWSER_INLINE void add_scaled(V3<S>& y, const T& f, const V3<S>& x) {
  for (int i = 0; i < 3; ++i) y[i] = y[i] + f * x[i];
}

// Branches are selects, so that one formula serves doubles and packs (architecture rule 5).
HAWSER_INLINE double select(bool condition, double yes, double no) { return condition ? yes : no; }
HAWSER_INLINE double maximum(double a, double b) { return a > b ? a : b; }
HAWSER_INLINE double minimum(double a, double b) { return a < b ? a : b; }
HAWSER_INLINE double square_root(double a) { return __builtin_sqrt(a); }
HAWSER_INLINE double magnitude(double a) { return __builtin_fabs(a); }

}  // namespace hawser
