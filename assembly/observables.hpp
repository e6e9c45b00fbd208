// Observables: what users ask of a (Model, State): tensions, end forces, moments, curvature, energies.
//
// Tension is the effective tension from equilibrium: the element's end force conjugate to r (internal + inertia -
// element loads) projected on the tangent, one value a side at a jump, at a support the magnitude of the reaction
// (data/README.md). The strain tension EA(|r'|-1) is second order only and is not reported.
#pragma once

#include <span>
#include <vector>

#include "assembly/model.hpp"
#include "assembly/state.hpp"

namespace hawser {

struct Station {
  double s = 0.0;                // m
  Vec3 position = Vec3::Zero();  // m
  Vec3 velocity = Vec3::Zero();  // m/s
  double tension = 0.0;          // N
  double curvature = 0.0;        // 1/m, material measure |r' x r''|/|r'|^2
};

struct LineResult {
  Vec3 force_from = Vec3::Zero(), force_to = Vec3::Zero();    // N, what the line exerts on its points
  double tension_from = 0.0, tension_to = 0.0;                // N, magnitudes of the above
  Vec3 moment_from = Vec3::Zero(), moment_to = Vec3::Zero();  // N m, on the points (clamped ends)
  std::vector<double> tension_left, tension_right;            // N per node: right end of the element before it, left end of the one after it
  std::vector<double> curvature;                              // 1/m per node, larger of the two sides
  double tension_max = 0.0, tension_min = 0.0;
  double curvature_max = 0.0, curvature_max_s = 0.0;
  double compressed_length = 0.0;                                   // m: elements whose strain tension is negative at some Lobatto point
  double least_strain_tension = 0.0, least_strain_tension_s = 0.0;  // N, m: EA(|r'|-1), for stability checks
};

LineResult observe_line(const Model& model, const State& state, int line);

/// Values at given unstretched arc lengths of a line (clamped to its ends).
std::vector<Station> observe_stations(const Model& model, const State& state, int line, std::span<const double> s);

/// Every node of a line.
std::vector<Station> observe_nodes(const Model& model, const State& state, int line);

struct PointResult {
  Vec3 position = Vec3::Zero();  // m
  Vec3 velocity = Vec3::Zero();  // m/s
  Vec3 force = Vec3::Zero();     // N, the sum of what the lines exert on it
  Vec3 bed = Vec3::Zero();       // N, of the seabed on the body of a free point
};

std::vector<PointResult> observe_points(const Model& model, const State& state);

struct Energies {
  double kinetic = 0.0, axial = 0.0, bending = 0.0, potential = 0.0;  // J; potential of the wet weight, zero at z = 0
  double bed = 0.0;                                                   // J; of the normal force; friction and damping have none
  Vec3 momentum = Vec3::Zero();                                       // kg m/s
  Vec3 angular_momentum = Vec3::Zero();                               // kg m2/s about the origin
  double total() const { return kinetic + axial + bending + potential + bed; }
};

Energies observe_energies(const Model& model, const State& state);

}  // namespace hawser
