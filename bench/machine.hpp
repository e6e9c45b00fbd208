// The instruction sets that this processor and HAWSER_SIMD admit (assembly/instruction_set.hpp).
#pragma once

#include <string_view>
#include <vector>

#include "assembly/instruction_set.hpp"

namespace hawser::bench {

/// Narrowest first: "base", "avx2", "avx512".
inline std::vector<std::string_view> instruction_sets() {
  constexpr std::string_view names[] = {"base", "avx2", "avx512"};
  return {names, names + static_cast<int>(widest_instruction_set()) + 1};
}

}  // namespace hawser::bench
