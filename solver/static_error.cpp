// The error of a static answer from its mesh (statics.hpp).
#include <cmath>
#include <limits>

#include "assembly/observables.hpp"
#include "solver/statics.hpp"

namespace hawser {

std::vector<double> estimate_static_error(const Scene& scene, const StaticOptions& options, const Model& model, const State& state) {
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> estimate(model.lines.size(), unknown);
  const Model coarse = build_model(coarsened(scene));
  const Assembler assembler(coarse, std::max(1, options.threads));
  StaticOptions coarse_options = options;
  coarse_options.start = StaticStart::catenary;
  coarse_options.log = nullptr;
  State coarse_state;
  if (!solve_static(assembler, coarse_options, coarse_state).converged) return estimate;
  for (int line = 0; line < static_cast<int>(model.lines.size()); ++line) {
    const double ratio = static_cast<double>(model.lines[line].elements) / coarse.lines[line].elements;
    if (ratio <= 1.0) continue;
    const LineResult fine = observe_line(model, state, line), rough = observe_line(coarse, coarse_state, line);
    const double order = model.lines[line].family == Family::bar ? 2.0 : 4.0;
    const double scale = std::max(fine.tension_from, fine.tension_to);
    const double difference = std::max(std::abs(fine.tension_from - rough.tension_from), std::abs(fine.tension_to - rough.tension_to));
    if (scale > 0.0) estimate[line] = difference / (scale * (std::pow(ratio, order) - 1.0));
  }
  return estimate;
}

}  // namespace hawser
