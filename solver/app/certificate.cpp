#include "solver/app/certificate.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "solver/app/text.hpp"

namespace hawser {
namespace {

using Json = nlohmann::ordered_json;

/// The displacements of one line in a mode.
Json shape_document(const Model& model, const StabilityMode& mode, int index) {
  const Line& line = model.lines[static_cast<std::size_t>(index)];
  Json shape = {{"s", line.s}, {"x", Json::array()}, {"y", Json::array()}, {"z", Json::array()}};
  for (int node = 0; node < line.nodes; ++node) {
    const double* r = &mode.shape[model.dof(index, node)];
    for (int axis = 0; axis < 3; ++axis) shape[std::string(1, "xyz"[axis])].push_back(r[axis]);
  }
  return shape;
}

bool is_neutral(const StabilityMode& mode) { return mode.negative_pivots == 0; }

}  // namespace

double least_tension_place(const Line& line, const LineResult& result) {
  const auto left = std::min_element(result.tension_left.begin(), result.tension_left.end());
  const auto right = std::min_element(result.tension_right.begin(), result.tension_right.end());
  const auto node = *left < *right ? left - result.tension_left.begin() : right - result.tension_right.begin();
  return line.s[static_cast<std::size_t>(node)];
}

std::string stability_of(const StaticSolution& solution) {
  if (!solution.report.stable || (solution.mode && !is_neutral(*solution.mode))) return "unstable";
  return solution.mode ? "neutral" : "stable";
}

Json mode_document(const Model& model, const std::optional<StabilityMode>& mode) {
  if (!mode) return nullptr;
  Json json = {{"stiffness", mode->stiffness},
               {"unstable_directions", mode->negative_pivots},
               {"line", model.lines[static_cast<std::size_t>(mode->line)].name},
               {"s", mode->s},
               {"direction", vector_document(mode->direction)}};
  for (int i = 0; i < static_cast<int>(model.lines.size()); ++i) {
    json["shape"][model.lines[static_cast<std::size_t>(i)].name] = shape_document(model, *mode, i);
  }
  return json;
}

Json probe_document(const Model& model, const ProbeReport& probe, const ProbeOptions& options) {
  Json json = {{"starts", options.starts}, {"failed", probe.failed},      {"factorizations", probe.factorizations},
               {"seed", options.seed},     {"same_within", options.same}, {"equilibria", Json::array()}};
  for (const ProbedEquilibrium& e : probe.equilibria) {
    Json item = {{"found", e.found},
                 {"energy", e.energy},
                 {"distance", e.distance},
                 {"stable", e.report.stable},
                 {"negative_pivots", e.report.negative_pivots},
                 {"residual", e.report.residual},
                 {"lines", Json::object()}};
    for (int i = 0; i < static_cast<int>(model.lines.size()); ++i) {
      const LineResult line = observe_line(model, e.state, i);
      item["lines"][model.lines[static_cast<std::size_t>(i)].name] = {{"tension_from", line.tension_from}, {"tension_to", line.tension_to}};
    }
    json["equilibria"].push_back(std::move(item));
  }
  return json;
}

std::string mode_text(const Model& model, const std::optional<StabilityMode>& mode) {
  if (!mode) return "";
  const Vec3& d = mode->direction;
  const std::string name = model.lines[static_cast<std::size_t>(mode->line)].name;
  const std::string verdict =
      is_neutral(*mode) ? "nothing holds it along this mode" : fmt::format("unstable in {} directions", mode->negative_pivots);
  return fmt::format("softest mode: {} per metre of line and metre; largest in {} at s = {:.6g} m along ({:.3f}, {:.3f}, {:.3f}); {}\n\n",
                     with_prefix(mode->stiffness, "N"), name, mode->s, d.x(), d.y(), d.z(), verdict);
}

std::string probe_text(const Model& model, const ProbeReport& probe, const ProbeOptions& options) {
  std::vector<std::vector<std::string>> rows{{"equilibrium", "found", "energy", "stable", "distance"}};
  for (const Line& line : model.lines) {
    rows[0].push_back(line.name + " from");
    rows[0].push_back(line.name + " to");
  }
  double longest = 0.0;
  for (const Line& line : model.lines) longest = std::max(longest, line.length);
  for (const ProbedEquilibrium& e : probe.equilibria) {
    rows.push_back({rows.size() == 1 ? "this one" : fmt::format("{}", rows.size()), fmt::format("{}", e.found), fmt::format("{:.6g} J", e.energy),
                    e.report.stable ? "yes" : "NO", fmt::format("{:.4g} m", e.distance * longest)});
    for (int i = 0; i < static_cast<int>(model.lines.size()); ++i) {
      const LineResult line = observe_line(model, e.state, i);
      rows.back().push_back(with_prefix(line.tension_from, "N"));
      rows.back().push_back(with_prefix(line.tension_to, "N"));
    }
  }
  const std::size_t count = probe.equilibria.size();
  return fmt::format("\nprobe: {} starts, {} led to no stable equilibrium; {} (the same: all nodes within {:.3g} m)\n{}", options.starts,
                     probe.failed, count == 1 ? std::string("no other equilibrium was found") : fmt::format("{} distinct equilibria", count),
                     options.same * longest, table(rows));
}

}  // namespace hawser
