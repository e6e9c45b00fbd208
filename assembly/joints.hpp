// joints: elements whose right end slope jumps, and the elimination of their inner unknowns (architecture rule 8).
//
// The element tangent K (rows r0, r0', r1, b) is taken three times, for the weights stiffness, damping and mass, because a
// scaled joint makes b_dot and b_ddot depend on q as well: with z = (r', mu) of the node
//   dR/dz = K_k db/dz + K_c db_dot/dz + K_m db_ddot/dz,  each weighted;  R_r' = mu f_b,  R_mu = r'.f_b.
#pragma once

#include "assembly/added_blocks.hpp"
#include "assembly/assembler.hpp"
#include "assembly/element.hpp"

namespace hawser {

/// The element of a joint in its chain unknowns x = (r0, r0', r1, r' of the node) and inner unknowns c.
struct JointElement {
  Vector12 rx;
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1> rc;
  Matrix12 Kxx;  // condensed: Kxx - Kxc Kcc^-1 Kcx
  Elimination elimination;
};

JointElement evaluate_joint(const Model& model, const State& state, const Joint& joint, const TangentWeights& weights, const TangentFloor& floor);

/// Adds the condensed element to residual and blocks, writes the residual of its inner unknowns.
Elimination add_joint(const Model& model, const State& state, const Joint& joint, const TangentWeights& weights, const TangentFloor& floor,
                      std::span<double> r, AddedBlocks& blocks);

/// Residual alone: rx and rc.
void joint_residual(const Model& model, const State& state, const Joint& joint, Vector12& rx, Eigen::Ref<Eigen::VectorXd> rc);

/// The least tension that a floor keeps in an element's geometric stiffness.
double least_tension(const Model& model, const TangentFloor& floor, int element);

}  // namespace hawser
