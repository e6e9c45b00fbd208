// Work and precision: error against time, against element length and against step. Each point is one run.
//
//   hawser_work_precision FOLDER        writes FOLDER/*.csv, prints the fitted slopes as a table
//
// Errors are measured against
//   catenary-5000     the closed form (data/reference/static_catenary_deep5000_sceneS1.json): the largest distance over the nodes [m], the
//                     tension at the top [N]
//   swinging-bob      data/reference/dynamic_S3b_swinging_bob.json: the distance of the bob at 10 s [m]
//   umbilical-heave   our own run of 400 cable elements at a step of 0.003125 s: the largest and the rms difference of the top tension
//                     over the outputs from 60 to 120 s [N]
// Slopes in the element length are measured at one step against the finest mesh at that step, slopes in the step on one
// mesh against the smallest step on that mesh, so that neither error hides the other; Newton's tolerance is 1e-11 there.
// Time is processor time of the whole solution: reading, meshing, statics, dynamics, histories; one thread, no files.
#include <fmt/os.h>

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>

#include "bench/scenes.hpp"

namespace {

using namespace hawser;
using namespace hawser::bench;
namespace fs = std::filesystem;

constexpr double settled = 60.0;  // s: from here on histories are compared

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Least time of a few runs, so that short runs are not lost in noise.
double least_seconds(const std::function<void()>& run) {
  double least = HUGE_VAL, spent = 0.0;
  for (int i = 0; i < 20 && (i < 3 || spent < 0.1) && spent < 1.0; ++i) {
    const double start = processor_seconds();
    run();
    const double seconds = processor_seconds() - start;
    least = std::min(least, seconds);
    spent += seconds;
  }
  return least;
}

nlohmann::json reference(const std::string& name) {
  std::ifstream file(std::string(HAWSER_SOURCE_DIR) + "/data/reference/" + name + ".json");
  nlohmann::json document;
  file >> document;
  nlohmann::json values;
  for (const auto& quantity : document.at("quantities")) values[quantity.at("name").get<std::string>()] = quantity.at("value");
  return values;
}

std::vector<std::string> overrides_of(const std::string& line, const std::string& family, int elements) {
  return {"lines." + line + ".sections.0.elements=" + std::to_string(elements), "lines." + line + ".model=" + family};
}

const std::string tight = "solve.newton_tolerance=1e-11";

// ---- the slopes ----

struct ErrorAt {
  double size, error;  // element length or step; error
};

/// Least squares of log(error) on log(size).
double slope(const std::vector<ErrorAt>& points) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const ErrorAt& p : points) {
    const double a = std::log(p.size), b = std::log(p.error);
    n += 1, x += a, y += b, xx += a * a, xy += a * b;
  }
  return (n * xy - x * y) / (n * xx - x * x);
}

class Convergence {
 public:
  explicit Convergence(const fs::path& file) : out_(fmt::output_file(file.string())) { out_.print("series,size,error\n"); }

  /// Points from coarse to fine; those of [from, to] in size are fitted.
  void add(const std::string& series, const std::vector<ErrorAt>& points, double from, double to) {
    std::vector<ErrorAt> fitted;
    for (const ErrorAt& p : points) {
      out_.print("{},{:.6g},{:.6e}\n", series, p.size, p.error);
      if (p.size >= from * 0.999 && p.size <= to * 1.001) fitted.push_back(p);
    }
    fmt::print("| {} | {:.4g} to {:.4g} | {:.2f} |\n", series, to, from, slope(fitted));
    std::fflush(stdout);
  }

 private:
  fmt::ostream out_;
};

// ---- catenary-5000 ----

/// Irvine's elastic catenary through its known end force (H, V) at s = 0.
Vec3 catenary_position(double H, double V, double s) {
  constexpr double EA = 4.0e7;
  const double w = (2.5 - 1025.0 * 3.14159265358979323846 * 0.04 * 0.04 / 4.0) * 9.80665, up = V + w * s;
  const double x = H * s / EA + H / w * (std::asinh(up / H) - std::asinh(V / H));
  const double z = (V + 0.5 * w * s) * s / EA + (std::hypot(H, up) - std::hypot(H, V)) / w;
  return {x, 0.0, z - 3000.0};
}

struct StaticError {
  double position, tension;
};

