// hawser check: what was understood of a scene, what it will cost, and what looks odd. Nothing is solved.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "solver/app/cli.hpp"

namespace hawser {

/// Terms of the residual a line uses: "axial", "bending", "weight", "inertia", "drag", "added mass", "axial damping".
std::vector<std::string> terms_of(const Model& model, const Line& line);

struct CostEstimate {
  double bytes = 0.0;            // tangent, factors, states and element data
  double static_seconds = 0.0;   // ten iterations, one thread
  double dynamic_seconds = 0.0;  // steps x 3 iterations; 0 without dynamics
  long steps = 0;
};

CostEstimate estimate_cost(const Scene& scene, const Model& model);

/// Oddities that are no errors: a line stretched by its end points, a step too long for a motion, ...
std::vector<std::string> odd_things(const Scene& scene, const Model& model);

int command_check(const Request& request);

}  // namespace hawser
