#include <cstdlib>
#include <string_view>

#include "assembly/sweep.hpp"

namespace hawser {

const SweepTable& widest_sweep_table() {
#if defined(__x86_64__)
  const char* forced = std::getenv("HAWSER_SIMD");
  const std::string_view limit = forced ? forced : "";
  const bool has_avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  const bool has_avx512 = has_avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
  if (has_avx512 && limit != "base" && limit != "avx2") return avx512::sweep_table;
  if (has_avx2 && limit != "base") return avx2::sweep_table;
#endif
  return base::sweep_table;
}

}  // namespace hawser
