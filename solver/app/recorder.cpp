#include "solver/app/recorder.hpp"

#include <algorithm>
#include <cmath>

namespace hawser {
namespace {

constexpr double most_shapes = 12.0;  // more make a picture grey

long stride_of_shapes(const DynamicsSpec& dynamics) {
  const double interval = std::max(dynamics.fields_interval, dynamics.output_interval);
  return std::max(1L, std::lround(std::ceil(dynamics.duration / interval / most_shapes)));
}

}  // namespace

Shape shape_of(const Model& model, const State& state) {
  Shape shape;
  shape.time = state.t;
  for (int line = 0; line < static_cast<int>(model.lines.size()); ++line) {
    std::vector<Vec3>& positions = shape.lines.emplace_back();
    for (int node = 0; node < model.lines[static_cast<std::size_t>(line)].nodes; ++node) {
      positions.push_back(Vec3(state.q.data() + model.dof(line, node)));
    }
  }
  return shape;
}

Recorder::Recorder(const Scene& scene, const Model& model, const std::vector<std::string>& overrides, const std::filesystem::path& folder)
    : model_(model),
      stations_(stations_of(scene, model)),
      series_(folder / "series.csv", scene, model),
      result_(folder / "result.h5", scene, model, overrides, "run"),
      fields_interval_(scene.dynamics->fields_interval),
      shape_stride_(stride_of_shapes(*scene.dynamics)),
      ranges_(model.lines.size()) {}

void Recorder::record(const State& state) {
  last_ = observe(model_, state, stations_);
  series_.append(last_);
  for (std::size_t i = 0; i < ranges_.size(); ++i) ranges_[i].add(model_.lines[i], last_.lines[i]);
  // Output instants carry the rounding of sums of steps: a field is due a millionth of its interval early.
  if (state.t >= (static_cast<double>(fields_) - 1e-6) * fields_interval_) record_field(state);
}

void Recorder::record_field(const State& state) {
  result_.append(state);
  if (fields_ % shape_stride_ == 0) shapes_.push_back(shape_of(model_, state));
  ++fields_;
  field_time_ = state.t;
}

void Recorder::finish(const State& last) {
  if (fields_ == 0 || last.t > field_time_) record_field(last);
  if (shapes_.back().time < last.t) shapes_.push_back(shape_of(model_, last));
  result_.write_state(last);
  for (std::size_t i = 0; i < ranges_.size(); ++i) {
    if (ranges_[i].count > 0) result_.write_range(model_.lines[i], ranges_[i]);
  }
}

}  // namespace hawser
