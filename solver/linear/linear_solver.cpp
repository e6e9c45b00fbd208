#include "solver/linear/linear_solver.hpp"

#include <array>
#include <stdexcept>

#include <fmt/format.h>

#include "solver/linear/backends.hpp"

namespace hawser {

namespace {

struct Backend {
  LinearSolverKind kind;
  std::string_view name;
  std::unique_ptr<LinearSolver> (*make)(int threads);
};

template <std::unique_ptr<LinearSolver> (*make)()>
std::unique_ptr<LinearSolver> on_one_thread(int) {
  return make();
}

constexpr std::array backends = {
    Backend{LinearSolverKind::automatic, "auto", make_chain_solver},
    Backend{LinearSolverKind::chain, "chain", make_chain_solver},
    Backend{LinearSolverKind::band, "band", on_one_thread<make_band_solver>},
    Backend{LinearSolverKind::cholmod, "cholmod", on_one_thread<make_cholmod_solver>},
    Backend{LinearSolverKind::umfpack, "umfpack", on_one_thread<make_umfpack_solver>},
    Backend{LinearSolverKind::klu, "klu", on_one_thread<make_klu_solver>},
};

const Backend& backend_of(LinearSolverKind kind) {
  for (const Backend& b : backends)
    if (b.kind == kind) return b;
  return backends.front();
}

}  // namespace

FactorReport LinearSolver::factorize_and_solve(MatrixPanels& panels, std::span<double> b) {
  const FactorReport report = factorize(panels.whole());
  if (report.status == FactorStatus::ok) solve(b);
  return report;
}

std::unique_ptr<LinearSolver> make_linear_solver(LinearSolverKind kind, int threads) { return backend_of(kind).make(threads); }

LinearSolverKind linear_solver_kind(std::string_view name) {
  for (const Backend& b : backends)
    if (b.name == name) return b.kind;
  throw std::invalid_argument(fmt::format("no linear solver \"{}\": auto, chain, band, cholmod, umfpack or klu", name));
}

std::string_view name_of(LinearSolverKind kind) { return backend_of(kind).name; }

std::span<const LinearSolverKind> all_linear_solvers() {
  static constexpr std::array kinds = {LinearSolverKind::chain, LinearSolverKind::band, LinearSolverKind::cholmod, LinearSolverKind::umfpack,
                                       LinearSolverKind::klu};
  return kinds;
}

}  // namespace hawser
