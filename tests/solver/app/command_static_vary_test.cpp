// hawser static --vary: rows, files, refusals and exit codes.
#include <array>
#include <cmath>
#include <map>
#include <sstream>

#include "tests/solver/app/cli_program.hpp"

namespace hawser::test {
namespace {

using CliVary = ProgramTest;
using Row = std::map<std::string, double>;

std::vector<std::string> split(const std::string& text, char by) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, by);) parts.push_back(part);
  return parts;
}

/// CSV rows by column name; every row has every column.
std::vector<Row> rows_of(const std::string& csv) {
  const std::vector<std::string> lines = split(csv, '\n');
  std::vector<Row> rows;
  if (lines.empty()) return rows;
  const std::vector<std::string> names = split(lines[0], ',');
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const std::vector<std::string> cells = split(lines[i], ',');
    EXPECT_EQ(cells.size(), names.size()) << lines[i];
    Row& row = rows.emplace_back();
    for (std::size_t k = 0; k < std::min(names.size(), cells.size()); ++k) row[names[k]] = std::stod(cells[k]);
  }
  return rows;
}

const std::string in_current = with(small_scene, "[line_types", "current = [[0.0, 0.5, 30.0]]\n[line_types");

TEST_F(CliVary, CsvAndJsonHoldTheSameNumbers) {
  write("scene.toml", in_current);
  const std::string arguments = "static scene.toml --vary points.top.position.0=0:20:5";
  const Outcome csv = hawser(arguments), json = hawser(arguments + " --json");
  ASSERT_EQ(csv.code, 0) << csv.err;
  ASSERT_EQ(json.code, 0) << json.err;
  const std::vector<Row> rows = rows_of(csv.out);
  const nlohmann::json array = json.json();
  ASSERT_EQ(rows.size(), 5u);
  ASSERT_EQ(array.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i) {
    const nlohmann::json &item = array[i], &line = item.at("lines").at("a");
    const Row& row = rows[i];
    EXPECT_EQ(row.at("value"), 5.0 * static_cast<double>(i));
    EXPECT_EQ(item.at("set"), "points.top.position.0=" + std::to_string(5 * i));
    for (const char* key : {"value", "iterations", "residual"}) EXPECT_EQ(item.at(key).get<double>(), row.at(key)) << key;
    for (const char* key : {"converged", "stable", "warm"}) EXPECT_EQ(item.at(key).get<bool>(), row.at(key) == 1.0) << key;
    for (const char* key : {"tension_from", "tension_to", "tension_max", "tension_min", "curvature_max"})
      EXPECT_EQ(line.at(key).get<double>(), row.at(std::string("a.") + key)) << key;
    for (int axis = 0; axis < 3; ++axis) {
      const char letter = "xyz"[axis];
      for (const char* key : {"force_from", "force_to"}) EXPECT_EQ(line.at(key).at(axis), row.at(std::string("a.") + key + '_' + letter)) << key;
      for (const char* point : {"top", "end"}) {
        EXPECT_EQ(item.at("points").at(point).at("position").at(axis), row.at(std::string(point) + '.' + letter)) << point;
        EXPECT_EQ(item.at("points").at(point).at("force").at(axis), row.at(std::string(point) + ".force_" + letter)) << point;
      }
    }
  }
}

TEST_F(CliVary, EveryRowIsTheStaticOfItsOverride) {
  write("scene.toml", in_current);
  const nlohmann::json array = hawser("static scene.toml --vary 'points.end.mass=100 kg:300 kg:3' --json").json();
  ASSERT_EQ(array.size(), 3u);
  for (const nlohmann::json& item : array) {
    EXPECT_TRUE(item.at("converged").get<bool>());
    const nlohmann::json single = hawser("static scene.toml --json --set '" + item.at("set").get<std::string>() + "'").json();
    const double expected = single.at("lines").at("a").at("tension_from");
    EXPECT_NEAR(item.at("lines").at("a").at("tension_from").get<double>(), expected, 1e-9 * expected);  // ten times the Newton tolerance
  }
  EXPECT_EQ(array[1].at("set"), "points.end.mass=200 kg");
  EXPECT_EQ(array[1].at("value"), 200);
}

