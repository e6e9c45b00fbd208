// result.h5: whole fields in time and the exact last state (HDF5; the only place that includes its headers).
//
//   /                     attributes: hawser_version, created, kind, status, title, scene_path
//   /scene                the text of the scene file;  /overrides  the --set texts, one a line
//   /solver               attributes: integrator, step, tolerance, linear_solver, counters, wall seconds ...
//   /time [n]             s
//   /lines/NAME/s [nodes] m;  position, velocity [n, nodes, 3] m, m/s;  slope [n, nodes, 3] (cable and beam);
//                         tension [n, nodes] N;  curvature [n, nodes] 1/m
//   /lines/NAME/envelope  s, tension_min, tension_mean, tension_max [2 elements]: both ends of every element
//   /state                q, v, a [unknowns] of the last instant, attribute t: what `static --from` reads
// Failures of the file system throw std::runtime_error.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "assembly/model.hpp"
#include "assembly/observables.hpp"
#include "assembly/state.hpp"

namespace hawser {

/// Least, mean and largest tension [N] at both ends of every element of a line, over the recorded instants.
struct TensionRange {
  std::vector<double> s, low, high, sum;
  long count = 0;

  void add(const Line& line, const LineResult& result);
  std::vector<double> mean() const;
};

class ResultFile {
 public:
  using Attribute = std::variant<double, long, std::string>;

  /// Creates the file with the scene, the meshes and empty fields. kind: "run" or "static".
  ResultFile(const std::filesystem::path& path, const Scene& scene, const Model& model, const std::vector<std::string>& overrides,
             std::string_view kind);
  ~ResultFile();

  /// Adds one instant of every line, and flushes.
  void append(const State& state);

  void write_state(const State& state);
  void write_range(const Line& line, const TensionRange& range);

  /// An attribute of /solver.
  void set_solver(const std::string& name, const Attribute& value);

  /// "finished", "partial" or "failed".
  void set_status(const std::string& status);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// /state of a result on the same mesh. Throws InputError where the file is no result of this mesh.
State read_last_state(const std::filesystem::path& path, const Model& model);

}  // namespace hawser
