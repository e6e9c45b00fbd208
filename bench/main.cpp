// Google Benchmark's main, in the environment that the program hawser gives itself.
#include <benchmark/benchmark.h>

#include "solver/app/environment.hpp"

int main(int argc, char** argv) {
  hawser::settle_environment(argv);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
