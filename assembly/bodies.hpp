// bodies: concentrated masses, weights, drag, forces and moments at nodes, and forces spread over part of an element.
//
//   R_r  += (m + m_a) r_ddot + W e_z - k |w| w - F(t),   w = u(z) - r_dot,   k = 1/2 rho Cd A              (theory 5.6)
//   R_r' -= (M(t) x t)/|r'|                              a moment M does the work M.(t x dr')/|r'|
// Spread forces enter with the exact integrals of the shape functions (theory 5.5, the paper's force G).
#pragma once

#include <span>

#include "assembly/added_blocks.hpp"
#include "assembly/model.hpp"
#include "assembly/state.hpp"

namespace hawser {

void add_bodies(const Model& model, const State& state, std::span<double> r);
void add_bodies(const Model& model, const State& state, std::span<double> r, const TangentWeights& weights, AddedBlocks blocks);

/// On elements without a joint; a joint's element takes its own (element.hpp).
void add_spread_loads(const Model& model, const State& state, std::span<double> r);

}  // namespace hawser
