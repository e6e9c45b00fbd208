// Assembler: residual and tangent of a Model at a State.
//
//   R(q, v, a, t) = M(q) a + f_internal(q, v) - f_external(q, v, t),    Newton solves  T d = -R,
//   T = stiffness dR/dq + damping dR/dv + mass dR/da                    (TangentWeights)
//
// R has Model::unknowns entries in N (conjugate to r) and N m (conjugate to r'). At a support R is the force that the
// support must exert on the line: it is not zero at equilibrium. The tangent is constrained (rows and columns of
// prescribed unknowns are those of the identity, scaled) and condensed (inner unknowns of joints eliminated), so a
// linear solver sees only the uniform blocks, and of hubs a border (hubs.hpp):
//     tangent(...)  ->  reduce(T, R) = rhs  ->  solve  ->  expand(T, rhs, d)
// Results are the same bits for any number of threads.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "assembly/block_tridiagonal.hpp"
#include "assembly/hubs.hpp"
#include "assembly/matrix_panels.hpp"
#include "assembly/model.hpp"
#include "assembly/state.hpp"

namespace hawser {

/// The inner unknowns c of one joint, eliminated from x = the 12 chain unknowns of its element:
///   Kcc dc = -Rc - Kcx dx.
struct Elimination {
  Eigen::Matrix<double, Eigen::Dynamic, 12, 0, 3, 12> Kcx;
  Eigen::Matrix<double, 12, Eigen::Dynamic, 0, 12, 3> Kxc;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 3> Kcc_inverse;
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1> rc;  // of the last reduce
  int negative_pivots = 0;                               // of the symmetric part of Kcc
};

struct Tangent {
  BlockTridiagonal chain;
  std::vector<Elimination> eliminations;  // one per Model::joints
  Border border;                          // of the hubs; the chains hold their ends
  int negative_inner_pivots() const;

  /// Chains and border become their symmetric part.
  void symmetrize();
};

class TangentPanels;

/// Below this many elements one thread does all: starting a parallel region costs about as much as the sweep of a thousand (bench/README.md).
inline constexpr int serial_below = 2000;

class Assembler {
 public:
  /// threads >= 1. The model must outlive the assembler.
  explicit Assembler(const Model& model, int threads = 1);
  int threads() const;
  ~Assembler();
  Assembler(const Assembler&) = delete;
  Assembler& operator=(const Assembler&) = delete;

  const Model& model() const { return model_; }

  /// A tangent with its memory and pattern.
  Tangent make_tangent() const;

  void residual(const State& state, std::span<double> r) const;

  /// Residual and tangent together.
  void tangent(const State& state, const TangentWeights& weights, const TangentFloor& floor, std::span<double> r, Tangent& tangent) const;

  /// The same and `reduce`, made panel by panel for LinearSolver::factorize_and_solve; one at a time. r and rhs are complete when all panels are.
  TangentPanels tangent_panels(const State& state, const TangentWeights& weights, const TangentFloor& floor, std::span<double> r, Tangent& tangent,
                               std::span<double> rhs) const;

  /// rhs (Model::dofs) = -(R condensed), zero in constrained directions.
  void reduce(Tangent& tangent, std::span<const double> r, std::span<double> rhs) const;

  /// d (Model::unknowns) from the solution x (Model::dofs) of the condensed system, which may be the beginning of d.
  void expand(const Tangent& tangent, std::span<const double> x, std::span<double> d) const;

  /// Projects a residual on the directions that may move: what must vanish at equilibrium.
  void project(std::span<double> r) const;

 private:
  friend class TangentPanels;
  struct Impl;
  const Model& model_;
  std::unique_ptr<Impl> impl_;
};

/// Refers to everything it was made of.
class TangentPanels final : public MatrixPanels {
 public:
  void make(int chain, int panel, double* values) override;
  void add_carry(int chain, int panel, double* D_next) override;
  const BlockTridiagonal& whole() override;

  /// Known to the caller (symmetry.hpp).
  Symmetry symmetry() const override { return symmetry_; }
  void declare(Symmetry symmetry) { symmetry_ = symmetry; }

 private:
  friend class Assembler;
  TangentPanels(const Assembler& assembler, const State& state, const TangentWeights& weights, const TangentFloor& floor, std::span<double> r,
                Tangent& tangent, std::span<double> rhs);
  void add_beside(const Chain& chain, int panel, double* values);

  const Assembler& assembler_;
  const State& state_;
  TangentWeights weights_;
  TangentFloor floor_;
  std::span<double> r_, rhs_;
  Tangent& tangent_;  // its blocks: only what is beside the sweep, until whole() is asked for
  Symmetry symmetry_ = Symmetry::unknown;
};

}  // namespace hawser
