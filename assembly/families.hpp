// Families: the compile-time lists of shapes and terms (architecture rules 4 and 6).
//
// A shape writes the centreline of an element in the vectors y = (r0, d) or (r0, d, r0', r1') with d = (r1 - r0)/l, so that
// r1 - r0 is formed before anything large is multiplied, and translations never enter the strains:
//   r(xi) = r0 + l sum_j rho_j y_j,   a = r' = sum_j A_j y_j,   l b = l r'' = sum_j B_j y_j,      j >= 1
// Quadrature: three Gauss points; the middle one is also the middle Lobatto point of the axial rule (weight 2/3; bar: 1).
#pragma once

#include "assembly/terms/added_mass.hpp"
#include "assembly/terms/axial.hpp"
#include "assembly/terms/bending.hpp"
#include "assembly/terms/drag.hpp"

namespace hawser {

inline constexpr int gauss_points = 3;
inline constexpr double gauss_xi[gauss_points] = {0.11270166537925831, 0.5, 0.88729833462074169};
inline constexpr double gauss_weight[gauss_points] = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};

/// Cubic Hermite, y = (r0, d, r0', r1'): cable and beam.
struct HermiteShape {
  static constexpr int vectors = 4;        // of y
  static constexpr int node_vectors = 2;   // r, r'
  static constexpr double middle_weight = 2.0 / 3.0;  // of the axial rule at xi = 1/2
  static constexpr double end_weight = 1.0 / 6.0;     // at each node

  static constexpr double rho(int j, double x) { return j == 1 ? x * x * (3 - 2 * x) : j == 2 ? x * (1 - x) * (1 - x) : j == 3 ? x * x * (x - 1) : 0; }
  static constexpr double A(int j, double x) { return j == 1 ? 6 * x * (1 - x) : j == 2 ? (1 - x) * (1 - 3 * x) : j == 3 ? x * (3 * x - 2) : 0; }
  static constexpr double B(int j, double x) { return j == 1 ? 6 - 12 * x : j == 2 ? 6 * x - 4 : j == 3 ? 6 * x - 2 : 0; }
};

/// Straight, y = (r0, d): bar.
struct StraightShape {
  static constexpr int vectors = 2;
  static constexpr int node_vectors = 1;  // r
  static constexpr double middle_weight = 1.0;
  static constexpr double end_weight = 0.0;

  static constexpr double rho(int j, double x) { return j == 1 ? x : 0; }
  static constexpr double A(int j, double) { return j == 1 ? 1 : 0; }
  static constexpr double B(int, double) { return 0; }
};

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
