// The chain solver on tangents as the program assembles them: taut, slack, compressed and badly scaled lines, statics and dynamics.
//
// The tolerance of 1e-14 is the promise of the contract, by elimination as it is or by the solver's own fallback.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "assembly/assembler.hpp"
#include "assembly/symmetry.hpp"
#include "solver/linear/linear_solver.hpp"
#include "tests/solver/linear/random_chains.hpp"
#include "tests/support/scene_samples.hpp"

namespace hawser {

namespace {

constexpr double promised = 1e-14;

/// A straight line waved by a tenth of its wave length, stretched evenly by `stretch`, in motion.
State waved_state(const Model& model, double stretch) {
  State state = model.make_state();
  for (int i = 0; i < model.lines[0].nodes; ++i) {
    const double s = model.lines[0].s[i], wave = 2 * M_PI / 20.0, height = 0.1 * 20.0 / (2 * M_PI);
    const Eigen::Vector3d slope = {1.0, height * wave * std::cos(wave * s), 0.1};
    const std::size_t at = model.dof(0, i);
    const Eigen::Vector3d place = {s, height * std::sin(wave * s), 0.1 * s - 80.0};
    Eigen::Map<Eigen::Vector3d>(&state.q[at]) = stretch * place;
    if (model.chain(0).block == 6) Eigen::Map<Eigen::Vector3d>(&state.q[at + 3]) = stretch * slope.normalized();
    Eigen::Map<Eigen::Vector3d>(&state.v[at]) = Eigen::Vector3d(0.1, -0.2, 0.05);
  }
  return state;
}

struct Outcome {
  FactorReport report;
  double backward_error = 0.0;
};

/// One section without point loads: joints have unknowns of their own, which waved_state does not set.
Scene plain_line(int elements, double EA, double EI) {
  Scene scene = test::loaded_line(elements, EI, EI);
  scene.lines[0].loads.clear();
  for (LineType& type : scene.line_types) type.EA = EA;
  return scene;
}

enum class Water { flowing, still };

/// In still water at rest, declared as statics does.
Outcome solve_tangent(Scene scene, double stretch, const TangentWeights& weights, Water water = Water::flowing) {
  if (water == Water::still) scene.environment.current.clear();
  const Model model = build_model(scene);
  const Assembler assembler(model);
  Tangent tangent = assembler.make_tangent();
  std::vector<double> residual(model.unknowns), b(model.dofs);
  State state = waved_state(model, stretch);
  if (water == Water::still) std::fill(state.v.begin(), state.v.end(), 0.0);
  assembler.tangent(state, weights, {}, residual, tangent);
  if (water == Water::still) tangent.chain.declare(static_symmetry(model, state));
  EXPECT_EQ(tangent.chain.symmetry(), water == Water::still ? Symmetry::symmetric : Symmetry::unknown);
  assembler.reduce(tangent, residual, b);
  const auto solver = make_linear_solver(LinearSolverKind::chain);
  solver->analyze(tangent.chain);
  Outcome outcome{solver->factorize(tangent.chain)};
  if (outcome.report.status != FactorStatus::ok) return outcome;
  std::vector<double> x = b;
  solver->solve(x);
  outcome.backward_error = test::backward_error(test::dense(tangent.chain), x, b);
  return outcome;
}

constexpr TangentWeights statics{1.0, 0.0, 0.0}, time_step{1.0, 40.0, 1600.0};

TEST(ChainAccuracy, OnTautSlackAndCompressedLines) {
  int indefinite = 0;
  for (const double stretch : {1.002, 1.0, 0.999, 0.9})
    for (const double EI : {0.0, 1.0, 1e4})
      for (const int elements : {20, 81})
        for (const TangentWeights& weights : {statics, time_step}) {
          SCOPED_TRACE(fmt::format("stretch {}, EI {}, {} elements, mass weight {}", stretch, EI, elements, weights.mass));
          const Outcome outcome = solve_tangent(plain_line(elements, 2e6, EI), stretch, weights);
          ASSERT_EQ(outcome.report.status, FactorStatus::ok) << outcome.report.message;
          EXPECT_LE(outcome.backward_error, promised);
          if (outcome.report.fell_back || outcome.report.negative_pivots > 0) ++indefinite;
        }
  EXPECT_GT(indefinite, 0);
}

TEST(ChainAccuracy, OnSymmetricTangentsOfTautSlackAndCompressedLines) {
  int indefinite = 0, eliminated = 0;
  for (const double stretch : {1.002, 1.0, 0.999, 0.9})
    for (const double EI : {0.0, 1.0, 1e4})
      for (const int elements : {20, 81}) {
        SCOPED_TRACE(fmt::format("stretch {}, EI {}, {} elements", stretch, EI, elements));
        const Outcome outcome = solve_tangent(plain_line(elements, 2e6, EI), stretch, statics, Water::still);
        ASSERT_EQ(outcome.report.status, FactorStatus::ok) << outcome.report.message;
        EXPECT_LE(outcome.backward_error, promised);
        if (outcome.report.fell_back || outcome.report.negative_pivots > 0) ++indefinite;
        if (!outcome.report.fell_back) ++eliminated;
      }
  EXPECT_GT(indefinite, 0);
  EXPECT_GT(eliminated, 0);
}

TEST(ChainAccuracy, OnSymmetricTangentsWithStiffnessesTwelveDecadesApart) {
  for (const double ratio : {1e4, 1e8, 1e12})
    for (const double stretch : {1.002, 0.999}) {
      SCOPED_TRACE(fmt::format("EA/EI {}, stretch {}", ratio, stretch));
      const Outcome outcome = solve_tangent(plain_line(60, ratio, 1.0), stretch, statics, Water::still);
      ASSERT_EQ(outcome.report.status, FactorStatus::ok) << outcome.report.message;
      EXPECT_LE(outcome.backward_error, promised);
    }
}

TEST(ChainAccuracy, WithStiffnessesTwelveDecadesApart) {
  for (const double ratio : {1e4, 1e8, 1e12})
    for (const double stretch : {1.002, 0.999})
      for (const TangentWeights& weights : {statics, time_step}) {
        SCOPED_TRACE(fmt::format("EA/EI {}, stretch {}, mass weight {}", ratio, stretch, weights.mass));
        const Outcome outcome = solve_tangent(plain_line(60, ratio, 1.0), stretch, weights);
        ASSERT_EQ(outcome.report.status, FactorStatus::ok) << outcome.report.message;
        EXPECT_LE(outcome.backward_error, promised);
      }
}

}  // namespace

}  // namespace hawser
