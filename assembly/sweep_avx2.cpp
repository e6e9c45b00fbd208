#include "assembly/sweep_impl.hpp"

namespace hawser::avx2 {

const SweepTable sweep_table = make_sweep_table<4>("avx2");

}  // namespace hawser::avx2
