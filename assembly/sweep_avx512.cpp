#include "assembly/sweep_impl.hpp"

namespace hawser::avx512 {

const SweepTable sweep_table = make_sweep_table<8>("avx512");

}  // namespace hawser::avx512
