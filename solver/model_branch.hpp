// ModelBranch: the equilibria of a family of Models, one for every value of a parameter p, as continuation sees them.
//
//   R(q, p) = 0 at v = tow velocity, a = 0, t = 0;      dR/dp = (R(q + h s', p + h) - R(q - h s', p - h)) / 2h
//
// p may change anything that keeps the layout of q: an end, a length, a load, the current. s' is how the lines go with their held ends: what
// is left of the way of an end, u [m], is spread linearly along its line, r += u_from (1 - s/L) + u_to s/L and
// r' += (u_to - u_from)/L; a line with a free end is shifted.
// Motions are measured by <a, b> = 1/(N L^2) sum over the N nodes of a_r . b_r + l^2 a_r' . b_r', L the longest line, l = Model::node_length: a mean
// motion of L has size 1.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "assembly/assembler.hpp"
#include "solver/bordered_solver.hpp"
#include "solver/continuation.hpp"
#include "solver/statics.hpp"

namespace hawser {

/// The model at p; nothing where p means none.
using ModelAt = std::function<std::optional<Model>(double p)>;

/// Numbers that two models share if a state of one is a state of the other.
std::vector<int> layout_of(const Model& model);

/// Moves the held ends of every line to where the model has them at t = 0, the lines with them, and turns its clamps.
void follow_supports(const Model& model, State& state);

/// Directions in which an equilibrium is unstable (static_system.hpp), but neutral is only what `hawser static` calls so, |stiffness| <= 1e-6
/// reference force/L^2 (stability.hpp), and rounding. Statics also takes for neutral what a hundredth of a pendulum's stiffness could hold, which is
/// up to a percent of the load at which a column buckles.
int directions_that_give_way(const Model& model, const State& state, double reference_force);

class ModelBranch final : public BranchSystem {
 public:
  /// `like`: a model of the family. step: h of the difference, in p.
  ModelBranch(ModelAt model_at, const Model& like, double step, const StaticOptions& options);
  ~ModelBranch() override;

  bool move_to(double p, std::vector<double>& q) override;
  BranchResidual residual(std::span<const double> q) override;
  bool respond(std::span<const double> q, std::size_t spring, BranchResponse& response) override;
  int negative_pivots(std::span<const double> q) override;
  double product(std::span<const double> a, std::span<const double> b) const override;
  std::size_t strongest(std::span<const double> motion) const override;

  /// At the p of the last move_to.
  State state_of(std::span<const double> q) const;
  const Model& model() const;

 private:
  struct Instance;

  std::unique_ptr<Instance> instance_at(double p) const;
  bool differentiate(std::span<const double> q, BranchResponse& response, std::vector<double>& by_p) const;

  ModelAt model_at_;
  std::vector<int> layout_;
  double step_;
  StaticOptions options_;
  std::vector<double> weights_;  // of the product; 0 for inner unknowns
  std::vector<char> held_;       // unknowns that are prescribed, or repeat those of another line end
  std::unique_ptr<LinearSolver> chains_;
  BorderedSolver linear_;
  std::unique_ptr<Instance> instance_;
  std::optional<Tangent> tangent_;
};

}  // namespace hawser
