// LineSystem: the lines of a Model as a System for time schemes, with the norms of solver/norms.hpp (theory 6.1).
#pragma once

#include <vector>

#include "solver/time/system.hpp"

namespace hawser {

class LineSystem : public System {
 public:
  /// The assembler must outlive the system.
  explicit LineSystem(const Assembler& assembler);

  const Model& model() const { return model_; }

  std::size_t unknowns() const override { return model_.unknowns; }
  std::size_t dofs() const override { return model_.dofs; }
  Tangent make_tangent() const override { return assembler_.make_tangent(); }
  void residual(const State& state, std::span<double> r) const override { assembler_.residual(state, r); }
  void tangent(const State& state, const TangentWeights& weights, const TangentFloor& floor, std::span<double> r, Tangent& t) const override {
    assembler_.tangent(state, weights, floor, r, t);
  }
  FactorReport linearize(const State& state, const TangentWeights& weights, const TangentFloor& floor, BorderedSolver& solver, std::span<double> r,
                         Tangent& t, std::span<double> x) const override {
    TangentPanels panels = assembler_.tangent_panels(state, weights, floor, r, t, x);
    return solver.factorize_and_solve(panels, t, x);
  }
  void reduce(Tangent& t, std::span<const double> r, std::span<double> rhs) const override { assembler_.reduce(t, r, rhs); }
  void expand(const Tangent& t, std::span<const double> x, std::span<double> d) const override { assembler_.expand(t, x, d); }
  void project(std::span<double> r) const override { assembler_.project(r); }
  std::span<const std::size_t> prescribed() const override { return prescribed_; }
  void prescribe(State& state) const override { model_.prescribe(state); }
  ScaledResidual scaled_residual(std::span<const double> r) const override;
  IncrementMeasure measure_increment(std::span<const double> d) const override;
  double reference_length() const override { return reference_length_; }
  double reference_force(std::span<const double> r) const override;
  double roundoff_floor(const State& state) const override;

 private:
  const Assembler& assembler_;
  const Model& model_;
  std::vector<std::size_t> prescribed_;
  double reference_length_ = 0.0;  // m, the longest line
  double nodal_load_ = 0.0;        // N
};

}  // namespace hawser
