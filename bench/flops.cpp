#include "bench/flops.hpp"

#include <cmath>

#include "assembly/kernel.hpp"

namespace hawser::bench {

namespace {

/// A double that counts what is done to it.
struct Counted {
  static inline long operations = 0;
  double v = 0.0;

  Counted() = default;
  Counted(double value) : v(value) {}
  static Counted result(double value) {
    ++operations;
    return {value};
  }

  friend Counted operator+(const Counted& a, const Counted& b) { return result(a.v + b.v); }
  friend Counted operator-(const Counted& a, const Counted& b) { return result(a.v - b.v); }
  friend Counted operator*(const Counted& a, const Counted& b) { return result(a.v * b.v); }
  friend Counted operator/(const Counted& a, const Counted& b) { return result(a.v / b.v); }
  friend Counted operator-(const Counted& a) { return {-a.v}; }
  friend bool operator<(const Counted& a, const Counted& b) { return a.v < b.v; }
  friend bool operator>(const Counted& a, const Counted& b) { return a.v > b.v; }

  friend Counted select(bool condition, const Counted& yes, const Counted& no) { return condition ? yes : no; }
  friend Counted maximum(const Counted& a, const Counted& b) { return a.v > b.v ? a : b; }
  friend Counted minimum(const Counted& a, const Counted& b) { return a.v < b.v ? a : b; }
  friend Counted magnitude(const Counted& a) { return a.v < 0.0 ? -a : a; }
  friend Counted square_root(const Counted& a) { return result(std::sqrt(a.v)); }
};

/// The current of the fixture: two rows.
constexpr double z_rows[] = {-100.0, 0.0}, ux_rows[] = {0.16, 0.8}, uy_rows[] = {0.25, 0.0};

template <class Family, Want want>
double count() {
  using Shape = typename Family::Shape;
  ElementState<Counted> x;
  x.q = {{{0.0, 0.0, -50.0}}, {{1.0, 0.01, 0.0}}, {{5.0, 0.0, -50.0}}, {{1.0, 0.0, 0.01}}};
  x.v = x.a = {{{0.5, 0.1, 0.2}}, {{0.0, 0.1, 0.0}}, {{0.5, 0.1, 0.3}}, {{0.0, 0.1, 0.1}}};
  const Properties<Counted> e{5.0, 4.0e7, 1.0e3, 0.0, 2.5, 12.0, 24.6, 1.3, 1.29, 0.0, -1.0e300};
  const Weights w{1.0, 40.0, 1600.0, false};
  const CurrentTable current{2, z_rows, ux_rows, uy_rows};
  ElementResult<Shape, Counted> out;
  Counted::operations = 0;
  whole_element<Family, want>(x, e, w, current, out);
  const long whole = Counted::operations;
  constexpr int n = Shape::node_vectors, b = 3 * n;
  const int node_sums = b + (want == Want::tangent ? b * b : 0);
  if constexpr (n == 1) return static_cast<double>(whole + node_sums);
  V3<Counted> f;
  M3<Counted> J;
  Counted::operations = 0;
  Axial::evaluate<want>(x.q.s0, x.v.s0, e, w, f, J);
  return static_cast<double>(whole - Counted::operations + node_sums);
}

template <class Family>
double count(bool with_tangent) {
  return with_tangent ? count<Family, Want::tangent>() : count<Family, Want::force>();
}

}  // namespace

double assembly_flops(ModelChoice family, bool wet, bool with_tangent) {
  switch (family) {
    case ModelChoice::bar:
      return wet ? count<BarWet>(with_tangent) : count<BarDry>(with_tangent);
    case ModelChoice::cable:
      return wet ? count<CableWet>(with_tangent) : count<CableDry>(with_tangent);
    default:
      return wet ? count<BeamWet>(with_tangent) : count<BeamDry>(with_tangent);
  }
}

}  // namespace hawser::bench
