// What a time step costs an element: generalized-alpha on `umbilical-heave` at its own step, with 10^2 to 10^4 elements.
//
//   hawser_bench --benchmark_filter=time_step
//
// The run goes on from step to step, so the counter `iterations` is the mean number of Newton iterations of a step.
#include <string>

#include "bench/fixture.hpp"
#include "bench/scenes.hpp"
#include "solver/statics.hpp"
#include "solver/time/line_system.hpp"

namespace {

using namespace hawser;
using namespace hawser::bench;

Scene umbilical(ModelChoice family, int elements) {
  std::vector<std::string> overrides = {"lines.umbilical.sections.0.elements=" + std::to_string(elements),
                                        std::string("lines.umbilical.model=") + word_of(family)};
  if (family == ModelChoice::beam) overrides.push_back("line_types.U40.EI=1000.0");
  return scene_of("umbilical-heave", overrides);
}

void time_step(benchmark::State& state, ModelChoice family) {
  const int elements = static_cast<int>(state.range(0));
  const Scene scene = umbilical(family, elements);
  const Model model = build_model(scene);
  const Assembler assembler(model);
  State now = model.make_state();
  if (!solve_static(assembler, {}, now).converged) return state.SkipWithError("no equilibrium");
  const LineSystem system(assembler);
  const auto solver = make_linear_solver(LinearSolverKind::automatic);
  GeneralizedAlpha scheme(system, *solver, {});
  scheme.start(now);
  const double h = scene.dynamics->step;
  for (int i = 0; i < 50; ++i) scheme.step(now, now.t + h, h);  // past the jump of the acceleration at the start
  long iterations = 0;
  for (auto _ : state) {
    const StepReport report = scheme.step(now, now.t + h, h);
    if (report.status != StepStatus::ok) return state.SkipWithError("a step did not converge");
    iterations += report.iterations;
  }
  state.counters["s_per_element"] = per_element(elements);
  state.counters["iterations"] = benchmark::Counter(static_cast<double>(iterations), benchmark::Counter::kAvgIterations);
}

const bool registered = [] {
  for (const ModelChoice family : families) {
    const std::string name = std::string("time_step/") + word_of(family);
    benchmark::RegisterBenchmark(name.c_str(), time_step, family)->RangeMultiplier(10)->Range(100, 10000)->Unit(benchmark::kMicrosecond);
  }
  return true;
}();

}  // namespace
