// Recorder: keeps what a run passes through: a row of series.csv at every output instant, whole fields at their
// interval, the range of the tension, and a few shapes for the pictures.
#pragma once

#include <filesystem>
#include <vector>

#include "solver/app/recorder_hdf5.hpp"
#include "solver/app/recorder_series.hpp"

namespace hawser {

/// Node positions of every line at one instant.
struct Shape {
  double time = 0.0;                     // s
  std::vector<std::vector<Vec3>> lines;  // as Model::lines
};

Shape shape_of(const Model& model, const State& state);

class Recorder {
 public:
  /// Writes series.csv and result.h5 into `folder`. The scene and the model must outlive the recorder.
  Recorder(const Scene& scene, const Model& model, const std::vector<std::string>& overrides, const std::filesystem::path& folder);

  /// Call at every output instant, in order of time.
  void record(const State& state);

  /// Adds the last instant to the fields, the state for a restart and the tension ranges.
  void finish(const State& last);

  ResultFile& result_file() { return result_; }
  const Observation& last() const { return last_; }
  const std::vector<TensionRange>& ranges() const { return ranges_; }
  const std::vector<Shape>& shapes() const { return shapes_; }

 private:
  void record_field(const State& state);

  const Model& model_;
  std::vector<std::vector<double>> stations_;
  SeriesFile series_;
  ResultFile result_;
  double fields_interval_;
  long shape_stride_;  // every so many fields give a shape
  long fields_ = 0;
  double field_time_ = 0.0;  // s, of the last field
  Observation last_;
  std::vector<TensionRange> ranges_;
  std::vector<Shape> shapes_;
};

}  // namespace hawser
