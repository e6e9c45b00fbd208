#include "solver/app/environment.hpp"

#include <unistd.h>

#include <cstdlib>

namespace hawser {

void settle_environment(char** argv) {
  constexpr const char* settings[][2] = {{"OMP_WAIT_POLICY", "passive"}, {"GOMP_SPINCOUNT", "20000"}, {"OPENBLAS_NUM_THREADS", "1"}};
  bool settled = true;
  for (const auto& [name, value] : settings) {
    if (std::getenv(name) != nullptr) continue;
    settled = false;
    setenv(name, value, 0);
  }
  if (!settled) execv("/proc/self/exe", argv);  // returns only where this is impossible
}

}  // namespace hawser
