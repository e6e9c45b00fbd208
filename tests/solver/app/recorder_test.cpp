// What a run leaves in its folder.
#include <algorithm>
#include <sstream>
#include <vector>

#include "assembly/observables.hpp"
#include "solver/app/recorder.hpp"
#include "solver/app/recorder_folder.hpp"
#include "solver/app/text.hpp"
#include "tests/solver/app/cli_program.hpp"

namespace hawser::test {
namespace {

struct Series {
  std::vector<std::string> header;
  std::vector<std::vector<double>> rows;

  double value(std::size_t row, const std::string& column) const {
    const auto found = std::find(header.begin(), header.end(), column);
    if (found == header.end()) throw std::runtime_error("no column " + column);
    return rows.at(row).at(static_cast<std::size_t>(found - header.begin()));
  }
};

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
  return cells;
}

Series read_series(const std::filesystem::path& path) {
  Series series;
  std::istringstream in(contents(path));
  std::string line;
  std::getline(in, line);
  series.header = split(line);
  while (std::getline(in, line)) {
    std::vector<double>& row = series.rows.emplace_back();
    for (const std::string& cell : split(line)) row.push_back(std::stod(cell));
  }
  return series;
}

using RecordedRun = ProgramTest;

TEST_F(RecordedRun, SeriesHasTheColumnsOfTheContractAndARowAnOutputInstant) {
  write("scene.toml", small_scene);
  ASSERT_EQ(hawser("run scene.toml --out results").code, 0);
  const Series series = read_series(folder_ / "results/series.csv");
  const std::vector<std::string> header{"time",
                                        "a.tension_from",
                                        "a.tension_to",
                                        "a.tension_max",
                                        "a.tension_min",
                                        "a.curvature_max",
                                        "a.curvature_max_s",
                                        "a.x@50.0",
                                        "a.y@50.0",
                                        "a.z@50.0",
                                        "a.tension@50.0",
                                        "a.curvature@50.0",
                                        "a.x@93.1",
                                        "a.y@93.1",
                                        "a.z@93.1",
                                        "a.tension@93.1",
                                        "a.curvature@93.1",
                                        "top.x",
                                        "top.y",
                                        "top.z",
                                        "end.x",
                                        "end.y",
                                        "end.z"};
  EXPECT_EQ(series.header, header);
  ASSERT_EQ(series.rows.size(), 11U);
  for (std::size_t row = 0; row < series.rows.size(); ++row) {
    const double time = 0.1 * static_cast<double>(row), ramp = std::min(time, 1.0);
    EXPECT_EQ(series.rows[row].size(), header.size());
    EXPECT_NEAR(series.value(row, "time"), time, 1e-12);
    // The prescribed motion r(t) 0.5 sin(pi t); rounding of sums of steps only.
    EXPECT_NEAR(series.value(row, "top.z"), ramp * 0.5 * std::sin(3.14159265358979324 * time), 1e-12);
    EXPECT_LE(series.value(row, "a.tension_min"), series.value(row, "a.tension@50.0"));
  }
}

TEST_F(RecordedRun, ClampedEndsAddTheirMoment) {
  const std::string clamped =
      with(with(small_scene, "EA = 4.0e7", "EA = 4.0e7\nEI = 1000.0"), "to = \"end\"", "to = \"end\"\nfrom_end = { clamped = [1, 0, -1] }");
  write("scene.toml", clamped);
  ASSERT_EQ(hawser("run scene.toml --out results").code, 0);
  const Series series = read_series(folder_ / "results/series.csv");
  EXPECT_GT(series.value(0, "a.moment_from"), 0.0);
  EXPECT_THROW(series.value(0, "a.moment_to"), std::runtime_error);
}

TEST_F(RecordedRun, ASeabedAddsTheFirstTouchdown) {
  const std::string scene = std::string(HAWSER_SOURCE_DIR) + "/data/scenes/mooring-chain.toml";
  ASSERT_EQ(hawser("run " + scene + " -q --out results --set dynamics.duration=1.0").code, 0);
  const Series series = read_series(folder_ / "results/series.csv");
  EXPECT_NEAR(series.value(0, "mooring.touchdown"), 138.2, 0.1);
}

TEST_F(RecordedRun, SummaryCountsAndPicturesAndScriptsAreThere) {
  write("scene.toml", small_scene);
  const Outcome outcome = hawser("run scene.toml --json");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const nlohmann::json summary = nlohmann::json::parse(contents(folder_ / "scene.out/summary.json"));
  EXPECT_EQ(summary, outcome.json());
  EXPECT_EQ(summary.at("status"), "finished");
  EXPECT_EQ(summary.at("steps"), 20);
  EXPECT_EQ(summary.at("rejected_steps"), 0);
  EXPECT_NEAR(summary.at("time").get<double>(), 1.0, 1e-12);
  EXPECT_GE(summary.at("newton_iterations").get<int>(), 20);
  EXPECT_GT(summary.at("factorizations").get<int>(), 0);
  EXPECT_GE(summary.at("wall_seconds").at("total").get<double>(), summary.at("wall_seconds").at("dynamic").get<double>());
  EXPECT_TRUE(summary.at("error_estimates").at("static_tension").contains("a"));
  for (const char* name : {"plots/profile.gp", "plots/shapes.dat", "plots/tension.gp", "plots/tension_history.gp", "result.h5"}) {
    EXPECT_TRUE(exists(std::string("scene.out/") + name)) << name;
  }
  EXPECT_FALSE(exists("scene.out/running"));
}

TEST_F(RecordedRun, WithoutGnuplotTheRunFinishesAndSaysSo) {
  write("scene.toml", small_scene);
  const Outcome outcome = hawser("run scene.toml --out results", "env PATH=/nowhere");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_NE(outcome.err.find("gnuplot cannot be started"), std::string::npos) << outcome.err;
  EXPECT_TRUE(exists("results/series.csv"));
  EXPECT_FALSE(exists("results/profile.png"));
}

TEST_F(RecordedRun, ResultFileGivesBackTheLastStateOnTheSameMeshOnly) {
  write("scene.toml", small_scene);
  ASSERT_EQ(hawser("run scene.toml --out results").code, 0);
  const Model model = build_model(read(small_scene));
  const State last = read_last_state(folder_ / "results/result.h5", model);
  const Series series = read_series(folder_ / "results/series.csv");
  EXPECT_NEAR(last.t, 1.0, 1e-12);
  ASSERT_EQ(last.q.size(), model.unknowns);
  const std::vector<PointResult> points = observe_points(model, last);
  EXPECT_EQ(points[1].position.z(), series.value(series.rows.size() - 1, "end.z"));
  const Model finer = build_model(read(with(small_scene, "elements = 10", "elements = 12")));
  EXPECT_THROW(read_last_state(folder_ / "results/result.h5", finer), InputError);
}

TEST_F(RecordedRun, ThreadsDoNotChangeABit) {
  write("scene.toml", small_scene);
  ASSERT_EQ(hawser("run scene.toml --out one --threads 1 --set lines.a.sections.0.elements=600").code, 0);
  ASSERT_EQ(hawser("run scene.toml --out two --threads 2 --set lines.a.sections.0.elements=600", "env OMP_NUM_THREADS=2").code, 0);
  EXPECT_EQ(contents(folder_ / "one/series.csv"), contents(folder_ / "two/series.csv"));
}

TEST_F(RecordedRun, ASecondRunReplacesTheFirstAndAFailedOneLeavesItAlone) {
  write("scene.toml", small_scene);
  ASSERT_EQ(hawser("run scene.toml --out results").code, 0);
  const std::string first = contents(folder_ / "results/series.csv");
  write("slack.toml", slack_scene);
  ASSERT_EQ(hawser("run slack.toml --out results").code, 3);
  EXPECT_EQ(contents(folder_ / "results/series.csv"), first);
  ASSERT_EQ(hawser("run scene.toml --out results --set points.end.mass=200").code, 0);
  EXPECT_NE(contents(folder_ / "results/series.csv"), first);
  EXPECT_FALSE(exists("results/failed"));
}

TEST_F(RecordedRun, FieldsAreTakenAtTheirIntervalAndAtTheEnd) {
  const Scene scene = read(with(small_scene, "fields_interval = 0.5", "fields_interval = 0.4"));
  const Model model = build_model(scene);
  State state = model.make_state();
  for (std::size_t i = 5; i < model.unknowns; i += 6) state.q[i] = -1.0;  // r' = (0, 0, -1), r = 0
  Recorder recorder(scene, model, {}, folder_);
  for (int i = 0; i <= 10; ++i) {
    state.t = 0.1 * i;
    recorder.record(state);
  }
  recorder.finish(state);
  std::vector<double> times;
  for (const Shape& shape : recorder.shapes()) times.push_back(shape.time);
  ASSERT_EQ(times.size(), 4U);  // 0, 0.4, 0.8 and the last instant
  EXPECT_NEAR(times[2], 0.8, 1e-12);
  EXPECT_NEAR(times[3], 1.0, 1e-12);
  EXPECT_EQ(recorder.ranges()[0].count, 11);
}

TEST(TensionRange, KeepsLeastMeanAndGreatestAtBothEndsOfEveryElement) {
  Line line{};
  line.elements = 2;
  line.s = {0.0, 1.0, 3.0};
  LineResult result;
  result.tension_right = {10.0, 30.0, 0.0};
  result.tension_left = {0.0, 20.0, 40.0};
  TensionRange range;
  range.add(line, result);
  result.tension_right = {12.0, 30.0, 0.0};
  range.add(line, result);
  EXPECT_EQ(range.s, (std::vector<double>{0.0, 1.0, 1.0, 3.0}));
  EXPECT_EQ(range.low, (std::vector<double>{10.0, 20.0, 30.0, 40.0}));
  EXPECT_EQ(range.mean(), (std::vector<double>{11.0, 20.0, 30.0, 40.0}));
  EXPECT_EQ(range.high, (std::vector<double>{12.0, 20.0, 30.0, 40.0}));
}

TEST(DecimalText, ReadsBackExactlyAndAlwaysShowsADecimal) {
  EXPECT_EQ(decimal_text(50.0), "50.0");
  EXPECT_EQ(decimal_text(93.1), "93.1");
  EXPECT_EQ(decimal_text(-2.0), "-2.0");
  EXPECT_EQ(std::stod(decimal_text(1.0 / 3.0)), 1.0 / 3.0);
}

}  // namespace
}  // namespace hawser::test
