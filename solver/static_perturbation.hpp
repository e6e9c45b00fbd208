// Folds and knots, and shapes that lead out of them and of equilibria that are not stable.
#pragma once

#include <optional>

#include "assembly/model.hpp"
#include "assembly/state.hpp"

namespace hawser {

/// Bows every line sideways, across its chord and along its load where there is no bed, along the bed where there is one.
void bow_sideways(const Model& model, State& state);

/// A line turns back within an element.
bool folded(const Model& model, const State& state);

/// A place where the line turns back within an element although it is taut there, a loop that the mesh cannot follow; or where r' vanishes in one
/// that is too stiff to be turned by what it carries, for there it turns without any curvature; or where it leaves a clamp backwards. (A line that
/// hangs in two legs folds too, but carries no more there than the weight of some elements.) Tension and load T, q h on an element of length h bend
/// it by less than two radians where EI > (T + q h) h^2, for no curvature is larger than 2 sqrt(T/EI); to turn back takes more than pi.
struct Knot {
  int line = 0, element = 0;      // of the line
  double s = 0.0, tension = 0.0;  // m, N
  double bend = 0.0;              // m, the length sqrt(EI/(T + q h)) along which the line could turn
};
std::optional<Knot> find_knot(const Model& model, const State& state);

/// Draws a cubic over every knot and as far to its sides as the line needs to turn, from slope to slope; false where there is none.
bool draw_out_knots(const Model& model, State& state);

/// The straight start as a loop of about the right length: for lines that would hang in two legs side by side.
State open_start(const Model& model);

/// The largest distance of a node from where it is in the other state, of the longest line.
double distance(const Model& model, const State& a, const State& b);

}  // namespace hawser
