// seabed: contact of the lines with the seabed, element by element beside the SIMD sweep.
//
//   R_i -= int over the part in contact of  s_i f ds,    f = contact_force (seabed_law.hpp), s_i = shape functions
//
// The part in contact lies between the roots of the penetration g(xi) (and of g - delta where the law has a toe) and is cut at the lines of a
// grid, where the bed has a kink; each piece is integrated by four Gauss points, exact for k g s_i on a plane bed (degree 6). Every element uses
// this one rule: a rule of its own for elements that lie on the bed wholly would make the residual jump where an element begins to lift, and Newton
// could not end there.
// The derivative of the roots does not enter the tangent: f is continuous and zero where g is, so moving the end of the integral there
// changes nothing; and where g = delta the pieces on both sides change by opposite amounts. (Damping without a toe is the exception:
// it acts at once. Only its damping force at the root, c e.v, is then missing in the stiffness part.)
// Elements whose control points lie above the bed are passed over; a model without a seabed costs one test.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "assembly/added_blocks.hpp"
#include "assembly/element.hpp"
#include "assembly/model.hpp"

namespace hawser {

/// On elements without a joint; a joint's element takes its own (element.hpp).
void add_seabed(const Model& model, const State& state, std::span<double> r);
/// secant: the tangent of friction is positive (a floored tangent).
void add_seabed(const Model& model, const State& state, std::span<double> r, const TangentWeights& weights, bool secant, AddedBlocks blocks);

/// Contact of one element with these nodal vectors, added to f and, where it is given, to K; false: no contact.
bool add_contact(const Model& model, int line, int element, const ElementState<double>& x, const TangentWeights& weights, bool secant, Vector12& f,
                 Matrix12* K);

/// Force of the bed [N/m] at xi of an element.
Vec3 seabed_force(const Model& model, const State& state, int line, int element, double xi);

/// Energy of the normal force of the bed on an element [J]: the integral of U (seabed_law.hpp).
double seabed_energy(const Model& model, const State& state, int line, int element);

struct SeabedContact {
  std::vector<double> touchdown;                                  // m, arc lengths where the line meets or leaves the bed
  double length = 0.0;                                            // m, unstretched, in contact
  double largest_penetration = 0.0, largest_penetration_s = 0.0;  // m
  double force = 0.0;                                             // N, vertical, of the bed on the line and on bodies between its ends

  /// For a column of numbers: the first touchdown, not a number where there is none.
  double first_touchdown() const { return touchdown.empty() ? std::numeric_limits<double>::quiet_NaN() : touchdown.front(); }
};

SeabedContact observe_seabed(const Model& model, const State& state, int line);

}  // namespace hawser
