#include "solver/linear/factor_reports.hpp"

#include <cfloat>
#include <cmath>

#include <fmt/format.h>

namespace hawser {

std::optional<std::size_t> first_not_finite(const BlockTridiagonal& matrix) {
  int bad = 0;
  for (const double v : matrix.values()) bad |= !(std::abs(v) <= DBL_MAX);
  if (!bad) return std::nullopt;
  for (const Chain& c : matrix.chains()) {
    const std::size_t node_values = std::size_t{3} * c.block * c.block;
    for (int i = 0; i < c.nodes; ++i) {
      const double* node = matrix.D(c, i);
      for (std::size_t k = 0; k < node_values; ++k)
        if (!(std::abs(node[k]) <= DBL_MAX)) return c.dof(i) + k % c.block;
    }
  }
  return std::nullopt;
}

FactorReport not_finite_report(std::size_t unknown) {
  FactorReport report;
  report.status = FactorStatus::singular;
  report.failed_unknown = unknown;
  report.message = fmt::format("the matrix holds NaN or infinity at or beside unknown {}", unknown);
  return report;
}

FactorReport singular_report(std::size_t unknown) {
  FactorReport report;
  report.status = FactorStatus::singular;
  report.failed_unknown = unknown;
  report.message = fmt::format("the matrix is singular: no usable pivot for unknown {}", unknown);
  return report;
}

bool usable_pivot(double magnitude) { return magnitude >= DBL_MIN && magnitude <= DBL_MAX; }

}  // namespace hawser
