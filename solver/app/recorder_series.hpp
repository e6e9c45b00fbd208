// series.csv: one row an output instant, shortest decimals that read back as the same double (columns: README.md).
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "assembly/observables.hpp"
#include "assembly/seabed.hpp"

namespace hawser {

/// Everything a row holds, computed once.
struct Observation {
  double time = 0.0;                           // s
  std::vector<LineResult> lines;               // as Model::lines
  std::vector<SeabedContact> seabed;           // as Model::lines
  std::vector<std::vector<Station>> stations;  // as Model::lines, in the order asked for
  std::vector<PointResult> points;             // as Model::points
};

struct ClampedEnds {
  bool from = false, to = false;
};
ClampedEnds clamped_ends(const Model& model, int line);

/// Arc lengths per line of the model, in the order of the scene.
std::vector<std::vector<double>> stations_of(const Scene& scene, const Model& model);

Observation observe(const Model& model, const State& state, std::span<const std::vector<double>> stations);

/// Tension at the highest line end [N]: what a winch or a hang-off feels.
double top_tension(const Model& model, const Observation& observation);

std::vector<std::string> series_header(const Scene& scene, const Model& model);

class SeriesFile {
 public:
  /// Creates the file and writes the header. Throws std::runtime_error where the disk refuses.
  SeriesFile(const std::filesystem::path& path, const Scene& scene, const Model& model);

  /// Writes a row and flushes it.
  void append(const Observation& observation);

 private:
  void write(const std::string& text);

  const Model& model_;
  std::filesystem::path path_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
};

}  // namespace hawser
