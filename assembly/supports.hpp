// supports: what is held at the end of a line. Q projects the node's unknowns on the directions that may move:
//   r: nothing;  r' : everything (pinned), or d d^T (clamped: the direction is held, never the length).
#pragma once

#include <span>

#include "assembly/block_tridiagonal.hpp"
#include "assembly/model.hpp"

namespace hawser {

/// D <- Q D Q + s (I - Q), U and L that couple the node projected alike; s keeps the size of the diagonal.
/// D, U, L: of the node, where it is the first of its line; U, L: of the node before it, where it is the last.
void constrain(const Model& model, const Support& support, double* D, double* U, double* L);
void constrain(const Model& model, const Support& support, BlockTridiagonal& matrix);

/// r <- Q r at the node.
void project_support(const Model& model, const Support& support, std::span<double> r);

}  // namespace hawser
