// Pictures, drawn by gnuplot from scripts and data files that stay in FOLDER/plots for whoever wants to change them:
//
//   profile.png          shapes of the lines (x-z, or y-z where all lies in that plane), with a plan where they leave the plane
//   tension.png          tension along the lines: least, mean, greatest in time; or the static one
//   tension_history.png  tension at the ends against time (runs)
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "solver/app/recorder.hpp"

namespace hawser {

struct PlotData {
  std::string title;
  const Model& model;
  std::vector<Shape> shapes;         // in order of time, at least one
  std::vector<TensionRange> ranges;  // as Model::lines; empty where nothing was recorded
  bool in_time = false;              // a run (FOLDER/series.csv exists) or a single static
};

struct PlotReport {
  std::vector<std::filesystem::path> pictures;
  std::string trouble;  // why some are missing; empty where all is well
};

PlotReport draw_plots(const std::filesystem::path& folder, const PlotData& data);

}  // namespace hawser
