// hawser static: the equilibrium of a scene, as a table, as one JSON document, as a folder with pictures.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <vector>

#include "assembly/observables.hpp"
#include "solver/app/cli.hpp"
#include "solver/probe.hpp"
#include "solver/stability.hpp"

namespace hawser {

struct StaticSolution {
  State state;
  StaticReport report;
  std::vector<double> error_estimates;  // relative, of the end tension, per line; NaN: not known
  double wall_seconds = 0.0;            // of the solve itself
  std::optional<StabilityMode> mode;    // of an unstable or neutral state
  std::optional<ProbeReport> probe;     // where asked for
  ProbeOptions probe_options;
};

/// Solves, and where it converged estimates the error of the mesh and probes if asked to. Stages are told on stderr unless quiet.
StaticSolution solve_requested_static(const Request& request, const Scene& scene, const Assembler& assembler);

/// What the request says of the solve, silent; and the first guess that --from or the shapes of lines give, with options.start = given.
StaticOptions requested_static_options(const Request& request, const Scene& scene);
State requested_start(const Request& request, const Scene& scene, const Model& model, StaticOptions& options);

/// The document of `static --json` (README.md). A solve that failed has no lines and no points, but a failure.
nlohmann::ordered_json static_document(const Model& model, const StaticSolution& solution, int stations);

/// Parts of a document: a vector, every point by its name, a failure.
nlohmann::ordered_json vector_document(const Vec3& v);
nlohmann::ordered_json points_document(const Model& model, std::span<const PointResult> points);
nlohmann::ordered_json failure_document(const Failure& failure);

/// The same for people.
std::string static_text(const Scene& scene, const Model& model, const StaticSolution& solution);

int command_static(const Request& request);

}  // namespace hawser
