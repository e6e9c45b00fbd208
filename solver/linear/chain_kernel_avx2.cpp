#include "solver/linear/chain_kernel.hpp"

#ifdef __x86_64__
// After every other header, so that only the kernel is compiled for this set. AVX-512 was measured to bring nothing more at six rows.
#pragma GCC target("avx2,fma")
#include "solver/linear/chain_kernel_body.hpp"

namespace hawser {

extern const ChainKernel avx2_chain_kernel;
const ChainKernel avx2_chain_kernel{factorize, solve};

}  // namespace hawser
#endif
