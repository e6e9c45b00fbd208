// What threads gain: every stage of a Newton iteration of the beam in water on one and on two threads, wall time.
//
//   hawser_bench --benchmark_filter=threads            threads/STAGE/ELEMENTS/THREADS
//
// Each run is first held against one thread, bit by bit: residual, blocks and increment. A difference is an error.
#include <cstring>
#include <string>

#include "bench/fixture.hpp"

namespace {

using namespace hawser;
using namespace hawser::bench;

enum class Stage { residual, tangent, factorize, solve, newton };

struct Iteration {
  MovingLine line;
  std::unique_ptr<LinearSolver> solver;

  Iteration(int elements, int threads)
      : line(ModelChoice::beam, elements, true, threads), solver(make_linear_solver(LinearSolverKind::chain, threads)) {
    solver->analyze(line.tangent.chain);
    line.assemble();
    solver->factorize(line.tangent.chain);
    full();
  }

  void full() {
    TangentPanels panels = line.panels();
    solver->solve_once(panels, line.rhs);
    line.assembler.expand(line.tangent, line.rhs, line.d);
  }

  void run(Stage stage) {
    switch (stage) {
      case Stage::residual:
        return line.assembler.residual(line.state, line.r);
      case Stage::tangent:
        return line.assemble();
      case Stage::factorize:
        solver->factorize(line.tangent.chain);
        return;
      case Stage::solve:
        line.assembler.reduce(line.tangent, line.r, line.rhs);
        return solver->solve(line.rhs);
      case Stage::newton:
        return full();
    }
  }
};

bool same_bits(std::span<const double> a, std::span<const double> b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size_bytes()) == 0;
}

bool same_bits(const Iteration& a, const Iteration& b) {
  return same_bits(a.line.r, b.line.r) && same_bits(a.line.tangent.chain.values(), b.line.tangent.chain.values()) && same_bits(a.line.d, b.line.d);
}

void threads(benchmark::State& state, Stage stage) {
  const int elements = static_cast<int>(state.range(0)), count = static_cast<int>(state.range(1));
  Iteration iteration(elements, count);
  if (!same_bits(iteration, Iteration(elements, 1))) return state.SkipWithError("the result depends on the number of threads");
  for (auto _ : state) {
    iteration.run(stage);
    benchmark::ClobberMemory();
  }
  state.counters["s_per_element"] = per_element(elements);
}

const bool registered = [] {
  constexpr std::pair<Stage, const char*> stages[] = {{Stage::residual, "residual"},
                                                      {Stage::tangent, "tangent"},
                                                      {Stage::factorize, "factorize"},
                                                      {Stage::solve, "solve"},
                                                      {Stage::newton, "newton"}};
  for (const auto& [stage, word] : stages)
    benchmark::RegisterBenchmark((std::string("threads/") + word).c_str(), threads, stage)
        ->ArgsProduct({{1000, 10000, 100000}, {1, 2}})
        ->UseRealTime()
        ->Unit(benchmark::kMicrosecond);
  return true;
}();

}  // namespace
