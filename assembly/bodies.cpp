#include "assembly/bodies.hpp"

#include <Eigen/Geometry>

#include "assembly/element.hpp"

namespace hawser {

namespace {

struct BodyForce {
  Vec3 on_r = Vec3::Zero(), on_slope = Vec3::Zero();
  Mat3 d_r = Mat3::Zero(), d_slope = Mat3::Zero();  // weighted
};

void add_drag(const Model& model, const Body& body, const Vec3& r, const Vec3& v, const TangentWeights& w, BodyForce& out) {
  V3<double> u, gradient;
  current_at(current_table(model), r[2], u, gradient);
  const Vec3 flow = Vec3(u[0], u[1], u[2]) - v;
  const double speed = flow.norm();
  out.on_r -= body.drag * speed * flow;
  if (speed == 0.0) return;
  const Mat3 phi_w = body.drag * (speed * Mat3::Identity() + flow * flow.transpose() / speed);
  out.d_r += w.damping * phi_w;
  out.d_r.col(2) -= w.stiffness * (phi_w * Vec3(gradient[0], gradient[1], gradient[2]));
}

void add_moment(const Vec3& moment, const Vec3& slope, const TangentWeights& w, BodyForce& out) {
  const double alpha = slope.squaredNorm();
  out.on_slope -= moment.cross(slope) / alpha;
  const Mat3 d = Mat3::Identity() / alpha - 2.0 / (alpha * alpha) * slope * slope.transpose();
  for (int j = 0; j < 3; ++j) out.d_slope.col(j) -= w.stiffness * moment.cross(d.col(j));
}

BodyForce body_force(const Model& model, const State& state, const Body& body, const TangentWeights& w) {
  const std::size_t d = model.dof(body.line, body.node);
  const Eigen::Map<const Vec3> r(&state.q[d]), v(&state.v[d]), a(&state.a[d]);
  const double mass = body.mass + body.added_mass;
  BodyForce out;
  out.on_r = mass * a + Vec3(0.0, 0.0, body.wet_weight) - body.force(state.t);
  out.d_r = w.mass * mass * Mat3::Identity();
  if (body.drag > 0.0) add_drag(model, body, r, v, w, out);
  if (body.moment.any() && model.chain(body.line).block == 6) add_moment(body.moment(state.t), Eigen::Map<const Vec3>(&state.q[d + 3]), w, out);
  return out;
}

void add_force(const Model& model, const Body& body, const BodyForce& f, std::span<double> r) {
  const std::size_t d = model.dof(body.line, body.node);
  Eigen::Map<Vec3> on_r(&r[d]);
  on_r += f.on_r;
  if (!body.moment.any() || model.chain(body.line).block != 6) return;
  Eigen::Map<Vec3> on_slope(&r[d + 3]);
  on_slope += f.on_slope;
}

}  // namespace

void add_bodies(const Model& model, const State& state, std::span<double> r) {
  for (const Body& body : model.bodies) add_force(model, body, body_force(model, state, body, TangentWeights{0.0, 0.0, 0.0}), r);
}

void add_bodies(const Model& model, const State& state, std::span<double> r, const TangentWeights& weights, AddedBlocks blocks) {
  for (const Body& body : model.bodies) {
    const BodyForce f = body_force(model, state, body, weights);
    add_force(model, body, f, r);
    const Chain& c = model.chain(body.line);
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>> D(blocks.D(c, body.node), c.block, c.block);
    D.topLeftCorner(3, 3) += f.d_r;
    if (c.block == 6) D.bottomRightCorner(3, 3) += f.d_slope;
  }
}

void add_spread_loads(const Model& model, const State& state, std::span<double> r) {
  for (const SpreadLoad& load : model.spread_loads) {
    if (joint_of(model, load.element)) continue;
    const Line& line = model.lines[load.line];
    const Chain& c = model.chain(load.line);
    const Eigen::Vector4d s = spread_factors(line.family, model.element.length[load.element], load.xi0, load.xi1);
    const Vec3 force = load.share * load.force(state.t);
    const int node = load.element - line.first_element;
    for (int end = 0; end < 2; ++end)
      for (int i = 0; i < c.block / 3; ++i) {
        Eigen::Map<Vec3> at(&r[c.dof(node + end) + 3 * i]);
        at -= s[2 * end + i] * force;
      }
  }
}

}  // namespace hawser
