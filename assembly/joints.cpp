#include "assembly/joints.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>

namespace hawser {

namespace {

using Columns = Eigen::Matrix<double, 12, 4>;  // derivative of the 12 element rows with (r', mu)
using Slopes = Eigen::Matrix<double, 3, 4>;    // derivative of b, b_dot or b_ddot with (r', mu)

Vec3 part(const std::vector<double>& x, std::size_t i) { return {x[i], x[i + 1], x[i + 2]}; }

Slopes slopes(double mu, const Vec3& s) {
  Slopes d;
  d << mu * Mat3::Identity(), s;
  return d;
}

void residual_of_scaled(const Joint& joint, const State& state, const Vec3& slope, const Vector12& f, Vector12& rx, Eigen::Ref<Eigen::VectorXd> rc) {
  rx = f;
  rx.tail<3>() = state.q[joint.inner] * f.tail<3>();
  rc[0] = slope.dot(f.tail<3>());
}

void free_joint(const Element& e, JointElement& out) {
  out.rx = e.f;
  out.rx.tail<3>().setZero();
  out.rc = e.f.tail<3>();
  out.Kxx.setZero();
  out.Kxx.topLeftCorner<9, 9>() = e.K.topLeftCorner<9, 9>();
  out.elimination.Kxc.resize(12, 3);
  out.elimination.Kcx.resize(3, 12);
  out.elimination.Kxc << e.K.topRightCorner<9, 3>(), Mat3::Zero();
  out.elimination.Kcx << e.K.bottomLeftCorner<3, 9>(), Mat3::Zero();
  out.elimination.Kcc_inverse = e.K.bottomRightCorner<3, 3>();
}

void scaled_joint(const Model& model, const State& state, const Joint& joint, const TangentWeights& w, const Element parts[3], JointElement& out) {
  const std::size_t slope = model.dof(joint.line, joint.node) + 3;
  const Vec3 s = part(state.q, slope), s_dot = part(state.v, slope), s_ddot = part(state.a, slope);
  const double mu = state.q[joint.inner], mu_dot = state.v[joint.inner], mu_ddot = state.a[joint.inner];
  const Slopes db = w.stiffness * slopes(mu, s);
  const Slopes db_dot = w.stiffness * slopes(mu_dot, s_dot) + w.damping * slopes(mu, s);
  const Slopes db_ddot = w.stiffness * slopes(mu_ddot, s_ddot) + w.damping * 2.0 * slopes(mu_dot, s_dot) + w.mass * slopes(mu, s);
  const Columns dz = parts[0].K.rightCols<3>() * db + parts[1].K.rightCols<3>() * db_dot + parts[2].K.rightCols<3>() * db_ddot;
  const Matrix12 K = w.stiffness * parts[0].K + w.damping * parts[1].K + w.mass * parts[2].K;
  const Vec3 fb = parts[0].f.tail<3>();

  out.Kxx.topLeftCorner<9, 9>() = K.topLeftCorner<9, 9>();
  out.Kxx.topRightCorner<9, 3>() = dz.topLeftCorner<9, 3>();
  out.Kxx.bottomLeftCorner<3, 9>() = mu * K.bottomLeftCorner<3, 9>();
  out.Kxx.bottomRightCorner<3, 3>() = mu * dz.bottomLeftCorner<3, 3>();
  Elimination& e = out.elimination;
  e.Kxc.resize(12, 1);
  e.Kcx.resize(1, 12);
  e.Kxc << dz.topRightCorner<9, 1>(), mu * dz.bottomRightCorner<3, 1>() + w.stiffness * fb;
  e.Kcx << s.transpose() * K.bottomLeftCorner<3, 9>(), s.transpose() * dz.bottomLeftCorner<3, 3>() + w.stiffness * fb.transpose();
  e.Kcc_inverse.resize(1, 1);
  e.Kcc_inverse(0, 0) = s.dot(dz.bottomRightCorner<3, 1>().col(0));
  out.rc.resize(1);
  residual_of_scaled(joint, state, s, parts[0].f, out.rx, out.rc);
}

/// Turns Kcc (held in Kcc_inverse) into its inverse and Kxx into the condensed block.
void condense(JointElement& out) {
  Elimination& e = out.elimination;
  const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 3> Kcc = e.Kcc_inverse;
  if (Kcc.rows() == 1) {
    e.negative_pivots = Kcc(0, 0) < 0.0;
    e.Kcc_inverse(0, 0) = 1.0 / Kcc(0, 0);
  } else {
    const Mat3 full = Kcc;
    const Eigen::SelfAdjointEigenSolver<Mat3> symmetric(0.5 * (full + full.transpose()), Eigen::EigenvaluesOnly);
    e.negative_pivots = static_cast<int>((symmetric.eigenvalues().array() < 0.0).count());
    e.Kcc_inverse = full.inverse();
  }
  out.Kxx.noalias() -= e.Kxc * (e.Kcc_inverse * e.Kcx);
}

}  // namespace

double least_tension(const Model& model, const TangentFloor& floor, int element) {
  const double asked = floor.tension > 0.0 ? floor.tension : no_floor;
  return floor.use_minimum ? std::max(asked, model.element.minimum_tension[element]) : asked;
}

JointElement evaluate_joint(const Model& model, const State& state, const Joint& joint, const TangentWeights& weights, const TangentFloor& floor) {
  const double least = least_tension(model, floor, joint.element);
  JointElement out;
  if (joint.jump == Jump::free) {
    free_joint(evaluate_element(model, state, joint.line, joint.element, weights, least, floor.gauss_newton), out);
  } else {
    const TangentWeights unit[3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    Element parts[3];
    for (int k = 0; k < 3; ++k) parts[k] = evaluate_element(model, state, joint.line, joint.element, unit[k], least, floor.gauss_newton);
    scaled_joint(model, state, joint, weights, parts, out);
  }
  condense(out);
  return out;
}

Elimination add_joint(const Model& model, const State& state, const Joint& joint, const TangentWeights& weights, const TangentFloor& floor,
                      std::span<double> r, AddedBlocks& blocks) {
  const JointElement e = evaluate_joint(model, state, joint, weights, floor);
  const Chain& chain = model.chain(joint.line);
  const int left = joint.node - 1;
  Eigen::Map<Vector12>(&r[chain.dof(left)]) += e.rx;
  for (int i = 0; i < joint.inner_count(); ++i) r[joint.inner + i] = e.rc[i];
  using Block = Eigen::Map<Eigen::Matrix<double, 6, 6>>;
  Block(blocks.D(chain, left)) += e.Kxx.topLeftCorner<6, 6>();
  Block(blocks.U(chain, left)) += e.Kxx.topRightCorner<6, 6>();
  Block(blocks.L(chain, left)) += e.Kxx.bottomLeftCorner<6, 6>();
  Block(blocks.D(chain, joint.node)) += e.Kxx.bottomRightCorner<6, 6>();
  return e.elimination;
}

void joint_residual(const Model& model, const State& state, const Joint& joint, Vector12& rx, Eigen::Ref<Eigen::VectorXd> rc) {
  const Vector12 f = element_force(model, state, joint.line, joint.element);
  if (joint.jump == Jump::scaled) {
    residual_of_scaled(joint, state, part(state.q, model.dof(joint.line, joint.node) + 3), f, rx, rc);
    return;
  }
  rx = f;
  rx.tail<3>().setZero();
  rc = f.tail<3>();
}

}  // namespace hawser
