// The instruction set that the kernels run on, chosen as assembly/assembler.cpp chooses it.
#pragma once

#include <cstdlib>
#include <string_view>
#include <vector>

namespace hawser::bench {

/// Those of this processor that HAWSER_SIMD admits, narrowest first: "base", "avx2", "avx512".
inline std::vector<std::string_view> instruction_sets() {
  std::vector<std::string_view> sets = {"base"};
#if defined(__x86_64__)
  const char* forced = std::getenv("HAWSER_SIMD");
  const std::string_view limit = forced ? forced : "";
  if (limit == "base" || !__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) return sets;
  sets.push_back("avx2");
  if (limit == "avx2" || !__builtin_cpu_supports("avx512f") || !__builtin_cpu_supports("avx512dq") || !__builtin_cpu_supports("avx512vl"))
    return sets;
  sets.push_back("avx512");
#endif
  return sets;
}

}  // namespace hawser::bench
