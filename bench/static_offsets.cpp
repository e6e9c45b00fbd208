// What a map of end offsets costs: `mooring-chain` of 200 elements in a current, its fairlead moved over a disc, each equilibrium from nothing.
//
//   hawser_bench --benchmark_filter=offsets
//
// s_per_offset counts meshing, statics and the tensions at both ends; `failed` must be zero.
#include <cmath>
#include <numbers>

#include "bench/fixture.hpp"
#include "bench/scenes.hpp"

namespace {

using namespace hawser;
using namespace hawser::bench;

/// Places spread evenly over a disc: the golden angle from each to the next.
Vec3 offset(int k, int count, double radius) {
  const double angle = k * std::numbers::pi * (3.0 - std::sqrt(5.0)), distance = radius * std::sqrt((k + 0.5) / count);
  return {distance * std::cos(angle), distance * std::sin(angle), 0.0};
}

void offsets(benchmark::State& state) {
  constexpr int count = 200;
  const double radius = static_cast<double>(state.range(0));  // m
  Scene scene = scene_of("mooring-chain", {"lines.mooring.sections.0.elements=200"});
  scene.environment.current = {{0.0, 1.0, 0.5}, {-320.0, 0.2, 0.5}};
  const auto moved = std::find_if(scene.points.begin(), scene.points.end(), [](const PointSpec& p) { return p.name == "fairlead"; });
  const Vec3 middle = moved->position;
  long failed = 0, iterations = 0, solved = 0;
  for (auto _ : state) {
    for (int k = 0; k < count; ++k) {
      moved->position = middle + offset(k, count, radius);
      const StaticRun run = run_static(scene);
      failed += !run.report.converged;
      iterations += run.report.iterations;
      ++solved;
      benchmark::DoNotOptimize(observe_line(run.model, run.state, 0).tension_to);
    }
  }
  state.counters["s_per_offset"] = benchmark::Counter(count, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.counters["iterations"] = static_cast<double>(iterations) / static_cast<double>(solved);
  state.counters["failed"] = static_cast<double>(failed);
}

BENCHMARK(offsets)->Name("offsets/mooring-chain")->Arg(10)->Arg(30)->Unit(benchmark::kMillisecond);

}  // namespace
