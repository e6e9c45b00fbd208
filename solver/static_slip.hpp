// From a bed that holds a line late to the real one: the branch of equilibria in the slip d of static friction, followed in its arclength.
//
//   R(q; d) = 0,     p = log10(d/d_real), from p > 0 to 0
//
// Friction is a spring of mu N/d until a line has moved by d (assembly/seabed_law.hpp). With d a part of the length it is weak and smooth, and the
// line lies about where a current carries it; towards the real d the places that have moved little begin to stick, one after the other. Motion
// follows that only while the equilibrium attracts it, the branch also past folds and past places where the line would begin to swirl
// (continuation.hpp). What it leads to must be certified like any other equilibrium.
#pragma once

#include <string>

#include "solver/model_branch.hpp"
#include "solver/statics.hpp"

namespace hawser {

struct SlipBranch {
  bool started = false, reached = false;  // the equilibrium at its first slip was found; the branch came to the real one
  double first = 0.0, least = 0.0;        // m, slips: where it began, and the least it came to
  int folds = 0, factorizations = 0;
  State state;  // where reached
};

/// For the account of the stages.
std::string describe(const SlipBranch& branch);

/// Begins at `share` of the longest line and takes about so many factorizations at most, up to 1500 of them for the first equilibrium.
SlipBranch follow_slip(const Model& model, const StaticOptions& options, double share, int iterations);

}  // namespace hawser
