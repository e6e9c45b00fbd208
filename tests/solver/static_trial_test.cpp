// The first scenes of the public trial of statics (bench/README.md), 500 of one line: none fails, none is wrong. ./dev bench runs 10 000, and
// 2000 networks.
#include <gtest/gtest.h>

#include "bench/trial_check.hpp"

namespace hawser::bench {
namespace {

constexpr std::uint64_t seed = 1;
constexpr int scenes = 500;

class StaticTrial : public ::testing::TestWithParam<int> {};

TEST_P(StaticTrial, EverySceneOfThisKindIsSolvedAndEveryAnswerHolds) {
  for (int number = GetParam(); number < scenes; number += TrialScenes::kinds) {
    const Trial trial = draw_trial(seed, number);
    const TrialOutcome outcome = run_trial(trial);
    EXPECT_TRUE(outcome.converged) << trial.kind << ", scene " << number << ": " << outcome.report.failure.what;
    EXPECT_FALSE(outcome.loose) << trial.kind << ", scene " << number;
    EXPECT_FALSE(outcome.wrong) << trial.kind << ", scene " << number << ": " << *outcome.wrong;
  }
}

std::string name_of_kind(int kind) {
  std::string name = draw_trial(seed, kind).kind;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Kinds, StaticTrial, ::testing::Range(0, TrialScenes::kinds), [](const auto& kind) { return name_of_kind(kind.param); });

TEST(StaticTrialScenes, AreTheSameEveryTime) {
  for (const auto draw : {draw_trial, draw_network})
    for (int number = 0; number < TrialScenes::kinds; ++number) {
      const Model a = build_model(draw(3, number).scene), b = build_model(draw(3, number).scene);
      EXPECT_EQ(a.element.length, b.element.length);
      EXPECT_EQ(a.element.EA, b.element.EA);
      EXPECT_EQ(a.element.weight, b.element.weight);
    }
}

TEST(StaticTrialCheck, FindsWhatIsWrongWithAnAnswer) {
  const Trial trial = draw_trial(seed, 0);  // a slack span
  const Model model = build_model(trial.scene);
  const Assembler assembler(model);
  State state;
  ASSERT_TRUE(solve_static(assembler, {}, state).converged);
  EXPECT_FALSE(TrialCheck(trial, model, state).complaint());
  State moved = state;
  moved.q[model.dof(0, 3)] += 1e-3;
  EXPECT_TRUE(TrialCheck(trial, model, moved).complaint());
  // The equilibrium of a line that is one part in a thousand heavier.
  Trial heavier = trial;
  heavier.scene.line_types[0].wet_weight = 1.001 * *trial.scene.line_types[0].wet_weight;
  const Model other = build_model(heavier.scene);
  ASSERT_TRUE(solve_static(Assembler(other), {}, state).converged);
  EXPECT_TRUE(TrialCheck(trial, model, state).complaint());
}

}  // namespace
}  // namespace hawser::bench
