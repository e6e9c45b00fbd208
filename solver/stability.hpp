// The softest direction of an equilibrium: the mode of least stiffness of the elastic tangent K (drag and applied moments left out,
// friction frozen: static_system.hpp).
//
//   K phi = lambda M phi,      lambda [N/m^2]: restoring force per metre of line and metre of displacement,
//
// M: the length of line that a node carries, for r', times the square of the shorter element at it; for inner unknowns of jumps 0 (where one gives
// way by itself it counts as a direction, but has no mode). lambda < 0: the state is unstable along phi; |lambda| <= neutral: it is neutral, nothing
// holds it along phi. By Sylvester's law K - sigma M has as many negative pivots as there are lambda below sigma: bisection in sigma brackets the
// least one (one pass of the chain each), and inverse iteration from below it, where K - sigma M is positive definite, gives the mode.
#pragma once

#include <optional>
#include <vector>

#include "assembly/model.hpp"
#include "assembly/state.hpp"

namespace hawser {

struct StabilityMode {
  double stiffness = 0.0;          // N/m^2, lambda
  int negative_pivots = 0;         // directions with lambda < 0, neutral ones left out
  std::vector<double> shape;       // Model::unknowns entries; the largest displacement is 1 m
  int line = 0;                    // where that is
  double s = 0.0;                  // m
  Vec3 direction = Vec3::UnitX();  // of it; the first component above half of the largest is positive
};

/// With all loads, drag and friction too, K has no symmetry, and a state is stable where what is left of a displacement dies away in a medium that
/// resists motion, M x' = -K x: where every eigenvalue of K x = kappa M x has a positive real part; M is here that of a unit mass per metre, as in
/// creep.hpp. The least real part [N/m^2] among the eigenvalues next to 0 and next to -|softest| (the stiffness of the softest mode, what drag and
/// friction have to make up for), from Krylov spaces of (K - sigma M)^-1 M; nothing where K is singular or no eigenvalue is accurate.
/// Inner unknowns of joints follow at once, without a mass of their own. Costs up to 300 solutions for each sigma.
std::optional<double> slowest_decay(const Model& model, const State& state, double softest);

/// Water moves past lines or bodies that drag: the loads have no potential, and the elastic tangent does not see every fold.
bool flows(const Model& model);

/// Neither flow nor friction, and a bed that is level where there is one.
bool has_potential(const Model& model);

/// Below it [N/m^2] a mode is neutral: 1e-6 reference_force/L^2 with the longest line L. `reference_force` [N]: of the statics (solver/norms.hpp).
double neutral_stiffness(const Model& model, double reference_force);

/// What rounding leaves [N/m^2] of the stiffest stretching: 1e-14 EA/l^2.
double rounding_stiffness(const Model& model);

/// The mode of least stiffness where the state is unstable or neutral along it; nothing where it is stable.
std::optional<StabilityMode> softest_mode(const Model& model, const State& state, double reference_force);

/// slowest_decay where that is more than neutral_stiffness or more than rounding_stiffness (the largest force of a network is no measure of a slack
/// line in it): the equilibrium is stable with all loads.
std::optional<double> decay_with_all_loads(const Model& model, const State& state, double reference_force);

/// How many modes are softer than this stiffness [N/m^2].
int modes_below(const Model& model, const State& state, double stiffness);

}  // namespace hawser
