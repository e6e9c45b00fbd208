// LinearSolver: one contract for the direct solvers of T d = b, T block tridiagonal (assembly/block_tridiagonal.hpp).
//
//   analyze once per pattern -> factorize for every new set of values -> solve as often as wanted
//
// A numerical failure is a returned status, never an exception. Nothing is allocated after analyze but UMFPACK's numeric factors, KLU's where
// it chooses rows anew, and the chain solver's pivoted fallback at its first use. What is promised of accuracy: solver/linear/README.md.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "assembly/matrix_panels.hpp"

namespace hawser {

enum class LinearSolverKind { automatic, chain, band, cholmod, umfpack, klu };

enum class FactorStatus {
  ok,
  singular,        // a zero or unusable pivot: `message` says at which unknown
  not_applicable,  // the solver cannot take this matrix (CHOLMOD: unsymmetric, or indefinite with growing entries)
};

struct FactorReport {
  FactorStatus status = FactorStatus::ok;
  int negative_pivots = -1;     // negative eigenvalues, if the matrix is symmetric (the caller knows that); -1: rows were exchanged
  double smallest_pivot = 0.0;  // absolute values
  double largest_pivot = 0.0;
  bool fell_back = false;          // the solver's own pivoted fallback was used
  std::size_t failed_unknown = 0;  // where status != ok
  std::string message;
};

class LinearSolver {
 public:
  virtual ~LinearSolver() = default;
  virtual std::string_view name() const = 0;

  /// Can factorize a matrix that is not symmetric.
  virtual bool takes_unsymmetric() const = 0;

  virtual void analyze(const BlockTridiagonal& pattern) = 0;
  virtual FactorReport factorize(const BlockTridiagonal& matrix) = 0;

  /// Solves in place: b becomes the solution. Only after a factorize that returned ok.
  virtual void solve(std::span<double> b) = 0;

  /// Both at once for a matrix that is made panel by panel, with its right-hand side b, which becomes the solution. Factors stay for `solve`.
  /// Solvers that cannot eliminate panels as they come take the whole matrix; where it is not_applicable, b is then the right-hand side.
  virtual FactorReport factorize_and_solve(MatrixPanels& panels, std::span<double> b);

  /// The same where nothing else will be solved with this matrix: factors need not stay.
  virtual FactorReport solve_once(MatrixPanels& panels, std::span<double> b) { return factorize_and_solve(panels, b); }

  /// Bytes held by factors and workspace after a factorize.
  virtual std::size_t bytes() const = 0;
};

/// The only place that names the backends. `automatic` is the chain solver, the one that uses more than one thread (two, on long chains): the
/// results are the same bits.
std::unique_ptr<LinearSolver> make_linear_solver(LinearSolverKind kind, int threads = 1);

/// "auto", "chain", "band", "cholmod", "umfpack", "klu"; throws std::invalid_argument for any other name.
LinearSolverKind linear_solver_kind(std::string_view name);
std::string_view name_of(LinearSolverKind kind);

/// Every backend, for tests and charts.
std::span<const LinearSolverKind> all_linear_solvers();

/// Number of negative eigenvalues of the symmetric part of a matrix (Sylvester: signs of pivots), counted on the chains.
struct Inertia {
  int negative = 0;
  int zero = 0;                    // pivots, with all they couple to, below 1e-14 of the largest diagonal entry
  std::size_t first_negative = 0;  // unknown
};
Inertia inertia_of_symmetric_part(const BlockTridiagonal& matrix);

}  // namespace hawser
