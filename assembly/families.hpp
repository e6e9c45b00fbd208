// Families: the compile-time lists of shapes and terms (architecture rules 4 and 6).
//
// A shape writes the centreline of an element of length l in four modes (bar: the first two) about its middle, eta = xi - 1/2:
//   mean (r0 + r1)/2,   chord d = (r1 - r0)/l,   S e = (r0' + r1')/2 - d,   bow f = (r1' - r0')/2        (cubic Hermite)
//   r = R_0 y_0 + l (R_1 d + R_2 e + R_3 f),   r' = A_1 d + A_2 e + A_3 f,   l r'' = B_2 e + B_3 f
// The coefficients are pure numbers, each even or odd in eta: the pair of Gauss points +-g needs only the sum and the difference of what
// the terms answer there. Differences of coordinates are formed before anything large is multiplied, and translations never enter the
// strains.
// Quadrature: three Gauss points; the middle one is also the middle Lobatto point of the axial rule (weight 2/3; bar: 1).
#pragma once

#include <type_traits>

#include "assembly/terms/added_mass.hpp"
#include "assembly/terms/axial.hpp"
#include "assembly/terms/bending.hpp"
#include "assembly/terms/drag.hpp"
#include "assembly/terms/inertia_and_weight.hpp"

namespace hawser {

inline constexpr int gauss_points = 3;
inline constexpr double gauss_eta[3] = {-0.38729833462074169, 0.0, 0.38729833462074169};  // sqrt(0.15)
inline constexpr double gauss_weight[3] = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};

/// Four points on [0, 1], for what three do not meet: energies, contact.
inline constexpr double four_gauss_xi[4] = {0.069431844202973712, 0.33000947820757187, 0.66999052179242813, 0.93056815579702629};
inline constexpr double four_gauss_weight[4] = {0.17392742256872693, 0.32607257743127307, 0.32607257743127307, 0.17392742256872693};

enum class Channel { r, a, b };

/// Cubic Hermite: cable and beam.
struct HermiteShape {
  static constexpr int modes = 4;
  static constexpr int node_vectors = 2;              // r, r'
  static constexpr double middle_weight = 2.0 / 3.0;  // of the axial rule at eta = 0
  static constexpr double end_weight = 1.0 / 6.0;     // at each node
  // Mass of mode e: m l^3/210; three Gauss points give m l^3/300. All other products of the consistent mass are of degree five at most,
  // which they meet.
  static constexpr double missed_mass = 1.0 / 210.0 - 1.0 / 300.0;

  static constexpr bool even(int j) { return j == 0 || j == 3; }  // R_j; B_j has the same parity, A_j the other one
  static constexpr double coefficient(Channel channel, int j, double x) {
    switch (channel) {
      case Channel::r:
        return j == 0 ? 1.0 : j == 1 ? x : j == 2 ? x * (2 * x * x - 0.5) : x * x - 0.25;
      case Channel::a:
        return j == 0 ? 0.0 : j == 1 ? 1.0 : j == 2 ? 6 * x * x - 0.5 : 2 * x;
      default:
        return j == 2 ? 12 * x : j == 3 ? 2.0 : 0.0;
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
        return j == 0 ? 1.0 : x;
      case Channel::a:
        return j == 0 ? 0.0 : 1.0;
      default:
        return 0.0;
    }
  }
};

/// A family: a shape and the terms that act at its Gauss points; the axial one has points of its own.
template <class... Terms>
struct Elastic {};
template <class... Terms>
struct Loads {};

template <class ShapeOf, class ElasticTerms, class LoadTerms>
struct FamilyOf;

template <class ShapeOf, class... ElasticTerms, class... LoadTerms>
struct FamilyOf<ShapeOf, Elastic<ElasticTerms...>, Loads<LoadTerms...>> {
  using Shape = ShapeOf;
  static constexpr bool wet = (std::is_same_v<LoadTerms, Drag> || ...);
  static constexpr bool bends = sizeof...(ElasticTerms) > 0;

  template <Want want, class S>
  HAWSER_INLINE static void add_elastic(const Point<S>& p, const Properties<S>& e, const Weights& w, Response<S>& out) {
    (ElasticTerms::template add<want>(p, e, w, out), ...);
  }
  template <Want want, class S>
  HAWSER_INLINE static void add_loads(const Point<S>& p, const Properties<S>& e, const Weights& w, Transverse<S>& out) {
    (LoadTerms::template add<want>(p, e, w, out), ...);
  }
};

using Dry = Loads<InertiaAndWeight>;
using Wet = Loads<InertiaAndWeight, Drag, AddedMass>;
using BarDry = FamilyOf<StraightShape, Elastic<>, Dry>;
using BarWet = FamilyOf<StraightShape, Elastic<>, Wet>;
using CableDry = FamilyOf<HermiteShape, Elastic<>, Dry>;
using CableWet = FamilyOf<HermiteShape, Elastic<>, Wet>;
using BeamDry = FamilyOf<HermiteShape, Elastic<Bending>, Dry>;
using BeamWet = FamilyOf<HermiteShape, Elastic<Bending>, Wet>;

}  // namespace hawser
