// The numerical failures every backend reports in the same words.
#pragma once

#include <cstddef>
#include <optional>

#include "solver/linear/linear_solver.hpp"

namespace hawser {

/// The first unknown whose row or column holds NaN or infinity. One pass that stops at nothing when all is well.
std::optional<std::size_t> first_not_finite(const BlockTridiagonal& matrix);

FactorReport not_finite_report(std::size_t unknown);
FactorReport singular_report(std::size_t unknown);

/// Magnitudes outside [DBL_MIN, DBL_MAX]: a division by such a pivot is meaningless.
bool usable_pivot(double magnitude);

}  // namespace hawser
