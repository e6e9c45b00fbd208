// BorderedSolver: solves the tangent of a network, the chains by any linear solver, the hubs by their Schur complement.
//
//   [ A  B ] [ y ]   [ f ]        X = E - A^-1 B:  every chain's answer to unit motions of its ends at hubs
//   [ C  D ] [ h ] = [ g ]        S = [C D] X [N/m]: the stiffness of the hubs, the lines following,     S h = g - C A^-1 f,   x = A^-1 f + X h
//
// (assembly/hubs.hpp has the symbols.) A chain has at most two ends at hubs and chains do not couple, so three or six solves of all chains give X.
// S is sparse: hubs couple where a line joins them. Without hubs every call goes straight to the linear solver.
// A failure is a returned FactorReport; where S is singular to working accuracy it names the first end of the hub that is held by nothing.
#pragma once

#include <Eigen/SparseCore>
#include <Eigen/SparseLU>
#include <span>
#include <vector>

#include "assembly/assembler.hpp"
#include "solver/linear/linear_solver.hpp"

namespace hawser {

class BorderedSolver {
 public:
  /// The linear solver of the chains must outlive this one.
  explicit BorderedSolver(LinearSolver& chains) : chains_(chains) {}

  void analyze(const Tangent& pattern);
  FactorReport factorize(const Tangent& tangent);

  /// Both at once, as LinearSolver::factorize_and_solve; with hubs the panels are made whole first.
  FactorReport factorize_and_solve(TangentPanels& panels, const Tangent& tangent, std::span<double> b);
  /// As LinearSolver::solve_once.
  FactorReport solve_once(TangentPanels& panels, const Tangent& tangent, std::span<double> b);

  /// In place, b as Assembler::reduce leaves it. Only after a factorize that returned ok.
  void solve(std::span<double> b);

  /// S of the last factorize, 3 rows a hub in the order of Model::hubs.
  const Eigen::SparseMatrix<double>& hub_stiffness() const { return stiffness_; }

 private:
  struct Place {
    int slot = 0;                      // its columns are in responses_[3 slot] to [3 slot + 2]
    int partner = -1;                  // the other end of its chain, where that is at a hub too
    std::size_t first = 0, count = 0;  // unknowns of its chain
  };

  void respond();
  void condense();
  FactorReport factorize_hubs(FactorReport report);
  void hold(std::span<double> b) const;

  LinearSolver& chains_;
  Border border_;
  std::vector<Place> places_;                   // of the ends of the border
  std::vector<std::vector<double>> responses_;  // X: a column of every chain at a time
  Eigen::SparseMatrix<double> stiffness_;
  Eigen::SparseLU<Eigen::SparseMatrix<double>> hubs_;
  Eigen::VectorXd motion_;
};

/// y = T x, x with one r at all ends of a hub; in y the sum over its ends stands at the first one, zero at the others.
void multiply(const Tangent& tangent, std::span<const double> x, std::span<double> y);

/// Negative eigenvalues of the symmetric part of the hubs' stiffness; with those of the chains they make up those of the whole tangent (Haynsworth).
int negative_hub_pivots(const Tangent& tangent);

}  // namespace hawser
