// What an equilibrium costs with all that belongs to it: reading, meshing, statics, in this process.
//
//   hawser_bench --benchmark_filter=static
#include <string>

#include "bench/fixture.hpp"
#include "bench/scenes.hpp"

namespace {

using namespace hawser;
using namespace hawser::bench;

std::string elements_of(const std::string& line, long elements) { return "lines." + line + ".sections.0.elements=" + std::to_string(elements); }

void catenary(benchmark::State& state) {
  long iterations = 0;
  for (auto _ : state) {
    const StaticRun run = run_static(scene_of("catenary-5000", {elements_of("tether", state.range(0))}));
    if (!run.report.converged) return state.SkipWithError("no equilibrium");
    iterations = run.report.iterations;
  }
  state.counters["s_per_element"] = per_element(static_cast<double>(state.range(0)));
  state.counters["iterations"] = static_cast<double>(iterations);
}

BENCHMARK(catenary)->Name("static/catenary-5000")->RangeMultiplier(10)->Range(100, 10000)->Unit(benchmark::kMillisecond);

}  // namespace
