// What keeps a static solve from being done or a state from being accepted, in words: what happened, where, the likely cause, what to try.
#pragma once

#include <optional>
#include <string>

#include "solver/static_perturbation.hpp"
#include "solver/static_system.hpp"
#include "solver/statics.hpp"

namespace hawser {

/// A model that has no static equilibrium to look for: a line that nothing holds, a slack line without any load.
std::optional<Failure> refuse(const Model& model);

/// Name of the free point at which lines meet whose position is at this unknown; empty where there is none.
std::string meeting_point(const Model& model, std::size_t unknown);

/// Writes into the report whether a state that satisfies the equations is stable: without a knot, and without compression that could buckle a line
/// or without a negative pivot of the elastic tangent. Returns the knot.
std::optional<Knot> certify(const Model& model, const State& state, StaticReport& report);

/// A state that satisfies the equations but is knotted.
Failure knotted(const Model& model, const Knot& knot);

/// Why the last stage was not accepted.
Failure explain_failure(const Model& model, const State& state, const StaticSystem& system, const NewtonReport& newton, const StaticReport& report);

}  // namespace hawser
