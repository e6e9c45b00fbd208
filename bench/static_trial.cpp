// The public trial of statics: random scenes, each solved from nothing, every answer checked (README.md, "The trial of statics").
//
//   hawser_static_trial [SCENES [SEED]]          a table by kind, and every scene that failed or came out wrong
//   hawser_static_trial --scene NUMBER [SEED]    one scene with its stages
//   hawser_static_trial --networks ...           the same of networks instead of one line
//
// Exit code 1 if any failed.
#include <fmt/format.h>

#include <array>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include "bench/trial.hpp"

namespace {

using namespace hawser;
using namespace hawser::bench;

struct Tally {
  int scenes = 0, failed = 0, wrong = 0, loose = 0, worst = 0;
  long factorizations = 0;
  std::vector<double> seconds;

  void add(const TrialOutcome& outcome) {
    ++scenes;
    failed += !outcome.converged;
    wrong += outcome.wrong.has_value();
    loose += outcome.loose;
    worst = std::max(worst, outcome.factorizations);
    factorizations += outcome.factorizations;
    seconds.push_back(outcome.seconds);
  }

  void print(const std::string& name) {
    std::sort(seconds.begin(), seconds.end());
    fmt::print("| {} | {} | {} | {} | {} | {:.1f} | {} | {:.2f} | {:.1f} |\n", name, scenes, scenes - failed - wrong, loose, wrong,
               static_cast<double>(factorizations) / scenes, worst, 1e3 * seconds[seconds.size() / 2], 1e3 * seconds.back());
  }
};

void print_stages(const TrialOutcome& outcome) {
  for (const std::string& stage : outcome.report.stages) fmt::print("  {}\n", stage);
  const Failure& failure = outcome.report.failure;
  if (outcome.wrong) fmt::print("  WRONG: {}\n", *outcome.wrong);
  if (!outcome.converged)
    fmt::print("  {} (\"{}\", s = {:.6g} m)\n  cause: {}\n  try: {}\n", failure.what, failure.line, failure.s, failure.cause, failure.remedy);
}

using Draw = Trial (*)(std::uint64_t seed, std::uint64_t number);

int one_scene(Draw draw, std::uint64_t number, std::uint64_t seed) {
  const Trial trial = draw(seed, number);
  const TrialOutcome outcome = run_trial(trial);
  fmt::print("scene {} of seed {}: {}, {} factorizations, {:.2f} ms\n", number, seed, trial.kind, outcome.factorizations, 1e3 * outcome.seconds);
  print_stages(outcome);
  return !outcome.converged || outcome.wrong;
}

int all_scenes(Draw draw, std::uint64_t scenes, std::uint64_t seed) {
  std::map<std::string, Tally> kinds;
  std::vector<std::string> order, complaints;
  Tally all;
  for (std::uint64_t number = 0; number < scenes; ++number) {
    const Trial trial = draw(seed, number);
    const TrialOutcome outcome = run_trial(trial);
    if (!kinds.contains(trial.kind)) order.push_back(trial.kind);
    kinds[trial.kind].add(outcome);
    all.add(outcome);
    if (outcome.wrong)
      complaints.push_back(fmt::format("{} {} ({}): WRONG, {}", seed, number, trial.kind, *outcome.wrong));
    else if (!outcome.converged)
      complaints.push_back(fmt::format("{} {} ({}): {}", seed, number, trial.kind, outcome.report.failure.what));
    else if (outcome.loose)
      complaints.push_back(fmt::format("{} {} ({}): solved to 1e-6 only", seed, number, trial.kind));
  }
  fmt::print(
      "| kind | scenes | solved | of these to 1e-6 | wrong | factorizations, mean | worst | ms a scene, median | worst "
      "|\n|---|---|---|---|---|---|---|---|---|\n");
  for (const std::string& kind : order) kinds[kind].print(kind);
  all.print("all");
  fmt::print("\nSeed and number of every scene that was not solved, or not to 1e-10 ({}):\n", complaints.size());
  for (const std::string& complaint : complaints) fmt::print("  {}\n", complaint);
  return all.failed + all.wrong > 0;
}

}  // namespace

int main(int count, char** words) {
  std::vector<std::string> args(words + 1, words + count);
  const bool networks = !args.empty() && args[0] == "--networks";
  if (networks) args.erase(args.begin());
  const Draw draw = networks ? draw_network : draw_trial;
  const auto number = [&](std::size_t i, std::uint64_t otherwise) {
    return i < args.size() ? std::strtoull(args[i].c_str(), nullptr, 10) : otherwise;
  };
  if (!args.empty() && args[0] == "--scene") return one_scene(draw, number(1, 0), number(2, 1));
  return all_scenes(draw, number(0, networks ? 1400 : 10000), number(1, 1));
}
