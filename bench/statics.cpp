// What an equilibrium costs with all that belongs to it: reading, meshing, statics, in this process; and by which route.
//
//   hawser_bench --benchmark_filter='static|method|equilibrium'
#include <string>

#include "bench/fixture.hpp"
#include "bench/scenes.hpp"
#include "solver/sundials/kinsol.hpp"

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

/// An equilibrium by Newton or by KINSOL: reading and meshing left out.
void by_method(benchmark::State& state, const Scene& scene, StaticStart start, bool kinsol) {
  const Model model = build_model(scene);
  const Assembler assembler(model);
  StaticOptions options;
  options.start = start;
  StaticReport report;
  for (auto _ : state) {
    State equilibrium = model.make_state();
    report = kinsol ? solve_static_kinsol(assembler, options, equilibrium) : solve_static(assembler, options, equilibrium);
    if (!report.converged) return state.SkipWithError("no equilibrium");
  }
  state.counters["factorizations"] = static_cast<double>(report.iterations);
}

void scene_by_method(benchmark::State& state, const char* scene, bool kinsol) {
  by_method(state, scene_of(scene, {}), StaticStart::catenary, kinsol);
}

void catenary_by_method(benchmark::State& state, StaticStart start, bool kinsol) {
  by_method(state, scene_of("catenary-5000", {elements_of("tether", state.range(0))}), start, kinsol);
  state.counters["s_per_element"] = per_element(static_cast<double>(state.range(0)));
}

void methods() {
  for (const bool kinsol : {false, true}) {
    const std::string method = kinsol ? "kinsol/" : "newton/";
    for (const char* scene : {"catenary-5000", "current-shear", "mooring-chain"})
      benchmark::RegisterBenchmark(("method/" + method + scene).c_str(), scene_by_method, scene, kinsol)->Unit(benchmark::kMillisecond);
    for (const StaticStart start : {StaticStart::catenary, StaticStart::straight})
      benchmark::RegisterBenchmark(("equilibrium/" + method + (start == StaticStart::catenary ? "catenary" : "straight")).c_str(), catenary_by_method,
                                   start, kinsol)
          ->RangeMultiplier(10)
          ->Range(100, 100000)
          ->Unit(benchmark::kMillisecond);
  }
}
const bool registered = (methods(), true);

}  // namespace
