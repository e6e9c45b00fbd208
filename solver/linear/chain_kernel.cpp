#include "solver/linear/chain_kernel_body.hpp"

namespace hawser {

#ifdef __x86_64__
extern const ChainKernel avx2_chain_kernel;
#endif

namespace {

constexpr ChainKernel baseline_kernel{factorize, solve};

}  // namespace

const ChainKernel& chain_kernel() {
#ifdef __x86_64__
  static const bool wide = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  if (wide) return avx2_chain_kernel;
#endif
  return baseline_kernel;
}

}  // namespace hawser
