#include "solver/time/system.hpp"

namespace hawser {

FactorReport System::linearize(const State& state, const TangentWeights& weights, const TangentFloor& floor, BorderedSolver& solver,
                               std::span<double> r, Tangent& t, std::span<double> x) const {
  tangent(state, weights, floor, r, t);
  reduce(t, r, x);
  const FactorReport report = solver.factorize(t);
  if (report.status == FactorStatus::ok) solver.solve(x);
  return report;
}

}  // namespace hawser
