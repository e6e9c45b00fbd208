// Dual<N>: forward automatic differentiation with N directions, the oracle for every hand-written derivative.
//
// The kernels are templates on the scalar: the formula differentiated here is the formula that runs.
#pragma once

#include <array>
#include <cmath>

namespace hawser::test {

template <int N>
struct Dual {
  double v = 0.0;
  std::array<double, N> d{};

  Dual() = default;
  Dual(double value) : v(value) {}
  static Dual variable(double value, int direction) {
    Dual x(value);
    x.d[direction] = 1.0;
    return x;
  }

  friend Dual chain(double value, const Dual& a, double da, const Dual& b, double db) {
    Dual r(value);
    for (int i = 0; i < N; ++i) r.d[i] = da * a.d[i] + db * b.d[i];
    return r;
  }
  friend Dual operator+(const Dual& a, const Dual& b) { return chain(a.v + b.v, a, 1.0, b, 1.0); }
  friend Dual operator-(const Dual& a, const Dual& b) { return chain(a.v - b.v, a, 1.0, b, -1.0); }
  friend Dual operator*(const Dual& a, const Dual& b) { return chain(a.v * b.v, a, b.v, b, a.v); }
  friend Dual operator/(const Dual& a, const Dual& b) { return chain(a.v / b.v, a, 1.0 / b.v, b, -a.v / (b.v * b.v)); }
  friend Dual operator-(const Dual& a) { return chain(-a.v, a, -1.0, a, 0.0); }
  friend bool operator<(const Dual& a, const Dual& b) { return a.v < b.v; }
  friend bool operator>(const Dual& a, const Dual& b) { return a.v > b.v; }

  friend Dual select(bool condition, const Dual& yes, const Dual& no) { return condition ? yes : no; }
  friend Dual maximum(const Dual& a, const Dual& b) { return a.v > b.v ? a : b; }
  friend Dual minimum(const Dual& a, const Dual& b) { return a.v < b.v ? a : b; }
  friend Dual magnitude(const Dual& a) { return a.v < 0.0 ? -a : a; }
  friend Dual square_root(const Dual& a) {
    const double root = std::sqrt(a.v);
    return chain(root, a, 0.5 / root, a, 0.0);
  }
};

}  // namespace hawser::test
