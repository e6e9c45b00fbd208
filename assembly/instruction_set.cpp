#include "assembly/instruction_set.hpp"

#include <cstdlib>
#include <string_view>

namespace hawser {

InstructionSet widest_instruction_set() {
#if defined(__x86_64__)
  const char* forced = std::getenv("HAWSER_SIMD");
  const std::string_view limit = forced ? forced : "";
  if (limit == "base" || !__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) return InstructionSet::base;
  const bool wider = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
  return wider && limit != "avx2" ? InstructionSet::avx512 : InstructionSet::avx2;
#else
  return InstructionSet::base;
#endif
}

}  // namespace hawser
