#include <algorithm>
#include <array>
#include <cstdlib>
#include <string_view>

#ifdef __AVX2__
#define HAWSER_WIDEST_PACK 4
#else
#define HAWSER_WIDEST_PACK 2
#endif
#include "solver/linear/chain_kernel_body.hpp"

namespace hawser {

const ChainKernel baseline_chain_kernel{factorize, factorize_middle, forward, solve_middle, backward, "base"};

void PivotWatch::add(const PivotWatch& other) {
  smallest = std::min(smallest, other.smallest);
  largest = std::max(largest, other.largest);
  growth_squared = std::max(growth_squared, other.growth_squared);
  not_finite += other.not_finite;
  negative += other.negative;
}

std::span<const ChainKernel* const> chain_kernels() {
#ifdef __x86_64__
  static const std::array kernels = {&avx512_chain_kernel, &avx2_chain_kernel, &baseline_chain_kernel};
  const char* forced = std::getenv("HAWSER_SIMD");
  const std::string_view widest = forced ? forced : "";
  const bool avx2 = widest != "base" && __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  const bool avx512 =
      avx2 && widest != "avx2" && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq");
  return std::span(kernels).subspan(avx512 ? 0 : avx2 ? 1 : 2);
#else
  static const std::array kernels = {&baseline_chain_kernel};
  return kernels;
#endif
}

}  // namespace hawser
