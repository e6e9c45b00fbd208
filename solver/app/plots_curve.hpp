// curve.png: tension at the ends of every line against a varied value, from FOLDER/curve.csv; script in FOLDER/plots.
#pragma once

#include <filesystem>
#include <string>

#include "assembly/model.hpp"

namespace hawser {

/// `abscissa` names the varied key and its unit. Empty where it went well, else what went wrong.
std::string draw_curve(const std::filesystem::path& folder, const std::string& title, const std::string& abscissa, const Model& model);

}  // namespace hawser
