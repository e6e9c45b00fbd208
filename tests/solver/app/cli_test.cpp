// Commands, options, exit codes and the documents on stdout.
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "solver/app/command_check.hpp"
#include "tests/solver/app/cli_program.hpp"
#include "tests/support/network_scenes.hpp"

namespace hawser::test {
namespace {

using Cli = ProgramTest;

TEST_F(Cli, HelpStartsWithAnExampleForTheProgramAndEveryCommand) {
  for (const char* command : {"", "check ", "static ", "run "}) {
    const Outcome help = hawser(std::string(command) + "--help");
    EXPECT_EQ(help.code, 0);
    EXPECT_EQ(help.out.find("Example:\n  hawser "), 0U) << help.out;
    EXPECT_EQ(help.err, "");
  }
}

TEST_F(Cli, VersionNamesTheProgram) {
  const Outcome version = hawser("--version");
  EXPECT_EQ(version.code, 0);
  EXPECT_EQ(version.out.find("hawser "), 0U);
}

TEST_F(Cli, BadUsageEndsWithCodeTwoAndSaysWhyOnStderr) {
  write("scene.toml", small_scene);
  for (const char* arguments :
       {"", "nonsense", "static", "static scene.toml --nonsense", "static scene.toml --start sideways", "static scene.toml --stations 1",
        "static scene.toml --method magic", "static scene.toml --probe 0", "static scene.toml --probe -3", "static scene.toml --probe some",
        "static scene.toml --probe 3 --vary points.top.position.0=0:1:2", "static scene.toml --method kinsol --vary points.top.position.0=0:1:2",
        "run scene.toml --probe 3", "run scene.toml --threads -1", "static missing.toml", "static scene.toml --from missing.h5",
        "run scene.toml --out scene.toml", "static scene.toml --set nonsense=1", "static scene.toml --from a --start straight"}) {
    const Outcome outcome = hawser(arguments);
    EXPECT_EQ(outcome.code, 2) << arguments;
    EXPECT_EQ(outcome.out, "") << arguments;
    EXPECT_NE(outcome.err, "") << arguments;
  }
}

TEST_F(Cli, WhatIsNotBuiltYetIsRefusedByName) {
  write("scene.toml", small_scene);
  for (const char* arguments : {"modes scene.toml -n 20 --json", "sweep scene.toml", "chart scene.toml", "report scene.toml", "convert scene.toml"}) {
    const Outcome outcome = hawser(arguments);
    EXPECT_EQ(outcome.code, 2) << arguments;
    EXPECT_NE(outcome.err.find("not built yet"), std::string::npos) << arguments;
  }
}

TEST_F(Cli, BadInputWritesNothing) {
  write("scene.toml", with(small_scene, "EA = 4.0e7", "EA = -1.0"));
  for (const char* command : {"run scene.toml --out results", "static scene.toml --out results", "run scene.toml"}) {
    EXPECT_EQ(hawser(command).code, 2);
    EXPECT_FALSE(exists("results"));
    EXPECT_FALSE(exists("scene.out"));
  }
}

TEST_F(Cli, ASceneWithoutDynamicsCannotBeRun) {
  write("scene.toml", small_scene.substr(0, small_scene.find("[dynamics]")));
  const Outcome outcome = hawser("run scene.toml");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("[dynamics]"), std::string::npos);
  EXPECT_EQ(hawser("static scene.toml").code, 0);
}

TEST_F(Cli, StaticDocumentHasEveryKeyOfTheContract) {
  write("scene.toml", small_scene);
  const Outcome outcome = hawser("static scene.toml --json");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const nlohmann::json document = outcome.json();
  EXPECT_TRUE(document.at("converged").get<bool>());
  EXPECT_TRUE(document.at("stable").get<bool>());
  EXPECT_TRUE(document.at("iterations").is_number_integer());
  EXPECT_TRUE(document.at("residual").is_number());
  EXPECT_TRUE(document.at("wall_seconds").is_number());
  const nlohmann::json& line = document.at("lines").at("a");
  EXPECT_EQ(line.at("elements"), 10);
  EXPECT_TRUE(line.at("error_estimate").is_number());
  for (const char* key : {"touchdown"}) EXPECT_TRUE(line.at(key).is_array());
  for (const char* key : {"moment_from", "moment_to"}) EXPECT_EQ(line.at(key).size(), 3U);
  for (const char* key : {"torque_from", "torque_to"}) EXPECT_EQ(line.at(key), 0.0);
  for (const char* key : {"s", "x", "y", "z", "tension", "curvature", "twist"}) EXPECT_EQ(line.at("stations").at(key).size(), 11U) << key;
  // Weights: line (2.5 - 1000 pi 0.04^2/4) 100 g, body 100 g (no volume). Rounding of the solve: a billionth.
  const double g = 9.80665, area = 0.25 * 3.14159265358979324 * 0.04 * 0.04, body = 100.0 * g, total = body + (2.5 - 1000.0 * area) * 100.0 * g;
  EXPECT_NEAR(line.at("tension_to").get<double>(), body, 1e-9 * total);
  EXPECT_NEAR(line.at("tension_from").get<double>(), total, 1e-9 * total);
  EXPECT_NEAR(document.at("points").at("top").at("force").at(2).get<double>(), -total, 1e-9 * total);
  EXPECT_EQ(document.at("points").at("end").at("position").size(), 3U);
  EXPECT_EQ(line.at("stiffness_from").size(), 3U);
  EXPECT_EQ(line.at("stiffness_from").at(2).size(), 3U);
  EXPECT_FALSE(line.contains("stiffness_to"));  // a free end
}

TEST_F(Cli, StaticDocumentTellsWhatLiesOnTheSeabed) {
  const std::string scene = std::string(HAWSER_SOURCE_DIR) + "/data/scenes/mooring-chain.toml";
  const Outcome outcome = hawser("static " + scene + " --json -q --set environment.seabed.friction=0.5");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const nlohmann::json line = outcome.json().at("lines").at("mooring"), bed = line.at("seabed");
  ASSERT_EQ(line.at("touchdown").size(), 1u);
  EXPECT_NEAR(line.at("touchdown")[0], bed.at("length"), 1e-9);  // the anchor lies on the bed
  EXPECT_NEAR(bed.at("touchdown_positions")[0][2], -320.0, 1e-9);
  EXPECT_GT(bed.at("force"), 0.0);
  EXPECT_NEAR(bed.at("penetration_max"), 698.094 / 1e5 + 0.0025, 1e-6);  // w/k and half of the toe
  EXPECT_LT(line.at("tension_from"), line.at("tension_min").get<double>() + 1.0);
  const Outcome text = hawser("static " + scene + " -q");
  EXPECT_NE(text.out.find("on the seabed"), std::string::npos) << text.out;
}

TEST_F(Cli, FrictionOfTheSeabedInMotionIsRefusedByName) {
  const std::string scene = std::string(HAWSER_SOURCE_DIR) + "/data/scenes/mooring-chain.toml";
  const Outcome outcome = hawser("run " + scene + " --out results --set environment.seabed.friction=0.5");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("friction of the seabed in motion is not built yet"), std::string::npos) << outcome.err;
  EXPECT_FALSE(exists("results"));
}

