// StaticSystem: static equilibrium of a Model as Newton sees it, R(q, tow velocity, 0, 0) = 0.
//
// The tangent keeps Model::minimum_tension where the tension vanishes (theory 7.2); tolerance, reference force and
// round-off floor follow theory 6.1 with the reference force of solver/norms.hpp. Where the linear solver refuses the
// unsymmetric tangent of drag, its symmetric part is factorized: a modified Newton with the exact residual.
#pragma once

#include <span>
#include <vector>

#include "assembly/assembler.hpp"
#include "solver/bordered_solver.hpp"
#include "solver/creep.hpp"

namespace hawser {

class StaticSystem : public CreepingSystem {
 public:
  /// tolerance: relative to the reference force; 0: automatic. Everything referred to must outlive the system.
  /// exact_below: of the reference force; while the residual is larger, compressed points too keep their least tension in the
  /// matrix. That leads away from unstable states but converges linearly where a stable one is compressed somewhere (a beam
  /// below its Euler load, the last element of a bare end); there the exact matrix converges quadratically.
  StaticSystem(const Assembler& assembler, LinearSolver& linear, double tolerance, double exact_below, State& state);

  double residual() override;
  double tolerance() override { return relative_tolerance_ * reference_force_; }
  double roundoff() override { return roundoff_; }
  double least_tension() override;
  bool solve(double floor) override;
  IncrementSize increment() const override { return increment_size(model_, d_); }
  double work() const override;
  void carry(bool moving) override;
  void advance(double factor) override;
  /// The resistance is inertia, a = c (q - q_n): M is the mass matrix of the model (with_unit_mass).
  void resist(double c) override;
  void go_back() override;

  /// Takes the exact matrix only where it has no negative pivot: then every increment leads downhill.
  void keep_definite(bool keep) { keep_definite_ = keep; }

  double reference_force() const { return reference_force_; }
  WorstNode worst() const { return worst_node(model_, r_); }  // of the last residual
  bool modified() const { return modified_; }
  const FactorReport& factor_report() const { return factor_report_; }

 private:
  FactorReport solve_with(TangentPanels& panels);
  std::span<double> rhs() { return {d_.data(), model_.dofs}; }  // solved in the place of d_
  int negative_pivots_here();

  const Assembler& assembler_;
  const Model& model_;
  BorderedSolver linear_;
  State& state_;
  double relative_tolerance_;
  double exact_below_;
  Tangent tangent_;
  Symmetry symmetry_;
  std::vector<double> r_, d_, carried_, start_;                     // start_: q_n
  double resistance_ = 0.0;                                         // c, N/m^2
  double residual_ = 0.0, reference_force_ = 0.0, roundoff_ = 0.0;  // N
  double least_kept_ = 0.0;                                         // N, largest Model::minimum_tension
  bool modified_ = false, keep_definite_ = false;
  FactorReport factor_report_;
};

/// No compression that could buckle a line: none but rounding, or in a beam with a clamped end the Euler load of the cantilever, pi^2 EI/4 L^2.
bool free_of_compression(const Model& model, const State& state);

/// Negative pivots of the exact tangent of the loads that have a potential: axial, bending, weight, dead forces. Drag and
/// applied moments are left out: their tangent is not symmetric, and its symmetric part says nothing about stability.
int negative_pivots_of_elastic_tangent(const Model& model, const State& state);

/// The same, and 0 without a look at the tangent where no compression could buckle a line.
int unstable_directions(const Model& model, const State& state);

/// The model without those loads.
Model elastic_part(const Model& model);

/// The model with a mass of 1 kg a metre of line and no other; statics does not know the difference.
Model with_unit_mass(const Model& model);

/// Least strain tension [N] over all lines and its place.
struct LeastTension {
  double value = 0.0, s = 0.0;
  int line = 0;
};
LeastTension least_strain_tension(const Model& model, const State& state);

}  // namespace hawser
