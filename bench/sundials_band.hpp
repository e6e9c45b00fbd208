// SUNDIALS' own direct solver, SUNLinSol_Band, behind the contract of solver/linear/linear_solver.hpp: for comparison only.
#pragma once

#include <memory>

#include "solver/linear/linear_solver.hpp"

namespace hawser::bench {

/// LU of the band with row exchanges, in the order of the chain. One chain, of at least two nodes.
std::unique_ptr<LinearSolver> make_sundials_band_solver();

}  // namespace hawser::bench
