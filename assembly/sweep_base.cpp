#include "assembly/sweep_impl.hpp"

namespace hawser::base {

const SweepTable sweep_table = make_sweep_table<2>("base");

}  // namespace hawser::base
