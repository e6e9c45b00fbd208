// Google Benchmark's main, in the environment that the program hawser gives itself (solver/app/main.cpp): idle threads of OpenMP soon
// sleep, OpenBLAS keeps to one. Both libraries read it while they are loaded, so it is set and the program started again.
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <cstdlib>

int main(int argc, char** argv) {
  if (std::getenv("OMP_WAIT_POLICY") == nullptr || std::getenv("GOMP_SPINCOUNT") == nullptr || std::getenv("OPENBLAS_NUM_THREADS") == nullptr) {
    setenv("OMP_WAIT_POLICY", "passive", 0);
    setenv("GOMP_SPINCOUNT", "20000", 0);
    setenv("OPENBLAS_NUM_THREADS", "1", 0);
    execv("/proc/self/exe", argv);  // returns only where this is impossible: then we run as we are
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
