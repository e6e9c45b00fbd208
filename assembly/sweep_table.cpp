#include "assembly/instruction_set.hpp"
#include "assembly/sweep.hpp"

namespace hawser {

const SweepTable& widest_sweep_table() {
#if defined(__x86_64__)
  switch (widest_instruction_set()) {
    case InstructionSet::avx512:
      return avx512::sweep_table;
    case InstructionSet::avx2:
      return avx2::sweep_table;
    case InstructionSet::base:
      break;
  }
#endif
  return base::sweep_table;
}

}  // namespace hawser
