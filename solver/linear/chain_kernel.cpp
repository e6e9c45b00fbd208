#include <algorithm>
#include <array>

#include "assembly/instruction_set.hpp"

#ifdef __AVX2__
#define HAWSER_WIDEST_PACK 4
#else
#define HAWSER_WIDEST_PACK 2
#endif
#include "solver/linear/chain_kernel_body.hpp"

namespace hawser {

const ChainKernel baseline_chain_kernel{factorize, eliminate_runs, factorize_middle, forward, solve_middle, backward, "base"};

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
  return std::span(kernels).subspan(static_cast<std::size_t>(InstructionSet::avx512) - static_cast<std::size_t>(widest_instruction_set()));
#else
  static const std::array kernels = {&baseline_chain_kernel};
  return kernels;
#endif
}

}  // namespace hawser
