// element: one whole element in double precision, with its joint resolved: for joints, observables and tests.
//
// Vectors of 12 in the order r0, r0', r1, r1' (3 each; a bar leaves the slopes zero). Where the slope jumps at the right end,
// r1' is the element's own end slope b: a free joint holds b itself, a scaled one b = mu r' with
//   b_dot = mu_dot r' + mu r'_dot,   b_ddot = mu_ddot r' + 2 mu_dot r'_dot + mu r'_ddot.
#pragma once

#include <array>

#include "assembly/model.hpp"
#include "assembly/observed.hpp"
#include "assembly/state.hpp"

namespace hawser {

using Vector12 = Eigen::Matrix<double, 12, 1>;
using Matrix12 = Eigen::Matrix<double, 12, 12>;

inline constexpr double no_floor = -1.0e300;  // least tension that never acts

struct Element {
  Vector12 f;
  Matrix12 K;
};

/// The arrays of the elements' properties in the order of Properties, without the least tension.
std::array<const std::vector<double>*, property_count - 1> property_arrays(const ElementArrays& e);

/// The joint at the right end of an element, or null.
const Joint* joint_of(const Model& model, int element);

/// Nodal vectors of an element (numbered through all lines) of a line.
ElementState<double> element_state(const Model& model, const State& state, int line, int element);

/// Force and tangent of the whole element, its spread loads at state.t included.
Element evaluate_element(const Model& model, const State& state, int line, int element, const TangentWeights& weights,
                         double least_tension = no_floor, bool gauss_newton = false);

/// The force alone (K is left empty).
Vector12 element_force(const Model& model, const State& state, int line, int element);

/// What the element shows at its ends, with its spread loads and contact.
Observed<double> observe_element(const Model& model, const State& state, int line, int element);

/// Nodal forces of an even load of unit total over [xi0, xi1] of an element of length l: integrals of the shape functions.
Eigen::Vector4d spread_factors(Family family, double l, double xi0, double xi1);

CurrentTable current_table(const Model& model);

}  // namespace hawser
