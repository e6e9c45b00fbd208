// What a static answer shows for itself beside its numbers: where the tension is least, the softest mode of an unstable or neutral state,
// the equilibria that other starts lead to. As JSON and for people.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "solver/app/command_static.hpp"

namespace hawser {

/// Arc length [m] of the node with the least tension of a line.
double least_tension_place(const Line& line, const LineResult& result);

/// "stable", "neutral" or "unstable".
std::string stability_of(const StaticSolution& solution);

/// Null without a mode. The shape is listed node by node, per line.
nlohmann::ordered_json mode_document(const Model& model, const std::optional<StabilityMode>& mode);

nlohmann::ordered_json probe_document(const Model& model, const ProbeReport& probe, const ProbeOptions& options);

/// Nothing, or lines that end a paragraph.
std::string mode_text(const Model& model, const std::optional<StabilityMode>& mode);
std::string probe_text(const Model& model, const ProbeReport& probe, const ProbeOptions& options);

}  // namespace hawser
