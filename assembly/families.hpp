// Families: the compile-time lists of shapes and terms (architecture rules 4 and 6).
//
// A shape writes the centreline of an element in its symmetric and antisymmetric modes about the middle, eta = xi - 1/2:
//   y = (r0 + r1, r1 - r0)                          bar
//   y = (r0 + r1, r1 - r0, r0' + r1', r1' - r0')    cable, beam (cubic Hermite)
//   r = sum_j R_j(eta) y_j,   a = r' = sum_j A_j y_j,   b = r'' = sum_j B_j y_j
// Each R_j is even or odd in eta, so the pair of Gauss points +-g needs only the sum and the difference of what the terms
// answer there. r1 - r0 is formed before anything large is multiplied, and translations never enter the strains.
// Quadrature: three Gauss points; the middle one is also the middle Lobatto point of the axial rule (weight 2/3; bar: 1).
#pragma once

#include "assembly/terms/added_mass.hpp"
#include "assembly/terms/axial.hpp"
#include "assembly/terms/bending.hpp"
#include "assembly/terms/drag.hpp"

namespace hawser {

inline constexpr int gauss_points = 3;
inline constexpr double gauss_eta = 0.38729833462074169;  // sqrt(0.15)
inline constexpr double gauss_outer_weight = 5.0 / 18.0, gauss_middle_weight = 8.0 / 18.0;
inline constexpr double gauss_xi[3] = {0.5 - gauss_eta, 0.5, 0.5 + gauss_eta};
inline constexpr double gauss_weight[3] = {gauss_outer_weight, gauss_middle_weight, gauss_outer_weight};

enum class Channel { r, a, b };

/// Cubic Hermite: cable and beam. Factors of l: R_j l for the slopes' modes, A_j/l and B_j/l^2 for r1 - r0, B_j/l for the slopes'.
struct HermiteShape {
  static constexpr int modes = 4;
  static constexpr int node_vectors = 2;              // r, r'
  static constexpr double middle_weight = 2.0 / 3.0;  // of the axial rule at eta = 0
  static constexpr double end_weight = 1.0 / 6.0;     // at each node

  static constexpr bool even(int j) { return j == 0 || j == 3; }  // R_j; B_j has the same parity, A_j the other one
  static constexpr double coefficient(Channel channel, int j, double x) {
    switch (channel) {
      case Channel::r:
        return j == 0 ? 0.5 : j == 1 ? x * (1.5 - 2 * x * x) : j == 2 ? x * (x * x - 0.25) : 0.5 * x * x - 0.125;
      case Channel::a:
        return j == 0 ? 0.0 : j == 1 ? 1.5 - 6 * x * x : j == 2 ? 3 * x * x - 0.25 : x;
      default:
        return j == 0 ? 0.0 : j == 1 ? -12 * x : j == 2 ? 6 * x : 1.0;
    }
  }
};

/// Straight: bar.
struct StraightShape {
  static constexpr int modes = 2;
  static constexpr int node_vectors = 1;  // r
  static constexpr double middle_weight = 1.0;
  static constexpr double end_weight = 0.0;

  static constexpr bool even(int j) { return j == 0; }
  static constexpr double coefficient(Channel channel, int j, double x) {
    switch (channel) {
      case Channel::r:
        return j == 0 ? 0.5 : x;
      case Channel::a:
        return j == 0 ? 0.0 : 1.0;
      default:
        return 0.0;
    }
  }
};

/// Power of l that belongs to a coefficient of mode j.
constexpr int length_power(Channel channel, int j) {
  const int slope = j >= 2 ? 1 : 0;
  return channel == Channel::r ? slope : channel == Channel::a ? slope - 1 : slope - 2;
}

template <class Shape>
constexpr bool is_even(Channel channel, int j) {
  return Shape::even(j) != (channel == Channel::a);
}

/// A family: a shape and the terms that act at its Gauss points beside the axial one. Inertia and weight are closed forms.
template <class ShapeOf, class... Terms>
struct FamilyOf {
  using Shape = ShapeOf;
  static constexpr bool wet = sizeof...(Terms) > 0 && (std::is_same_v<Terms, Drag> || ...);
  static constexpr bool bends = (std::is_same_v<Terms, Bending> || ...);

  template <Want want, class S>
  HAWSER_INLINE static void add_terms(const Point<S>& p, const Properties<S>& e, const Weights& w, Response<S>& out) {
    (Terms::template add<want>(p, e, w, out), ...);
  }
};

using BarDry = FamilyOf<StraightShape>;
using BarWet = FamilyOf<StraightShape, Drag, AddedMass>;
using CableDry = FamilyOf<HermiteShape>;
using CableWet = FamilyOf<HermiteShape, Drag, AddedMass>;
using BeamDry = FamilyOf<HermiteShape, Bending>;
using BeamWet = FamilyOf<HermiteShape, Bending, Drag, AddedMass>;

}  // namespace hawser
