// Statics tells the linear solver of symmetric tangents, and of no others.
#include <gtest/gtest.h>

#include "solver/linear/linear_solver.hpp"
#include "solver/static_system.hpp"
#include "solver/statics.hpp"
#include "tests/support/scene_samples.hpp"

namespace hawser {
namespace {

/// The chain solver, and what it was told.
class Listener final : public LinearSolver {
 public:
  std::string_view name() const override { return chain_->name(); }
  bool takes_unsymmetric() const override { return true; }
  void analyze(const BlockTridiagonal& pattern) override { chain_->analyze(pattern); }
  FactorReport factorize(const BlockTridiagonal& matrix) override {
    heard = matrix.symmetry();
    return chain_->factorize(matrix);
  }
  void solve(std::span<double> b) override { chain_->solve(b); }
  FactorReport solve_once(MatrixPanels& panels, std::span<double> b) override {
    heard = panels.symmetry();
    return chain_->solve_once(panels, b);
  }
  std::size_t bytes() const override { return chain_->bytes(); }

  Symmetry heard = Symmetry::unknown;

 private:
  std::unique_ptr<LinearSolver> chain_ = make_linear_solver(LinearSolverKind::chain);
};

Symmetry heard_in(const Scene& scene) {
  const Model model = build_model(scene);
  const Assembler assembler(model);
  State state = static_start(model, StaticStart::catenary);
  Listener listener;
  StaticSystem system(assembler, listener, 0.0, 0.0, state);
  system.residual();
  EXPECT_TRUE(system.solve(0.0));
  return listener.heard;
}

TEST(StaticSystemSymmetry, IsToldInStillWaterOnly) {
  Scene scene = test::loaded_line(40, 500.0, 900.0);
  EXPECT_EQ(heard_in(scene), Symmetry::unknown);
  scene.environment.current.clear();
  EXPECT_EQ(heard_in(scene), Symmetry::symmetric);
}

}  // namespace
}  // namespace hawser
