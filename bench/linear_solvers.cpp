// What a factorization and a solution cost an element, for every backend and SUNDIALS' own solver, 10^2 to 10^5 beam elements
// (chain: 10^6).
//
//   hawser_bench --benchmark_filter=linear
//
// The matrix is the assembled tangent of a time step (fixture.hpp): a beam with drag, added mass and inertia, unsymmetric
// because of the drag. CHOLMOD takes its symmetric part. A backend's copy of the blocks into its own form is counted.
// Counters beside every time: s_per_element, bytes_per_element of the factors, and backward_error; chain: operations and
// bytes that must move (flops.hpp) for the roofline.
#include <algorithm>
#include <array>
#include <string>

#include "bench/fixture.hpp"
#include "bench/flops.hpp"
#include "bench/solvers.hpp"

namespace {

using namespace hawser;
using namespace hawser::bench;

enum class Task { factorize, solve, both };

void linear(benchmark::State& state, const NamedSolver& named, Task task) {
  const int elements = static_cast<int>(state.range(0));
  MovingLine line(ModelChoice::beam, elements);
  line.assemble();
  line.assembler.reduce(line.tangent, line.r, line.rhs);
  const auto solver = named.make();
  BlockTridiagonal& matrix = line.tangent.chain;
  if (!solver->takes_unsymmetric()) matrix.symmetrize();
  std::vector<double> x(line.rhs.begin(), line.rhs.end());
  solver->analyze(matrix);
  const FactorReport report = solver->factorize(matrix);
  if (report.status != FactorStatus::ok) return state.SkipWithError(report.message.c_str());
  for (auto _ : state) {
    if (task != Task::solve) benchmark::DoNotOptimize(solver->factorize(matrix).smallest_pivot);
    if (task == Task::factorize) continue;
    std::copy(line.rhs.begin(), line.rhs.end(), x.begin());
    solver->solve(x);
    benchmark::ClobberMemory();
  }
  x.assign(line.rhs.begin(), line.rhs.end());
  solver->solve(x);
  state.counters["s_per_element"] = per_element(elements);
  state.counters["bytes_per_element"] = static_cast<double>(solver->bytes()) / elements;
  if (named.name == "chain" && task != Task::both) {
    const double b = matrix.chains().front().block, factors = static_cast<double>(solver->bytes()), vectors = 8.0 * b * elements;
    const double moved = task == Task::factorize ? 8.0 * static_cast<double>(matrix.values().size()) + factors : factors + 4.0 * vectors;
    state.counters["flops_per_element"] = task == Task::factorize ? factorize_flops(b) : solve_flops(b);
    state.counters["moved_per_element"] = moved / elements;
  }
  state.counters["backward_error"] = backward_error(matrix, x, line.rhs);
  state.counters["fell_back"] = report.fell_back;
}

const bool registered = [] {
  constexpr std::array<std::pair<Task, const char*>, 3> tasks = {{{Task::factorize, "factorize"}, {Task::solve, "solve"}, {Task::both, "both"}}};
  for (const auto& [task, word] : tasks)
    for (const NamedSolver& solver : compared_solvers()) {
      const std::string name = std::string("linear/") + word + "/" + solver.name;
      benchmark::RegisterBenchmark(name.c_str(), linear, solver, task)
          ->RangeMultiplier(10)
          ->Range(100, solver.name == "chain" ? 1000000 : 100000)
          ->Unit(benchmark::kMicrosecond);
    }
  return true;
}();

}  // namespace