TEST_F(CliVary, TheMeshMayVary) {
  write("scene.toml", in_current);
  const Outcome outcome = hawser("static scene.toml --vary lines.a.sections.0.elements=10:30:3 --quiet");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  for (const Row& row : rows_of(outcome.out)) EXPECT_EQ(row.at("warm"), 0.0);
}

TEST_F(CliVary, BadArgumentsEndWithCodeTwoBeforeAnythingIsSolvedOrWritten) {
  write("scene.toml", small_scene);
  const std::vector<std::pair<std::string, std::string>> bad{{"points.top.position.0=0:20:1", "the number of values"},
                                                             {"points.top.position.0=0:20", "this has 2"},
                                                             {"points.tpo.position.0=0:20:3", "did you mean `top`?"},
                                                             {"points.top.positon.0=0:20:3", "did you mean `position`?"},
                                                             {"points.top.position.7=0:20:3", "use a number from 0 to 2"},
                                                             {"environment.water_densty=1000:1025:3", "did you mean `water_density`?"},
                                                             {"title=1:2:3", "must be a string"},
                                                             {"points.end.free=1:2:3", "must be true or false"},
                                                             {"lines.a.model=1:2:3", "this is a number"},
                                                             {"points.top.position=1:2:3", "must be a list of 3 numbers"},
                                                             {"'points.top.position.0=1 kg:2 kg:3'", "a unit of mass"},
                                                             {"line_types.rope.EA=1e6:-1e6:3", "at line_types.rope.EA=0"},
                                                             {"lines.a.sections.0.elements=10:15:3", "at lines.a.sections.0.elements=12.5"}};
  for (const auto& [argument, message] : bad) {
    const Outcome outcome = hawser("static scene.toml --out results --vary " + argument);
    EXPECT_EQ(outcome.code, 2) << argument;
    EXPECT_EQ(outcome.out, "") << argument;
    EXPECT_NE(outcome.err.find(message), std::string::npos) << argument << "\n" << outcome.err;
    EXPECT_NE(outcome.err.find("--vary "), std::string::npos) << argument << "\n" << outcome.err;
    EXPECT_FALSE(exists("results")) << argument;
  }
  EXPECT_EQ(hawser("static scene.toml --vary points.top.position.0=0:20:3 --stations 5").code, 2);
}

TEST_F(CliVary, AFailedValueIsARowThatSaysSoAndTheCurveGoesOn) {
  write("scene.toml", slack_scene);  // without gravity nothing loads it
  const std::string arguments = "static scene.toml --vary environment.gravity=0:10:3 --out results";
  const Outcome csv = hawser(arguments);
  EXPECT_EQ(csv.code, 5);
  const std::vector<Row> rows = rows_of(csv.out);
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0].at("converged"), 0.0);
  EXPECT_TRUE(std::isnan(rows[0].at("a.tension_from")));
  for (const std::size_t i : {1u, 2u}) {
    EXPECT_EQ(rows[i].at("converged"), 1.0);
    EXPECT_NEAR(rows[i].at("a.force_from_z"), -0.5 * 0.1 * rows[i].at("value") * 100.0, 1e-8);  // half of the weight (50 N), to the Newton tolerance
  }
  for (const char* word : {"environment.gravity=0: ", "cause", "remedy"}) EXPECT_NE(csv.err.find(word), std::string::npos) << word;
  EXPECT_EQ(contents(folder_ / "results/curve.csv"), csv.out);
  const nlohmann::json array = nlohmann::json::parse(contents(folder_ / "results/curve.json"));
  EXPECT_TRUE(array[0].at("lines").empty());
  EXPECT_FALSE(array[0].at("failure").at("what").get<std::string>().empty());
  EXPECT_FALSE(array[1].contains("failure"));
  EXPECT_TRUE(exists("results/plots/curve.gp"));
  EXPECT_FALSE(exists("results/running"));
}