TEST_F(Cli, StationsAreEvenFromEndToEnd) {
  write("scene.toml", small_scene);
  const nlohmann::json document = hawser("static scene.toml --json --stations 5 --quiet").json();
  EXPECT_EQ(document.at("lines").at("a").at("stations").at("s"), nlohmann::json({0.0, 25.0, 50.0, 75.0, 100.0}));
  EXPECT_EQ(document.at("lines").at("a").at("stations").at("z").size(), 5U);
}

TEST_F(Cli, SetOverridesKeysOfTheScene) {
  write("scene.toml", small_scene);
  const nlohmann::json document = hawser("static scene.toml --json --set lines.a.sections.0.elements=20 --set points.end.mass=0").json();
  EXPECT_EQ(document.at("lines").at("a").at("elements"), 20);
  EXPECT_NEAR(document.at("lines").at("a").at("tension_to").get<double>(), 0.0, 1e-6);  // N; the line weighs 1.2 kN
}

TEST_F(Cli, StraightStartAndStoredStartReachTheSameEquilibrium) {
  write("scene.toml", with(small_scene, "[line_types", "current = [[0.0, 0.5, 30.0]]\n[line_types"));
  const double catenary = hawser("static scene.toml --json --out first").json().at("lines").at("a").at("tension_from");
  const nlohmann::json straight = hawser("static scene.toml --json --start straight").json();
  const nlohmann::json stored = hawser("static scene.toml --json --from first/result.h5").json();
  EXPECT_NEAR(straight.at("lines").at("a").at("tension_from").get<double>(), catenary, 1e-9 * catenary);
  EXPECT_NEAR(stored.at("lines").at("a").at("tension_from").get<double>(), catenary, 1e-9 * catenary);
  EXPECT_LE(stored.at("iterations"), 1);
  EXPECT_EQ(hawser("static scene.toml --from first/result.h5 --set lines.a.sections.0.elements=12").code, 2);
}

