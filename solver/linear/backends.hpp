// What linear_solver.cpp needs to know of the backends: how to make one.
#pragma once

#include <memory>

#include "solver/linear/linear_solver.hpp"

namespace hawser {

std::unique_ptr<LinearSolver> make_chain_solver(int threads);
std::unique_ptr<LinearSolver> make_band_solver();
std::unique_ptr<LinearSolver> make_cholmod_solver();
std::unique_ptr<LinearSolver> make_umfpack_solver();
std::unique_ptr<LinearSolver> make_klu_solver();

}  // namespace hawser
