// hawser static --vary KEY=a:b:n: the equilibria of n values of one key, as CSV, as a JSON array, as a folder with a picture.
#pragma once

#include "solver/app/cli.hpp"

namespace hawser {

/// Every value is read and checked before the first is solved. Returns `failed_cases` where some values, `no_equilibrium` where
/// all of them have no equilibrium.
int command_static_vary(const Request& request);

}  // namespace hawser
