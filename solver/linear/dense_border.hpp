// DenseBorder: chains with a few unknowns more that may couple to every node: a torque that is constant along a line, a rigid body.
//
//   [ A  B ] [ x ]   [ f ]      A: n chain unknowns (BlockTridiagonal), by any linear solver;   B: n x m,  C: m x n,  D: m x m,  m small
//   [ C  D ] [ y ] = [ g ]      X = A^-1 B,   S = D - C X,   S y = g - C A^-1 f,   x = A^-1 f - X y
//
// m solves of the chains make X, and S is factorized with exchanges of rows. A itself must have an inverse: a border does not hold what the chains
// leave loose, and what A loses by its condition is not won back. Hubs, whose columns reach over two nodes, have a border of their own
// (solver/bordered_solver.hpp). A failure is a returned FactorReport; where S has no pivot left, failed_unknown >= n. (Singular but for rounding, it
// is solved, as by a LinearSolver.)
#pragma once

#include <span>

#include <Eigen/Dense>

#include "solver/linear/linear_solver.hpp"

namespace hawser {

class DenseBorder {
 public:
  /// The linear solver of the chains must outlive this one.
  explicit DenseBorder(LinearSolver& chains) : chains_(chains) {}

  void analyze(const BlockTridiagonal& pattern, int border);

  /// negative_pivots: of the whole matrix, where A is declared symmetric, C = B^T and D = D^T, and the chains were counted (Haynsworth); else -1.
  FactorReport factorize(const BlockTridiagonal& A, const Eigen::MatrixXd& B, const Eigen::MatrixXd& C, const Eigen::MatrixXd& D);

  /// In place: f and g become x and y. Only after a factorize that returned ok.
  void solve(std::span<double> f, std::span<double> g);

 private:
  LinearSolver& chains_;
  Eigen::MatrixXd responses_, rows_, complement_;  // X, C, S
  Eigen::FullPivLU<Eigen::MatrixXd> factors_;      // of S
  Eigen::VectorXd border_;
};

}  // namespace hawser
