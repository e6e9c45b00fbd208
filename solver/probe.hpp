// Probing for further equilibria: the same scene from N perturbed starts, and the distinct states they lead to.
//
// The starts are, by turns, the known equilibrium mirrored at the chord of each line, the catenary, the straight line, the known equilibrium, and a
// shape with a loop, each with a disturbance
//
//   u(s) = A sum_{k=1}^{3} c_k sin(k pi s/L)      (a free end: sin((k - 1/2) pi s/L) from the held one),
//
// A = 1, 3, 10 or 30 % of the length L and c_k random vectors of mean size 1/k, in the vertical plane of the line in every other turn and in space in
// the rest. Points where lines meet move by A L c, mirrored ones also to the other side of the points that their lines lead to, and take their lines
// with them, linearly in s. The random numbers depend on the seed alone. Two states are the same where no node of one lies further than
// `same` times the longest line from where it lies in the other.
// A probe can show that there is another equilibrium; it cannot show that there is none.
#pragma once

#include <vector>

#include "solver/statics.hpp"

namespace hawser {

struct ProbeOptions {
  int starts = 10;
  unsigned seed = 1;
  double same = 1e-3;  // of the longest line
};

struct ProbedEquilibrium {
  State state;
  StaticReport report;
  double energy = 0.0;    // J
  double distance = 0.0;  // largest of a node from where it is in the first one, of the longest line
  int found = 0;          // starts that led here; the first one counts its own
};

struct ProbeReport {
  std::vector<ProbedEquilibrium> equilibria;  // distinct, the known one first, then in the order of their discovery
  int failed = 0;                             // starts that led to no stable equilibrium
  int factorizations = 0;
};

/// `known` and `report`: an equilibrium of the assembler's model and how it was found.
ProbeReport probe_equilibria(const Assembler& assembler, const StaticOptions& options, const State& known, const StaticReport& report,
                             const ProbeOptions& probe);

/// Strain energy, that of the normal force of the bed, and the potential of wet weights and forces at t = 0 [J]: what a stable state has least of
/// where there is no drag, no friction and no uneven bed (seabed_law.hpp). Friction and drag have no potential and no part in it.
double potential_energy(const Model& model, const State& state);

}  // namespace hawser
