// The public trial of statics: random scenes, each solved from nothing, every answer checked (README.md, "The trial of statics").
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "assembly/model.hpp"
#include "assembly/scene.hpp"
#include "assembly/state.hpp"
#include "solver/statics.hpp"

namespace hawser::bench {

/// What is known of the answer beside its equations.
enum class Known {
  nothing,
  catenary,    // one uniform line without EI in still water between held ends: the elastic catenary
  hanging,     // a free end in still water: straight down (or up), tension = what hangs below
  catenaries,  // uniform lines without EI in still water that meet at free points: each the elastic catenary between its ends
  equal_legs   // the same, equal and evenly around the axis z, on which the free point lies
};

struct Trial {
  Scene scene;
  std::string kind;
  Known known = Known::nothing;
  bool degenerate = false;  // its shape is not unique or its mesh cannot follow it: compare end forces and energy only
};

/// Scene `number` of a seed, always the same one: a line, or lines that meet at free points. The kinds go round with the number.
Trial draw_trial(std::uint64_t seed, std::uint64_t number);
Trial draw_network(std::uint64_t seed, std::uint64_t number);
inline constexpr int trial_kinds = 20, network_kinds = 14;

/// What is wrong with an answer; `loose`: with one that the solver says it took to 1e-6 only.
std::optional<std::string> complaint(const Trial& trial, const Model& model, const State& state, bool loose = false);

struct TrialOutcome {
  bool converged = false;
  bool loose = false;                // converged to 1e-6 of the largest reaction only, and the report says so
  std::optional<std::string> wrong;  // converged, but not an answer
  int factorizations = 0;
  double seconds = 0.0;  // processor time of solve_static
  StaticReport report;
};

/// Solves a scene from nothing and checks the answer.
TrialOutcome run_trial(const Trial& trial);

/// The least real part [N/m^2] of the spectrum of an equilibrium with all its loads, K x = kappa M x, M that of a unit mass per metre: stable where
/// it is positive. K and M are dense, by differences of the residual.
double least_decay(const Model& model, const State& state);

}  // namespace hawser::bench