TEST_F(Cli, AShapeGivenForALineIsTheFirstGuessOfItsStatic) {
  const std::string scene = with(small_scene, "to = \"end\"", "to = \"end\"\nstart = { file = \"shape.csv\" }");
  write("scene.toml", small_scene);
  const double tension = hawser("static scene.toml --json").json().at("lines").at("a").at("tension_from");
  write("shape.csv", "s,x,y,z\n0,0,0,0\n40,25,5,-30\n100,40,10,-85\n");
  write("shaped.toml", scene);
  const Outcome shaped = hawser("static shaped.toml --json");
  EXPECT_NEAR(shaped.json().at("lines").at("a").at("tension_from").get<double>(), tension, 1e-9 * tension);
  EXPECT_GT(shaped.json().at("iterations"), hawser("static scene.toml --json").json().at("iterations"));  // a worse guess than the catenary
}

TEST_F(Cli, NoEquilibriumEndsWithCodeThreeAndLeavesNothingWhereResultsGo) {
  write("scene.toml", slack_scene);
  const Outcome outcome = hawser("static scene.toml --json --out results");
  EXPECT_EQ(outcome.code, 3);
  EXPECT_FALSE(outcome.json().at("converged").get<bool>());
  EXPECT_FALSE(outcome.json().at("failure").at("remedy").get<std::string>().empty());
  for (const char* word : {"where", "cause", "remedy"}) EXPECT_NE(outcome.err.find(word), std::string::npos) << word;
  EXPECT_FALSE(exists("results/result.h5"));
  EXPECT_TRUE(exists("results/failed/result.h5"));
  EXPECT_EQ(hawser("run scene.toml --out moved").code, 3);
  EXPECT_FALSE(exists("moved/series.csv"));
}

TEST_F(Cli, AStoppedIntegrationEndsWithCodeFourAndKeepsItsRowsApart) {
  // A thrust that overflows soon after 0.2 s.
  write("scene.toml", with(small_scene, "mass = 100.0",
                           "mass = 100.0\nthrust = { table = [[0.2, 0.0, 0.0, 0.0], [0.3, 1e300, 0.0, 0.0]], interpolation = \"linear\" }"));
  const Outcome outcome = hawser("run scene.toml --out results --json");
  EXPECT_EQ(outcome.code, 4);
  EXPECT_EQ(outcome.json().at("status"), "failed");
  EXPECT_NE(outcome.err.find("remedy"), std::string::npos);
  for (const char* name : {"series.csv", "result.h5", "summary.json"}) {
    EXPECT_FALSE(exists(std::string("results/") + name));
    EXPECT_TRUE(exists(std::string("results/failed/") + name));
  }
}

TEST_F(Cli, CheckPrintsWhatWasUnderstood) {
  write("scene.toml", small_scene);
  const Outcome text = hawser("check scene.toml");
  ASSERT_EQ(text.code, 0) << text.err;
  for (const char* part :
       {"line a: 100 m, 10 elements, cable (axial, weight, inertia, drag)", "66 unknowns", "20 steps", "from top (moved 0, 0, 0)"}) {
    EXPECT_NE(text.out.find(part), std::string::npos) << part << "\n" << text.out;
  }
  const nlohmann::json document = hawser("check scene.toml --json").json();
  EXPECT_EQ(document.at("unknowns"), 66);
  EXPECT_EQ(document.at("lines").at("a").at("sections").at(0).at("element_size"), 10.0);
  EXPECT_EQ(document.at("estimates").at("steps"), 20);
  EXPECT_GT(document.at("estimates").at("bytes"), 0.0);
}

