// Still packs of four: six rows leave half of a wider one idle. What helps is the doubled number of registers.
#include "solver/linear/chain_kernel.hpp"

#ifdef __x86_64__
// After every other header, so that nothing but the kernel is compiled for this instruction set.
#pragma GCC target("avx512f,avx512vl,avx512dq,fma")
#define HAWSER_WIDEST_PACK 4
#include "solver/linear/chain_kernel_body.hpp"

namespace hawser {

const ChainKernel avx512_chain_kernel{factorize, eliminate_runs, factorize_middle, forward, solve_middle, backward, "avx512"};

}  // namespace hawser
#endif
