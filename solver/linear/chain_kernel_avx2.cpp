// Packs of four.
#include "solver/linear/chain_kernel.hpp"

#ifdef __x86_64__
// After every other header, so that nothing but the kernel is compiled for this instruction set.
#pragma GCC target("avx2,fma")
#define HAWSER_WIDEST_PACK 4
#include "solver/linear/chain_kernel_body.hpp"

namespace hawser {

const ChainKernel avx2_chain_kernel{factorize, eliminate_runs, factorize_middle, forward, solve_middle, backward, "avx2"};

}  // namespace hawser
#endif
