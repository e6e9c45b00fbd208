// What an equilibrium costs with all that belongs to it: reading, meshing, statics, in this process; and by which route.
//
//   hawser_bench --benchmark_filter='static|method'
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

/// An equilibrium from its own start by Newton or by KINSOL: reading and meshing left out.
void by_method(benchmark::State& state, const char* scene_name, bool kinsol) {
  const Scene scene = scene_of(scene_name, {});
  const Model model = build_model(scene);
  const Assembler assembler(model);
  StaticReport report;
  for (auto _ : state) {
    State equilibrium = model.make_state();
    report = kinsol ? solve_static_kinsol(assembler, {}, equilibrium) : solve_static(assembler, {}, equilibrium);
    if (!report.converged) return state.SkipWithError("no equilibrium");
  }
  state.counters["factorizations"] = static_cast<double>(report.iterations);
}

void methods() {
  for (const char* scene : {"catenary-5000", "current-shear", "mooring-chain"})
    for (const bool kinsol : {false, true})
      benchmark::RegisterBenchmark((std::string("method/") + (kinsol ? "kinsol/" : "newton/") + scene).c_str(), by_method, scene, kinsol)
          ->Unit(benchmark::kMillisecond);
}
const bool registered = (methods(), true);

}  // namespace
