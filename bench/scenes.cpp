// What whole scenes cost: reading, meshing, statics, dynamics and histories, without files and pictures.
//
//   hawser_bench --benchmark_filter=scene
//
// s_per_element is per element (static), or per element and time step (run); iterations are Newton iterations.
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

void umbilical(benchmark::State& state) {
  SimulateCounters counters;
  for (auto _ : state) {
    const DynamicRun run = run_dynamic(scene_of("umbilical-heave", {elements_of("umbilical", state.range(0))}));
    if (!run.finished) return state.SkipWithError("the run stopped");
    counters = run.counters;
  }
  state.counters["s_per_element"] = per_element(static_cast<double>(state.range(0) * counters.steps));
  state.counters["iterations"] = static_cast<double>(counters.newton_iterations);
  state.counters["steps"] = static_cast<double>(counters.steps);
}

BENCHMARK(catenary)->Name("scene/static/catenary-5000")->RangeMultiplier(10)->Range(100, 10000)->Unit(benchmark::kMillisecond);
BENCHMARK(umbilical)->Name("scene/run/umbilical-heave")->Arg(200)->Arg(1000)->Unit(benchmark::kMillisecond);

}  // namespace
