// What a Newton iteration of a time step costs an element: all linear solvers side by side, 10^2 to 10^5 elements (chain: 10^6).
//
//   hawser_bench --benchmark_filter=newton
//
// full:   residual, tangent, factors and increment: panel by panel in the chain solver, one after the other in the others
// kept:   the same in the chain solver, with factors left for later iterations
// apart:  the same one after the other in the chain solver, as the stages are measured
// reused: residual, reduce, solve, expand with the factors of an earlier iteration
// CHOLMOD factorizes the symmetric part (a modified Newton); forming it is counted.
#include <algorithm>
#include <string>

#include "bench/fixture.hpp"
#include "bench/solvers.hpp"

namespace {

using namespace hawser;
using namespace hawser::bench;

enum class Way { full, kept, apart, reused };

void iteration_apart(MovingLine& line, LinearSolver& solver) {
  line.assemble();
  line.assembler.reduce(line.tangent, line.r, line.rhs);
  if (!solver.takes_unsymmetric()) line.tangent.chain.symmetrize();
  benchmark::DoNotOptimize(solver.factorize(line.tangent.chain).smallest_pivot);
  solver.solve(line.rhs);
  line.assembler.expand(line.tangent, line.rhs, line.d);
}

void full_iteration(MovingLine& line, LinearSolver& solver) {
  if (!solver.takes_unsymmetric()) return iteration_apart(line, solver);
  TangentPanels panels = line.panels();
  benchmark::DoNotOptimize(solver.solve_once(panels, line.rhs).smallest_pivot);
  line.assembler.expand(line.tangent, line.rhs, line.d);
}

void full_iteration_with_kept_factors(MovingLine& line, LinearSolver& solver) {
  if (!solver.takes_unsymmetric()) return iteration_apart(line, solver);
  TangentPanels panels = line.panels();
  benchmark::DoNotOptimize(solver.factorize_and_solve(panels, line.rhs).smallest_pivot);
  line.assembler.expand(line.tangent, line.rhs, line.d);
}

void reused_iteration(MovingLine& line, LinearSolver& solver) {
  line.assembler.residual(line.state, line.r);
  line.assembler.reduce(line.tangent, line.r, line.rhs);
  solver.solve(line.rhs);
  line.assembler.expand(line.tangent, line.rhs, line.d);
}

void newton(benchmark::State& state, ModelChoice family, const NamedSolver& named, Way way) {
  const int elements = static_cast<int>(state.range(0));
  MovingLine line(family, elements);
  const auto solver = named.make();
  solver->analyze(line.tangent.chain);
  full_iteration_with_kept_factors(line, *solver);
  const auto iteration = way == Way::full    ? full_iteration
                         : way == Way::kept  ? full_iteration_with_kept_factors
                         : way == Way::apart ? iteration_apart
                                             : reused_iteration;
  for (auto _ : state) {
    iteration(line, *solver);
    benchmark::ClobberMemory();
  }
  line.assemble();  // panels leave no matrix
  if (!solver->takes_unsymmetric()) line.tangent.chain.symmetrize();
  std::vector<double> b(line.model.dofs);
  line.assembler.reduce(line.tangent, line.r, b);
  state.counters["s_per_element"] = per_element(elements);
  state.counters["bytes_per_element"] = (line.bytes(true) + static_cast<double>(solver->bytes())) / elements;
  state.counters["backward_error"] = backward_error(line.tangent.chain, line.rhs, b);
}

const bool registered = [] {
  for (const auto& [way, word] : {std::pair{Way::full, "full"}, {Way::kept, "kept"}, {Way::apart, "apart"}, {Way::reused, "reused"}})
    for (const NamedSolver& solver : compared_solvers())
      for (const ModelChoice family : families) {
        const bool chain = solver.name == "chain";
        if (!chain && (family != ModelChoice::beam || way == Way::apart || way == Way::kept)) continue;
        const std::string name = std::string("newton/") + word + "/" + solver.name + "/" + word_of(family);
        benchmark::RegisterBenchmark(name.c_str(), newton, family, solver, way)
            ->RangeMultiplier(10)
            ->Range(100, chain && family == ModelChoice::beam ? 1000000 : 100000)
            ->Unit(benchmark::kMicrosecond);
      }
  return true;
}();

}  // namespace
