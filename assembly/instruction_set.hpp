// The instruction sets that kernels are compiled for, and the one to run them in.
#pragma once

namespace hawser {

enum class InstructionSet { base, avx2, avx512 };  // narrowest first

/// The widest of this processor; HAWSER_SIMD=base|avx2 forces a narrower one.
InstructionSet widest_instruction_set();

}  // namespace hawser
