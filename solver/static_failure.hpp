// Words for a static solve that cannot be done or was not: what happened, where, the likely cause, what to try.
#pragma once

#include <optional>

#include "solver/static_system.hpp"
#include "solver/statics.hpp"

namespace hawser {

/// A model that has no static equilibrium to look for: a line that nothing holds, a slack line without any load.
std::optional<Failure> refuse(const Model& model);

/// Why the last stage was not accepted.
Failure explain_failure(const Model& model, const State& state, const StaticSystem& system, const NewtonReport& newton, const StaticReport& report);

}  // namespace hawser