TEST_F(CliVary, ACurveOfFailuresEndsWithCodeThreeAndLeavesNothingWhereResultsGo) {
  write("scene.toml", slack_scene);
  const Outcome outcome = hawser("static scene.toml --vary lines.a.sections.0.length=100:110:3 --out results");
  EXPECT_EQ(outcome.code, 3);
  EXPECT_EQ(rows_of(outcome.out).size(), 3u);
  EXPECT_FALSE(exists("results/curve.csv"));
  EXPECT_EQ(contents(folder_ / "results/failed/curve.csv"), outcome.out);
}

TEST_F(CliVary, TouchdownIsAColumnWithASeabed) {
  const std::string scene = std::string(HAWSER_SOURCE_DIR) + "/data/scenes/mooring-chain.toml";
  const Outcome csv = hawser("static " + scene + " --vary points.fairlead.position.0=835:850:4 -q");
  const nlohmann::json array = hawser("static " + scene + " --vary points.fairlead.position.0=835:850:4 -q --json").json();
  ASSERT_EQ(csv.code, 0) << csv.err;
  const std::vector<Row> rows = rows_of(csv.out);
  ASSERT_EQ(rows.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(rows[i].at("mooring.touchdown"), array[i].at("lines").at("mooring").at("touchdown").at(0));
    if (i == 0) continue;
    EXPECT_LT(rows[i].at("mooring.touchdown"), rows[i - 1].at("mooring.touchdown"));  // pulled off the bed
    EXPECT_GT(rows[i].at("mooring.tension_to"), rows[i - 1].at("mooring.tension_to"));
  }
}

TEST_F(CliVary, AStoredStateStartsTheFirstValue) {
  write("scene.toml", in_current);
  ASSERT_EQ(hawser("static scene.toml --out first").code, 0);
  const Outcome outcome = hawser("static scene.toml --from first/result.h5 --vary points.top.position.0=0:20:5");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_LE(rows_of(outcome.out)[0].at("iterations"), 1.0);
}

/// A pipe in an arch on a level bed, pushed through by a force across it (tests/solver/model_branch_test.cpp).
const std::string arch_scene = R"([environment]
water_density = 0.0
depth = 20.0
[environment.seabed]
stiffness = 1.0e3
[line_types.pipe]
diameter = 0.04
mass = 2.5
wet_weight = 10.0
EA = 3.84e5
EI = 100.0
[points.a]
position = [0.0, 0.0, -20.01]
[points.b]
position = [9.9958337, 0.0, -20.01]
[lines.pipe]
from = "a"
to = "b"
sections = [ { type = "pipe", length = 10.0, elements = 32 } ]
loads = [ { at = 5.0, force = [0.0, -0.1, 0.0] } ]
from_end = { clamped = [0.99875, 0.04998, 0.0] }
to_end = { clamped = [0.99875, -0.04998, 0.0] }
)";

