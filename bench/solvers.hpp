// Every linear solver that the charts show: the backends of solver/linear, and SUNDIALS' own.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bench/sundials_band.hpp"
#include "solver/linear/linear_solver.hpp"

namespace hawser::bench {

struct NamedSolver {
  std::string name;
  std::function<std::unique_ptr<LinearSolver>()> make;
};

inline std::vector<NamedSolver> compared_solvers() {
  std::vector<NamedSolver> solvers;
  for (const LinearSolverKind kind : all_linear_solvers())
    solvers.push_back({std::string(name_of(kind)), [kind] { return make_linear_solver(kind); }});
  solvers.push_back({"sundials", make_sundials_band_solver});
  return solvers;
}

}  // namespace hawser::bench
