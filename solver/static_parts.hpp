// A network taken apart: every line solved on its own, the points where it meets others held where they are.
//
// A line alone is what statics is surest of, and no other line can spoil it. Put together again, the lines leave a residual at the points where
// they meet and nowhere else; Newton's first increment there is  S dh = f  (bordered_solver.hpp),  f the balance of the end forces.
#pragma once

#include "solver/statics.hpp"

namespace hawser {

/// This line as a model of its own, its ends at points where lines meet held where the state has them.
Model line_apart(const Model& model, int line, const State& state);

struct LinesApart {
  int unsolved = 0;             // lines
  double factorizations = 0.0;  // a line's count as its share of all unknowns
};

/// Solves every line alone and writes the solved ones into the state. warm: from their shapes in the state.
LinesApart solve_lines_apart(const Model& model, const StaticOptions& options, bool warm, State& state);

}  // namespace hawser