TEST_F(CliVary, FoldsArePassedOnOneBranchAndTheirRowsAreMarked) {
  write("scene.toml", arch_scene);
  const std::string arguments = "static scene.toml --vary lines.pipe.loads.0.force.1=-0.6:-3:7 --out results";
  const Outcome outcome = hawser(arguments);
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  std::vector<double> values, folds, unstable;
  int asked = 0;
  const std::vector<Row> rows = rows_of(outcome.out);
  for (const Row& row : rows) {
    EXPECT_EQ(row.at("converged"), 1.0);
    EXPECT_EQ(row.at("branch"), 1.0);
    EXPECT_EQ(row.at("stable") == 1.0, row.at("fold") == 0.0 && row.at("negative_pivots") == 0.0);
    if (row.at("fold") == 1.0) {
      folds.push_back(row.at("value"));
    } else {
      (row.at("stable") == 1.0 ? values : unstable).push_back(row.at("value"));
      const double steps = (row.at("value") + 0.6) / -0.4;
      EXPECT_NEAR(steps, std::round(steps), 1e-9);  // at the values asked for
      if (row.at("stable") == 1.0) ++asked;
    }
  }
  // Shallow theory: -2.206 and -1.748; the curve is measured elsewhere, here it matters which values lie between the folds.
  ASSERT_EQ(folds.size(), 2u);
  EXPECT_NEAR(folds[0], -2.206, 0.01);
  EXPECT_NEAR(folds[1], -1.748, 0.01);
  EXPECT_EQ(unstable.size(), 2u);  // -2.2 and -1.8
  EXPECT_EQ(asked, 7 + 2);         // and there a second stable state, after the snap

  const nlohmann::json array = nlohmann::json::parse(contents(folder_ / "results/curve.json"));
  ASSERT_EQ(array.size(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(array[i].at("value"), rows[i].at("value"));
    for (const char* key : {"fold", "stable"}) EXPECT_EQ(array[i].at(key).get<bool>(), rows[i].at(key) == 1.0) << key;
    for (const char* key : {"branch", "negative_pivots"}) EXPECT_EQ(array[i].at(key), rows[i].at(key)) << key;
    EXPECT_EQ(array[i].at("lines").at("pipe").at("tension_from"), rows[i].at("pipe.tension_from"));
  }
  EXPECT_NE(outcome.err.find("the branch folds"), std::string::npos);
  EXPECT_NE(contents(folder_ / "results/plots/curve.gp").find("unstable"), std::string::npos);
}

/// A pinned strut 10 m long, to be pushed together (tests/solver/curve_bifurcation_test.cpp).
const std::string strut_scene = R"([environment]
water_density = 0.0
[line_types.rod]
diameter = 0.04
mass = 1.0
wet_weight = 1e-3
EA = 1e6
EI = 1000.0
[points.foot]
position = [0.0, 0.0, 0.0]
[points.top]
position = [0.0, 0.0, 10.0]
[lines.strut]
from = "foot"
to = "top"
sections = [ { type = "rod", length = 10.0, elements = 16 } ]
)";

TEST_F(CliVary, ABifurcationIsARowAndTheBranchIsLeftForTheStableOne) {
  write("scene.toml", strut_scene);
  const Outcome outcome = hawser("static scene.toml --start straight --vary points.top.position.2=9.9998:9.9982:5 --out results");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const std::vector<Row> rows = rows_of(outcome.out);
  // Straight at 9.9998 and 9.9994, it buckles at 9.999013 (P (1 - P/EA) = pi^2 EI/L^2), is unstable there and, straight, at 9.9990, then bowed.
  const std::vector<std::array<double, 4>> expected{{9.9998, 1, 1, 0}, {9.9994, 1, 1, 0}, {9.999012942, 1, 0, 1}, {9.9990, 1, 0, 0},
                                                    {9.9990, 2, 1, 0}, {9.9986, 2, 1, 0}, {9.9982, 2, 1, 0}};
  ASSERT_EQ(rows.size(), expected.size());
  const nlohmann::json array = nlohmann::json::parse(contents(folder_ / "results/curve.json"));
  ASSERT_EQ(array.size(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto& [value, branch, stable, bifurcation] = expected[i];
    EXPECT_NEAR(rows[i].at("value"), value, 2e-9) << i;  // the mesh makes 2e-6 of 9.9e-4 m
    EXPECT_EQ(rows[i].at("branch"), branch) << i;
    EXPECT_EQ(rows[i].at("stable"), stable) << i;
    EXPECT_EQ(rows[i].at("bifurcation"), bifurcation) << i;
    EXPECT_EQ(rows[i].at("fold"), 0.0) << i;
    if (bifurcation == 0.0) {
      EXPECT_EQ(rows[i].at("negative_pivots") > 0.0, stable == 0.0) << i;
    }
    EXPECT_EQ(array[i].at("bifurcation").get<bool>(), bifurcation == 1.0) << i;
    EXPECT_EQ(array[i].at("stable").get<bool>(), stable == 1.0) << i;
  }
  EXPECT_NE(outcome.err.find("another branch crosses"), std::string::npos);
}

}  // namespace
}  // namespace hawser::test
