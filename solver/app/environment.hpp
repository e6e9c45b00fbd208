// The environment that OpenMP and OpenBLAS read while they are loaded, before main.
#pragma once

namespace hawser {

/// Where it is not set, sets it and starts the program again; returns with it set, or where the system does not let a program start itself.
///   OMP_WAIT_POLICY=passive, GOMP_SPINCOUNT=20000: idle threads spin for about a third of a millisecond, then sleep. To spin for long costs
///   milliseconds each time the machine is shared; to sleep at once and be woken costs a tenth of one, three times an iteration.
///   OPENBLAS_NUM_THREADS=1: small blocks gain nothing from threads in BLAS.
void settle_environment(char** argv);

}  // namespace hawser