// Each of the lines between hubs asks for six solutions an iteration beside the one with the residual.
TEST(CostEstimate, CountsTheSolutionsThatLinesMeetingAtFreePointsAskFor) {
  const Scene network = test::small_network(4, ModelChoice::beam);
  Model apart = build_model(network);
  const double together = estimate_cost(network, apart).static_seconds;
  for (Line& line : apart.lines) line.from_hub = line.to_hub = -1;
  EXPECT_GT(together, 1.3 * estimate_cost(network, apart).static_seconds);
}

TEST_F(Cli, CheckWarnsOfAStretchedLineAndOfUnusedBendingStiffness) {
  const std::string taut = with(with(small_scene, "free = true", "free = false"), "mass = 100.0", "");
  write("scene.toml", with(with(taut, "EA = 4.0e7", "EA = 4.0e7\nEI = 10.0"), "to = \"end\"", "to = \"end\"\nmodel = \"cable\""));
  const nlohmann::json warnings = hawser("check scene.toml --json --set points.end.position=[0,0,-101]").json().at("warnings");
  const std::string text = warnings.dump();
  EXPECT_NE(text.find("shorter than the distance"), std::string::npos) << text;
  EXPECT_NE(text.find("EI is not used"), std::string::npos) << text;
}

TEST_F(Cli, LinesThatMeetAreCheckedSolvedVariedAndRun) {
  const std::string other =
      "[points.other]\nposition = [40.0, 0.0, 0.0]\n[lines.b]\nfrom = \"end\"\nto = \"other\"\n"
      "sections = [{ type = \"rope\", length = 110.0, elements = 10 }]\n[dynamics]";
  write("scene.toml", with(small_scene, "[dynamics]", other));
  EXPECT_EQ(hawser("check scene.toml --json").json().at("meeting_points").at("end"), 2);
  EXPECT_NE(hawser("check scene.toml").out.find("2 line ends meet"), std::string::npos);
  const nlohmann::json document = hawser("static scene.toml --json --out first").json();
  EXPECT_NEAR(document.at("points").at("end").at("force").at(2), 100.0 * 9.80665, 1e-6);  // both lines carry the body
  EXPECT_EQ(document.at("lines").at("b").at("stiffness_to").size(), 3u);
  EXPECT_FALSE(document.at("lines").at("b").contains("stiffness_from"));
  EXPECT_EQ(hawser("static scene.toml --json --from first/result.h5").json().at("iterations"), 1);
  EXPECT_EQ(hawser("static scene.toml --vary points.other.position.0=30:60:4").code, 0);  // every value has its equilibrium
  EXPECT_EQ(hawser("run scene.toml --out results").code, 0);
}

/// Starts the program and waits until it has written some rows; returns its process.
pid_t start_long_run(const std::filesystem::path& folder) {
  const pid_t child = fork();
  if (child == 0) {
    if (chdir(folder.c_str()) != 0) _exit(99);
    execl(HAWSER_PROGRAM, "hawser", "run", "scene.toml", "--out", "results", "--quiet", static_cast<char*>(nullptr));
    _exit(99);
  }
  for (int tries = 0; tries < 3000; ++tries) {
    if (contents(folder / "results/running/series.csv").size() > 2000) return child;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return child;
}

TEST_F(Cli, AnInterruptedRunKeepsARightPartAndAStateToLookAt) {
  write("scene.toml", with(small_scene, "duration = 1.0", "duration = 1.0e5"));
  const pid_t child = start_long_run(folder_);
  ASSERT_EQ(kill(child, SIGINT), 0);
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 130);
  EXPECT_FALSE(exists("results/series.csv"));
  EXPECT_FALSE(exists("results/running"));
  const nlohmann::json summary = nlohmann::json::parse(contents(folder_ / "results/partial/summary.json"));
  EXPECT_EQ(summary.at("status"), "partial");
  EXPECT_GT(summary.at("time"), 0.0);
  EXPECT_EQ(contents(folder_ / "results/partial/series.csv").back(), '\n');
  EXPECT_EQ(hawser("static scene.toml --from results/partial/result.h5").code, 0);
}

}  // namespace
}  // namespace hawser::test