StaticError catenary_error(const StaticRun& run) {
  static const nlohmann::json known = reference("static_catenary_deep5000_sceneS1");
  const double H = known.at("H"), V = known.at("V_end_s0 (vertical tension component, up the line positive)"), top = known.at("T_end_sL0");
  StaticError error{0.0, std::abs(observe_line(run.model, run.state, 0).tension_to - top)};
  for (const Station& station : observe_nodes(run.model, run.state, 0))
    error.position = std::max(error.position, (station.position - catenary_position(H, V, station.s)).norm());
  return error;
}

void catenary(const fs::path& folder, Convergence& space) {
  auto out = fmt::output_file((folder / "catenary.csv").string());
  out.print("family,elements,seconds,position_error,tension_error\n");
  for (const std::string family : {"bar", "cable"}) {
    std::vector<ErrorAt> position, tension;
    for (int elements = 10; elements <= 5120; elements *= 2) {
      StaticRun run;
      const double seconds = least_seconds([&] { run = run_static(scene_of("catenary-5000", overrides_of("tether", family, elements))); });
      if (!run.report.converged) continue;
      const StaticError error = catenary_error(run);
      out.print("{},{},{:.4e},{:.4e},{:.4e}\n", family, elements, seconds, error.position, error.tension);
      position.push_back({5000.0 / elements, error.position});
      tension.push_back({5000.0 / elements, error.tension});
    }
    const bool bar = family == "bar";
    space.add("catenary-5000 position " + family, position, 5000.0 / (bar ? 5120 : 1280), 5000.0 / 20);
    space.add("catenary-5000 tension " + family, tension, 5000.0 / (bar ? 5120 : 160), 5000.0 / 20);
  }
}

/// The same line as a beam with EI = 1e8 N m2 (boundary layers of 90 m), against its own mesh of 5120 elements.
void stiff_catenary(Convergence& space) {
  const auto solve = [](int elements) {
    std::vector<std::string> overrides = overrides_of("tether", "beam", elements);
    overrides.push_back("line_types.U40.EI=1e8");
    return run_static(scene_of("catenary-5000", overrides));
  };
  const StaticRun fine = solve(5120);
  const std::vector<Station> exact = observe_nodes(fine.model, fine.state, 0);
  std::vector<ErrorAt> position;
  for (int elements = 10; elements <= 1280; elements *= 2) {
    const StaticRun run = solve(elements);
    const std::vector<Station> nodes = observe_nodes(run.model, run.state, 0);
    double error = 0.0;
    for (int i = 0; i <= elements; ++i) error = std::max(error, (nodes[i].position - exact[5120 / elements * i].position).norm());
    position.push_back({5000.0 / elements, error});
  }
  space.add("catenary-5000 position beam", position, 5000.0 / 1280, 5000.0 / 80);
}

// ---- swinging-bob ----

DynamicRun bob_run(const std::string& family, int elements, double step, const std::vector<std::string>& more = {}) {
  std::vector<std::string> overrides = overrides_of("rope", family, elements);
  overrides.insert(overrides.end(), {"dynamics.duration=10.0", "dynamics.output_interval=1.0", fmt::format("dynamics.step={}", step)});
  overrides.insert(overrides.end(), more.begin(), more.end());
  return run_dynamic(scene_of("swinging-bob", overrides));
}

void bob(const fs::path& folder) {
  const nlohmann::json known = reference("dynamic_S3b_swinging_bob");
  const Vec3 exact(known.at("tip x").at(9), 0.0, known.at("tip z").at(9));
  auto out = fmt::output_file((folder / "bob.csv").string());
  out.print("family,elements,step,seconds,position_error\n");
  for (const std::string family : {"bar", "cable", "beam"})
    for (int elements = 8; elements <= 128; elements *= 2)
      for (double step = 0.04; step > 0.001; step *= 0.5) {
        DynamicRun run;
        const double seconds = least_seconds([&] { run = bob_run(family, elements, step); });
        if (run.finished) out.print("{},{},{},{:.4e},{:.4e}\n", family, elements, step, seconds, (run.history.back().to - exact).norm());
      }
}

