// What `hawser run` costs as a whole process: reading, statics, dynamics, histories every 0.1 s and fields every 5 s in files.
//
//   hawser_bench --benchmark_filter=run
//
// Time is user and system time of the child on one thread, the mean over the repeats; processor_seconds and wall_seconds are
// the least. Pictures are left out: the child finds no gnuplot in its PATH and writes the scripts and data for it alone.
#include <benchmark/benchmark.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

struct Child {
  int status = -1;
  double processor_seconds = 0.0, wall_seconds = 0.0;
};

Child run_child(std::vector<std::string> arguments) {
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  std::string path = "PATH=/nonexistent", simd;
  std::vector<char*> environment = {path.data()};
  if (const char* forced = std::getenv("HAWSER_SIMD")) simd = std::string("HAWSER_SIMD=") + forced, environment.push_back(simd.data());
  environment.push_back(nullptr);
  const auto start = std::chrono::steady_clock::now();
  pid_t pid = 0;
  if (posix_spawn(&pid, argv[0], nullptr, nullptr, argv.data(), environment.data()) != 0) return {};
  Child child;
  rusage used{};
  wait4(pid, &child.status, 0, &used);
  const auto seconds = [](const timeval& t) { return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec); };
  child.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  child.processor_seconds = seconds(used.ru_utime) + seconds(used.ru_stime);
  return child;
}

void whole_run(benchmark::State& state, const std::string& scene, const std::vector<std::string>& overrides) {
  const fs::path folder = fs::temp_directory_path() / ("hawser_bench-" + std::to_string(getpid()));
  std::vector<std::string> arguments = {
      HAWSER_PROGRAM,           "run", std::string(HAWSER_SOURCE_DIR) + "/data/scenes/" + scene + ".toml", "--quiet", "--threads", "1", "--out",
      (folder / scene).string()};
  for (const std::string& pair : overrides) arguments.insert(arguments.end(), {"--set", pair});
  double processor = HUGE_VAL, wall = HUGE_VAL;
  for (auto _ : state) {
    fs::create_directories(folder);
    const Child child = run_child(arguments);
    if (child.status != 0) return state.SkipWithError("hawser run failed");
    state.SetIterationTime(child.processor_seconds);
    processor = std::min(processor, child.processor_seconds);
    wall = std::min(wall, child.wall_seconds);
  }
  const nlohmann::json summary = nlohmann::json::parse(std::ifstream(folder / scene / "summary.json"));
  fs::remove_all(folder);
  state.counters["processor_seconds"] = processor;
  state.counters["wall_seconds"] = wall;
  for (const char* count : {"elements", "steps", "newton_iterations", "factorizations"}) state.counters[count] = summary.at(count).get<double>();
}

const bool registered = [] {
  const auto add = [](const std::string& name, const std::string& scene, const std::vector<std::string>& overrides) {
    benchmark::RegisterBenchmark(("run/" + name).c_str(), whole_run, scene, overrides)->UseManualTime()->Iterations(5)->Unit(benchmark::kMillisecond);
  };
  add("umbilical-heave/200", "umbilical-heave", {});
  add("umbilical-heave/1000", "umbilical-heave", {"lines.umbilical.sections.0.elements=1000"});
  add("lazy-wave-960/960", "lazy-wave-960", {});
  return true;
}();

}  // namespace
