// A state near the chords of the lines, at rest.
#pragma once

#include <random>

#include "assembly/model.hpp"
#include "assembly/state.hpp"

namespace hawser::test {

/// Nodes within 0.02 m of the chords, slopes within 0.1 of `stretch` times those of the chords.
inline State shaken_chords(const Model& model, double stretch, std::mt19937& random) {
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  State state = model.make_state();
  for (std::size_t l = 0; l < model.lines.size(); ++l) {
    const Line& line = model.lines[l];
    const Vec3 a = model.points[line.from].position, b = model.points[line.to].position, t = (b - a) / line.length;
    for (int i = 0; i < line.nodes; ++i) {
      const std::size_t d = model.dof(static_cast<int>(l), i);
      for (int c = 0; c < 3; ++c) {
        state.q[d + c] = a[c] + t[c] * line.s[i] + 0.02 * u(random);
        if (line.family != Family::bar) state.q[d + 3 + c] = stretch * t[c] + 0.1 * u(random);
      }
    }
  }
  return state;
}

}  // namespace hawser::test
