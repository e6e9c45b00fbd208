// hawser run: statics, then the run in time, recorded into a folder.
#pragma once

#include "solver/app/cli.hpp"

namespace hawser {

int command_run(const Request& request);

}  // namespace hawser
