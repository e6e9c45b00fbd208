// curve.png: tension at the ends of every line against a varied value, from FOLDER/curve.csv; script in FOLDER/plots.
// Every branch is a curve of its own; its stable parts are filled points on a line, its unstable ones open points, folds belong to both.
#pragma once

#include <filesystem>
#include <string>

#include "assembly/model.hpp"

namespace hawser {

/// What is drawn: how many branches, and whether some of their points are unstable.
struct CurveParts {
  int branches = 1;
  bool unstable = false;
};

/// `abscissa` names the varied key and its unit. Empty where it went well, else what went wrong.
std::string draw_curve(const std::filesystem::path& folder, const std::string& title, const std::string& abscissa, const Model& model,
                       CurveParts parts);

}  // namespace hawser
