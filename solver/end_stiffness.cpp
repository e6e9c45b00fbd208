#include "solver/end_stiffness.hpp"

#include <Eigen/Geometry>

#include "assembly/assembler.hpp"
#include "assembly/supports.hpp"
#include "solver/bordered_solver.hpp"

namespace hawser {
namespace {

/// Unit motion number `column` of a held end, as a vector of chain unknowns.
std::vector<double> unit_motion(const Model& model, const State& state, const Support& support, int column) {
  std::vector<double> motion(model.dofs);
  const std::size_t r = model.dof(support.line, support.node);
  const Vec3 axis = Vec3::Unit(column % 3);
  if (column < 3) {
    Eigen::Map<Vec3> displacement(&motion[r]);
    displacement = axis;
  } else {
    const Eigen::Map<const Vec3> slope(&state.q[r + 3]);
    Eigen::Map<Vec3> turn(&motion[r + 3]);
    turn = axis.cross(slope);
  }
  return motion;
}

}  // namespace

std::vector<EndStiffness> end_stiffness(const Model& model, const State& state) {
  Model open = model;  // without supports and hubs the tangent keeps their rows and columns
  open.supports.clear();
  open.hubs.clear();
  const Assembler assembler(open), closed(model);
  Tangent held = assembler.make_tangent();
  std::vector<double> residual(model.unknowns);
  assembler.tangent(state, TangentWeights{}, TangentFloor{}, residual, held);
  const BlockTridiagonal whole = held.chain;
  for (const Support& support : model.supports) constrain(model, support, held.chain);
  held.border = make_border(model);
  take_border(model, held.chain, held.border);
  const auto chains = make_linear_solver(LinearSolverKind::automatic);
  BorderedSolver linear(*chains);
  linear.analyze(held);
  const bool regular = linear.factorize(held).status == FactorStatus::ok;

  std::vector<EndStiffness> result;
  std::vector<double> force(model.dofs), answer(model.dofs);
  for (const Support& support : model.supports) {
    EndStiffness& end = result.emplace_back(EndStiffness{support.line, support.node == 0, {}});
    if (!regular) continue;
    const std::size_t r = model.dof(support.line, support.node);
    const int size = support.clamped ? 6 : 3;
    end.value.resize(size, size);
    for (int column = 0; column < size; ++column) {
      std::vector<double> motion = unit_motion(model, state, support, column);
      whole.multiply(motion, answer);
      if (column >= 3) {
        // A clamped slope may stretch along its direction d only, d . R_r' = 0, and d turns: d . dR_r' + (omega x d) . R_r' = 0.
        const Eigen::Map<const Vec3> couple(&residual[r + 3]);
        Eigen::Map<Vec3> stretching(&answer[r + 3]);
        stretching += Vec3::Unit(column - 3).cross(support.direction).dot(couple) * support.direction;
      }
      closed.project(answer);
      linear.solve(answer);
      for (std::size_t i = 0; i < model.dofs; ++i) motion[i] -= answer[i];
      whole.multiply(motion, force);
      end.value.col(column).head(3) = Eigen::Map<const Vec3>(&force[r]);
      if (!support.clamped) continue;
      const Eigen::Map<const Vec3> slope(&state.q[r + 3]), turn(&motion[r + 3]), couple(&residual[r + 3]), change(&force[r + 3]);
      end.value.col(column).tail(3) = turn.cross(couple) + slope.cross(change);
    }
  }
  return result;
}

}  // namespace hawser
