// What the residual costs an element, and the residual with its tangent: every family, dry and in water, 10^2 to 10^5 elements
// (the beam in water: 10^6).
//
//   hawser_bench --benchmark_filter=assembly
//
// "dry" is axial (+ bending) + weight + inertia, "wet" adds drag and added mass: the difference is their price.
#include <string>

#include "bench/fixture.hpp"
#include "bench/flops.hpp"

namespace {

using namespace hawser;
using namespace hawser::bench;

void assembly(benchmark::State& state, ModelChoice family, bool wet, bool with_tangent) {
  const int elements = static_cast<int>(state.range(0));
  MovingLine line(family, elements, wet);
  for (auto _ : state) {
    if (with_tangent) {
      line.assemble();
    } else {
      line.assembler.residual(line.state, line.r);
    }
    benchmark::ClobberMemory();
  }
  state.counters["s_per_element"] = per_element(elements);
  state.counters["bytes_per_element"] = line.bytes(with_tangent) / elements;
  state.counters["flops_per_element"] = assembly_flops(family, wet, with_tangent);
}

const bool registered = [] {
  for (const bool with_tangent : {false, true})
    for (const ModelChoice family : families)
      for (const bool wet : {false, true}) {
        const std::string name = std::string("assembly/") + (with_tangent ? "tangent/" : "residual/") + word_of(family) + (wet ? "/wet" : "/dry");
        benchmark::RegisterBenchmark(name.c_str(), assembly, family, wet, with_tangent)
            ->RangeMultiplier(10)
            ->Range(100, family == ModelChoice::beam && wet ? 1000000 : 100000)
            ->Unit(benchmark::kMicrosecond);
      }
  return true;
}();

}  // namespace
