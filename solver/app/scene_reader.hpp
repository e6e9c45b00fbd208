// From the text of a scene file (TOML, data/README.md) to a checked Scene.
//
// Unit strings become SI, angles radians. Every fault is found in one pass and reported with its place; a Scene that
// is returned satisfies every rule of data/README.md, so that build_model accepts it.
#pragma once

#include <string>
#include <vector>

#include "assembly/scene.hpp"
#include "solver/app/diagnostics.hpp"

namespace hawser {

/// Reads and checks a scene. `overrides` are `key.path=value` (the argument of --set): list items by number from 0, the
/// value as in TOML, a bare word being a string. Warnings go to `warnings`, or to stderr where that is null.
/// Throws InputError, whatever the file holds.
Scene read_scene(const std::string& path, const std::vector<std::string>& overrides = {}, std::vector<Diagnostic>* warnings = nullptr);

}  // namespace hawser
