// Static equilibrium: R(q, v = tow velocity, a = 0, t = 0) = 0 (theory 7).
//
// Start (elastic catenary per span, marching from a free end, straight, or a given state) -> tension-floored Newton with
// all loads from the first iteration -> certificate: scaled residual, stability (negative pivots of the symmetric
// tangent), least tension. A compressed column is never accepted: with negative pivots the state is perturbed sideways
// and solved again; if it stays unstable the answer says so or the solve fails.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "assembly/assembler.hpp"
#include "assembly/model.hpp"
#include "assembly/state.hpp"
#include "solver/linear/linear_solver.hpp"

namespace hawser {

enum class StaticStart { catenary, straight, given };

struct StaticOptions {
  StaticStart start = StaticStart::catenary;
  LinearSolverKind linear_solver = LinearSolverKind::automatic;
  double tolerance = 0.0;      // relative residual (theory 6.1); 0: automatic
  int max_iterations = 12000;  // factorizations, over all stages
  int threads = 1;
  std::function<void(const std::string&)> log;  // one line per stage; may be empty
};

/// Where and why a solve failed, and what to try (exit code 3 or 4 prints it).
struct Failure {
  std::string what;                   // one sentence
  std::string line;                   // name of the line
  double s = 0.0;                     // m, arc length of the worst node
  std::string cause, remedy;          // likely cause; what to try
  std::string stage = {}, kept = {};  // statics: the stage that this is said of; what is left in the state
};

struct StaticReport {
  bool converged = false;
  int iterations = 0;                                                        // factorizations
  double residual = 0.0;                                                     // scaled, relative to the reference force (theory 6.1)
  double residual_force = 0.0, reference_force = 0.0, roundoff_floor = 0.0;  // N
  bool stable = false;
  int negative_pivots = 0;                   // of the elastic tangent (drag and applied moments left out); 0 where every point is in tension
  std::optional<double> slowest_decay = {};  // N/m^2, where negative_pivots > 0 and it is stable with all loads (stability.hpp)
  std::string linear_solver;
  bool modified_newton = false;     // the symmetric part was factorized
  std::vector<std::string> stages;  // what was tried, in order
  Failure failure;                  // where !converged
};

/// Fills `state` with the equilibrium; on failure with the best of what the stages left.
StaticReport solve_static(const Assembler& assembler, const StaticOptions& options, State& state);

/// The first guess that solve_static uses for a start (not `given`).
State static_start(const Model& model, StaticStart start);

/// The same, but lines with a shape table in the scene (LineSpec::start) start from it; solve them with StaticStart::given.
State static_start(const Model& model, StaticStart start, const Scene& scene);

/// Estimated relative error of each line's end tension: from the mesh and from what the residual [N] (StaticReport) leaves open.
///   d1 = |T(n) - T(n/2)|,  d2 = |T(n/2) - T(n/4)|,  c = d2/d1 between 2 and 2^p  (p = 4; bar: 2)
///   error = ( max( d1/(c - 1), d2/(2^p (2^p - 1)) ) + residual ) / T
/// c is the contraction seen: 2^p on a mesh fine enough, less where a touchdown or a sharp bend moves through coarse elements; 2 where
/// n/4 was not solved. It is an estimate, no bound: with a touchdown, errors up to five times as large were seen. NaN where n/2 was not solved or the
/// mesh cannot be halved.
std::vector<double> estimate_static_error(const Scene& scene, const StaticOptions& options, const Model& model, const State& state,
                                          double residual_force);

}  // namespace hawser
