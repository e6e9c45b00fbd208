// --set key.path=value: one value of a parsed scene replaced or added.
#pragma once

#include <optional>
#include <string>

#include "solver/app/diagnostics.hpp"
#include "solver/app/toml_parse.hpp"

namespace hawser {

/// Applies one override. The argument is TOML itself (list items are keys 0, 1, ...), except that a value that is not TOML
/// is taken as a string. New tables are made where missing, but no new line, point or line type.
std::optional<Diagnostic> apply_override(toml::table& root, const std::string& argument);

}  // namespace hawser
