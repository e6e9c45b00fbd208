#include "solver/app/recorder_series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <iterator>
#include <limits>
#include <stdexcept>

#include "solver/app/text.hpp"

namespace hawser {

ClampedEnds clamped_ends(const Model& model, int line) {
  ClampedEnds ends;
  for (const Support& support : model.supports) {
    if (support.line != line || !support.clamped) continue;
    (support.node == 0 ? ends.from : ends.to) = true;
  }
  return ends;
}

std::vector<std::vector<double>> stations_of(const Scene& scene, const Model& model) {
  std::vector<std::vector<double>> result(model.lines.size());
  for (const auto& [name, arc_lengths] : scene.output.stations) {
    const auto line = std::find_if(model.lines.begin(), model.lines.end(), [&wanted = name](const Line& l) { return l.name == wanted; });
    if (line == model.lines.end()) continue;
    auto& stations = result[static_cast<std::size_t>(line - model.lines.begin())];
    stations.insert(stations.end(), arc_lengths.begin(), arc_lengths.end());
  }
  return result;
}

Observation observe(const Model& model, const State& state, std::span<const std::vector<double>> stations) {
  Observation observation;
  observation.time = state.t;
  for (int line = 0; line < static_cast<int>(model.lines.size()); ++line) {
    observation.lines.push_back(observe_line(model, state, line));
    observation.seabed.push_back(observe_seabed(model, state, line));
    const auto& wanted = stations[static_cast<std::size_t>(line)];
    observation.stations.push_back(wanted.empty() ? std::vector<Station>() : observe_stations(model, state, line, wanted));
  }
  observation.points = observe_points(model, state);
  return observation;
}

double top_tension(const Model& model, const Observation& observation) {
  double highest = -std::numeric_limits<double>::infinity(), tension = 0.0;
  for (std::size_t i = 0; i < model.lines.size(); ++i) {
    const Line& line = model.lines[i];
    const double z_from = observation.points[line.from].position.z(), z_to = observation.points[line.to].position.z();
    if (z_from > highest) highest = z_from, tension = observation.lines[i].tension_from;
    if (z_to > highest) highest = z_to, tension = observation.lines[i].tension_to;
  }
  return tension;
}

std::vector<std::string> series_header(const Scene& scene, const Model& model) {
  std::vector<std::string> header{"time"};
  const auto stations = stations_of(scene, model);
  for (std::size_t i = 0; i < model.lines.size(); ++i) {
    const std::string& name = model.lines[i].name;
    for (const char* column : {"tension_from", "tension_to", "tension_max", "tension_min", "curvature_max", "curvature_max_s"}) {
      header.push_back(fmt::format("{}.{}", name, column));
    }
    if (model.seabed) header.push_back(name + ".touchdown");
    const ClampedEnds clamped = clamped_ends(model, static_cast<int>(i));
    if (clamped.from) header.push_back(name + ".moment_from");
    if (clamped.to) header.push_back(name + ".moment_to");
    for (const double s : stations[i]) {
      for (const char* column : {"x", "y", "z", "tension", "curvature"}) header.push_back(fmt::format("{}.{}@{}", name, column, decimal_text(s)));
    }
  }
  for (const ModelPoint& point : model.points) {
    for (const char* axis : {"x", "y", "z"}) header.push_back(fmt::format("{}.{}", point.name, axis));
  }
  return header;
}

SeriesFile::SeriesFile(const std::filesystem::path& path, const Scene& scene, const Model& model)
    : model_(model), path_(path), file_(std::fopen(path.c_str(), "w"), &std::fclose) {
  if (!file_) throw std::runtime_error(fmt::format("cannot write {}: {}", path.string(), std::strerror(errno)));
  write(fmt::format("{}\n", fmt::join(series_header(scene, model), ",")));
}

void SeriesFile::write(const std::string& text) {
  const bool written = std::fwrite(text.data(), 1, text.size(), file_.get()) == text.size() && std::fflush(file_.get()) == 0;
  if (!written) throw std::runtime_error(fmt::format("cannot write {}: {}", path_.string(), std::strerror(errno)));
}

void SeriesFile::append(const Observation& o) {
  fmt::memory_buffer row;
  const auto add = [&row](double value) { fmt::format_to(std::back_inserter(row), ",{}", value); };
  fmt::format_to(std::back_inserter(row), "{}", o.time);
  for (std::size_t i = 0; i < o.lines.size(); ++i) {
    const LineResult& line = o.lines[i];
    for (const double value : {line.tension_from, line.tension_to, line.tension_max, line.tension_min, line.curvature_max, line.curvature_max_s}) {
      add(value);
    }
    if (model_.seabed) add(o.seabed[i].first_touchdown());
    const ClampedEnds clamped = clamped_ends(model_, static_cast<int>(i));
    if (clamped.from) add(line.moment_from.norm());
    if (clamped.to) add(line.moment_to.norm());
    for (const Station& station : o.stations[i]) {
      for (const double value : {station.position.x(), station.position.y(), station.position.z(), station.tension, station.curvature}) add(value);
    }
  }
  for (const PointResult& point : o.points) {
    for (int axis = 0; axis < 3; ++axis) add(point.position[axis]);
  }
  row.push_back('\n');
  write(fmt::to_string(row));
}

}  // namespace hawser
