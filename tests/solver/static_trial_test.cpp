// Scenes of the public trial of statics (bench/README.md): the first 500 of one line, the first 56 networks. None fails, none is wrong.
// ./dev bench runs 10 000 and 1400, of which some fail: bench/README.md says which.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <vector>

#include "bench/trial.hpp"

namespace hawser::bench {
namespace {

constexpr std::uint64_t seed = 1;

/// Every `kinds`-th of the scenes, from this one on.
struct Slice {
  Trial (*draw)(std::uint64_t seed, std::uint64_t number);
  int first, kinds, scenes;
};

std::vector<Slice> slices() {
  std::vector<Slice> all;
  for (int kind = 0; kind < trial_kinds; ++kind) all.push_back({draw_trial, kind, trial_kinds, 500});
  for (int kind = 0; kind < network_kinds; ++kind) all.push_back({draw_network, kind, network_kinds, 4 * network_kinds});
  return all;
}

class StaticTrial : public ::testing::TestWithParam<Slice> {};

TEST_P(StaticTrial, EverySceneOfThisKindIsSolvedAndEveryAnswerHolds) {
  for (int number = GetParam().first; number < GetParam().scenes; number += GetParam().kinds) {
    const Trial trial = GetParam().draw(seed, number);
    const TrialOutcome outcome = run_trial(trial);
    EXPECT_TRUE(outcome.converged) << trial.kind << ", scene " << number << ": " << outcome.report.failure.what;
    EXPECT_FALSE(outcome.loose) << trial.kind << ", scene " << number;
    EXPECT_FALSE(outcome.wrong) << trial.kind << ", scene " << number << ": " << *outcome.wrong;
  }
}

std::string name_of_kind(const Slice& slice) {
  std::string name = slice.draw(seed, slice.first).kind;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Kinds, StaticTrial, ::testing::ValuesIn(slices()), [](const auto& kind) { return name_of_kind(kind.param); });

/// Scenes beyond the slices that were refused once, or answered by a knot.
struct Missed {
  const char* cause;
  Trial (*draw)(std::uint64_t seed, std::uint64_t number);
  std::uint64_t seed, number;
  bool minutes_under_sanitizers = false;
};

constexpr Missed missed[] = {
    {"the clamped end of a pipe shrinks to nothing", draw_trial, 1, 1206},
    {"the other end of one does", draw_trial, 1, 3206},
    {"a stiff line lies in three layers within an element", draw_trial, 1, 5854},
    {"a slack line to the bed, compressed by less than the load on an element", draw_trial, 1, 2254},
    {"another one does", draw_trial, 2, 6674},
    {"a vertical line, compressed by less than the load on an element", draw_trial, 2, 7222},
    {"only creep ends at the last slope of a bare end", draw_trial, 1, 2830},
    {"a bare end, compressed by less than the load on an element", draw_trial, 2, 9690},
    {"a pipe on a slope in a current, stable with friction and drag only", draw_trial, 2, 797},
    {"a pipe laid across a current, stable with friction and drag only", draw_trial, 3, 4836},
    {"directions of a bare end that nothing holds", draw_trial, 2, 1150},
    {"a network with a compressed line that drag holds", draw_network, 1, 335},
    {"legs on a bed with friction: only the branch in the slip leads there", draw_network, 1, 997, true},
    {"a slack ring beside lines of 7 GN", draw_network, 1, 905},
    {"another one", draw_network, 1, 149},
    {"a ring that folds in a current", draw_network, 1, 1283},
    {"a ring that folds in a current", draw_network, 1, 1395},
};

class StaticTrialMissed : public ::testing::TestWithParam<Missed> {};

TEST_P(StaticTrialMissed, SceneIsSolvedNow) {
  const Missed& scene = GetParam();
#ifdef __SANITIZE_ADDRESS__
  if (scene.minutes_under_sanitizers) GTEST_SKIP() << "takes minutes here; the Release build runs it";
#endif
  const TrialOutcome outcome = run_trial(scene.draw(scene.seed, scene.number));
  EXPECT_TRUE(outcome.converged) << scene.cause << ": " << outcome.report.failure.what;
  EXPECT_FALSE(outcome.loose) << scene.cause;
  EXPECT_FALSE(outcome.wrong) << scene.cause << ": " << *outcome.wrong;
}

INSTANTIATE_TEST_SUITE_P(Scenes, StaticTrialMissed, ::testing::ValuesIn(missed), [](const auto& scene) {
  return fmt::format("{}_{}_of_seed_{}", scene.param.draw == draw_network ? "network" : "scene", scene.param.number, scene.param.seed);
});

TEST(StaticTrialScenes, AreTheSameEveryTime) {
  for (const auto draw : {draw_trial, draw_network})
    for (int number = 0; number < trial_kinds; ++number) {
      const Model a = build_model(draw(3, number).scene), b = build_model(draw(3, number).scene);
      EXPECT_EQ(a.element.length, b.element.length);
      EXPECT_EQ(a.element.EA, b.element.EA);
      EXPECT_EQ(a.element.weight, b.element.weight);
    }
}

TEST(StaticTrialCheck, FindsWhatIsWrongWithANetwork) {
  const Trial trial = draw_network(seed, 0);  // equal legs
  const Model model = build_model(trial.scene);
  State state;
  ASSERT_TRUE(solve_static(Assembler(model), {}, state).converged);
  EXPECT_FALSE(complaint(trial, model, state));
  // The equilibrium under a body that is one part in a million heavier.
  Trial heavier = trial;
  *heavier.scene.points[0].body.wet_weight *= 1.000001;
  const Model other = build_model(heavier.scene);
  ASSERT_TRUE(solve_static(Assembler(other), {}, state).converged);
  EXPECT_TRUE(complaint(trial, model, state));
}

TEST(StaticTrialCheck, FindsWhatIsWrongWithAnAnswer) {
  const Trial trial = draw_trial(seed, 0);  // a slack span
  const Model model = build_model(trial.scene);
  const Assembler assembler(model);
  State state;
  ASSERT_TRUE(solve_static(assembler, {}, state).converged);
  EXPECT_FALSE(complaint(trial, model, state));
  State moved = state;
  moved.q[model.dof(0, 3)] += 1e-3;
  EXPECT_TRUE(complaint(trial, model, moved));
  // The equilibrium of a line that is one part in a thousand heavier.
  Trial heavier = trial;
  heavier.scene.line_types[0].wet_weight = 1.001 * *trial.scene.line_types[0].wet_weight;
  const Model other = build_model(heavier.scene);
  ASSERT_TRUE(solve_static(Assembler(other), {}, state).converged);
  EXPECT_TRUE(complaint(trial, model, state));
}

}  // namespace
}  // namespace hawser::bench
