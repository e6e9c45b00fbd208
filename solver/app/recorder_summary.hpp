// summary.json: what a run cost and how it ended.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "solver/app/command_static.hpp"
#include "solver/app/recorder.hpp"
#include "solver/simulate.hpp"

namespace hawser {

struct RunRecord {
  std::optional<StaticSolution> equilibrium;  // where the run started from one
  SimulateReport dynamics;
  double static_seconds = 0.0, dynamic_seconds = 0.0, total_seconds = 0.0;  // wall clock
};

/// "finished", "partial" (interrupted) or "failed".
std::string status_of(const SimulateReport& report);

nlohmann::ordered_json run_summary(const Scene& scene, const Model& model, const RunRecord& run);

/// Settings and counters of the run as attributes of /solver in result.h5.
void describe_run(ResultFile& file, const Scene& scene, const RunRecord& run);

/// A few lines for people.
std::string run_text(const Scene& scene, const Model& model, const RunRecord& run, const std::vector<TensionRange>& ranges);

}  // namespace hawser