/// The beam is stiffer than in the scene, EI = 12 kN m2: its boundary layers of 2 m are then resolved by the meshes shown.
void bob_slopes(Convergence& space, Convergence& time) {
  const auto place = [](const std::string& family, int elements, double step, const char* EI) {
    return bob_run(family, elements, step, {tight, std::string("line_types.rope.EI=") + EI}).history.back().to;
  };
  for (const std::string family : {"bar", "cable", "beam"}) {
    const char* EI = family == "beam" ? "12000.0" : "120.0";
    const Vec3 fine = place(family, 1024, 0.01, EI);
    std::vector<ErrorAt> points;
    for (int elements = 8; elements <= 256; elements *= 2) points.push_back({100.0 / elements, (place(family, elements, 0.01, EI) - fine).norm()});
    space.add("swinging-bob position " + family, points, 100.0 / 256, 100.0 / 16);
  }
  const Vec3 fine = place("beam", 64, 0.0003125, "120.0");
  std::vector<ErrorAt> points;
  for (double step = 0.04; step > 0.001; step *= 0.5) points.push_back({step, (place("beam", 64, step, "120.0") - fine).norm()});
  time.add("swinging-bob position", points, 0.00125, 0.04);
}

// ---- umbilical-heave ----

struct HistoryError {
  double largest = 0.0, rms = 0.0;  // N
};

using History = std::vector<double>;

/// Top tension at the outputs from `settled` on; empty where the run stopped.
History top_tension(const DynamicRun& run) {
  History tension;
  if (!run.finished) return tension;
  for (const Row& row : run.history)
    if (row.time > settled - 1e-6) tension.push_back(row.tension_from);
  return tension;
}

HistoryError difference(const History& a, const History& b) {
  HistoryError error;
  for (std::size_t i = 0; i < b.size(); ++i) {
    const double d = std::abs(a.at(i) - b[i]);
    error.largest = std::max(error.largest, d);
    error.rms += d * d / static_cast<double>(b.size());
  }
  error.rms = std::sqrt(error.rms);
  return error;
}

DynamicRun umbilical_run(const std::string& family, int elements, double step, const std::vector<std::string>& more = {}) {
  std::vector<std::string> overrides = overrides_of("umbilical", family, elements);
  overrides.insert(overrides.end(), {"dynamics.output_interval=0.2", fmt::format("dynamics.step={}", step)});
  overrides.insert(overrides.end(), more.begin(), more.end());
  return run_dynamic(scene_of("umbilical-heave", overrides));
}

void umbilical(const fs::path& folder) {
  const History exact = top_tension(umbilical_run("cable", 400, 0.003125));
  auto out = fmt::output_file((folder / "umbilical.csv").string());
  out.print("family,elements,step,seconds,largest_error,rms_error\n");
  for (const std::string family : {"bar", "cable"})
    for (int elements = 25; elements <= 400; elements *= 2)
      for (double step = 0.2; step > 0.01; step *= 0.5) {
        DynamicRun run;
        const double seconds = least_seconds([&] { run = umbilical_run(family, elements, step); });
        if (!run.finished) continue;
        const HistoryError error = difference(top_tension(run), exact);
        out.print("{},{},{},{:.4e},{:.4e},{:.4e}\n", family, elements, step, seconds, error.largest, error.rms);
      }
}

void umbilical_slopes(Convergence& space, Convergence& time) {
  const auto tension = [](const std::string& family, int elements, double step) {
    return top_tension(umbilical_run(family, elements, step, {tight}));
  };
  for (const std::string family : {"bar", "cable"}) {
    const History fine = tension(family, 1280, 0.1);
    std::vector<ErrorAt> points;
    for (int elements = 10; elements <= 640; elements *= 2)
      points.push_back({4000.0 / elements, difference(tension(family, elements, 0.1), fine).largest});
    space.add("umbilical-heave tension " + family, points, 4000.0 / 640, 4000.0 / 80);
  }
  const History fine = tension("cable", 50, 0.00078125);
  std::vector<ErrorAt> largest, rms;
  for (double step = 0.2; step > 0.003; step *= 0.5) {
    const HistoryError error = difference(tension("cable", 50, step), fine);
    largest.push_back({step, error.largest});
    rms.push_back({step, error.rms});
  }
  time.add("umbilical-heave tension largest", largest, 0.003125, 0.2);
  time.add("umbilical-heave tension rms", rms, 0.003125, 0.2);
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) {
    fmt::print(stderr, "usage: hawser_work_precision FOLDER\n");
    return 2;
  }
  const fs::path folder = arguments[1];
  fs::create_directories(folder);
  fmt::print("| series | sizes fitted | slope |\n|---|---|---|\n");
  Convergence space(folder / "convergence_space.csv"), time(folder / "convergence_time.csv");
  catenary(folder, space);
  stiff_catenary(space);
  bob_slopes(space, time);
  umbilical_slopes(space, time);
  bob(folder);
  umbilical(folder);
  return 0;
}
