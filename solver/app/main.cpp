// The program hawser: settings of the numerical libraries, then the command line.
#include <unistd.h>

#include <cstdlib>

#include "solver/app/cli.hpp"

namespace {

/// OpenMP and OpenBLAS read their environment while they are loaded, before main: where it is not set we set it and start again.
/// Threads that spin for long while idle cost milliseconds each time the machine is shared; to sleep at once and be woken costs a tenth of one,
/// three times an iteration: they spin for about that long. Small blocks gain nothing from threads in BLAS.
void settle_environment(char** argv) {
  if (std::getenv("OMP_WAIT_POLICY") != nullptr && std::getenv("GOMP_SPINCOUNT") != nullptr && std::getenv("OPENBLAS_NUM_THREADS") != nullptr) return;
  setenv("OMP_WAIT_POLICY", "passive", 0);
  setenv("GOMP_SPINCOUNT", "20000", 0);
  setenv("OPENBLAS_NUM_THREADS", "1", 0);
  execv("/proc/self/exe", argv);  // returns only where this is impossible: then we run as we are
}

}  // namespace

int main(int argc, char** argv) {
  settle_environment(argv);
  return hawser::run_program(argc, argv);
}
