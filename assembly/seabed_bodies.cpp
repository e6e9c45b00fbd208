#include "assembly/seabed_bodies.hpp"

namespace hawser {
namespace {

using ConstVec3 = Eigen::Map<const Vec3>;

/// Per length of line, with its derivatives. A body has no direction of its own.
ContactForce force_on(const Model& model, const State& state, const Body& body, FrictionTangent friction) {
  const std::size_t d = model.dof(body.line, body.node);
  const ConstVec3 r(&state.q[d]), v(&state.v[d]);
  const Seabed& bed = *model.seabed;
  return contact_tangent(bed.law, bed.surface.at(r.x(), r.y()), r, Vec3::Zero(), v, body.lay ? &*body.lay : nullptr, friction);
}

bool may_touch(const Model& model, const Body& body) { return model.seabed && body.bed_length > 0.0; }

void add_force(const Model& model, const Body& body, const ContactForce& contact, std::span<double> r) {
  Eigen::Map<Vec3> at(&r[model.dof(body.line, body.node)]);
  at -= body.bed_length * contact.force;
}

}  // namespace

void add_seabed_to_bodies(const Model& model, const State& state, std::span<double> r) {
  for (const Body& body : model.bodies)
    if (may_touch(model, body)) add_force(model, body, force_on(model, state, body, FrictionTangent::exact), r);
}

void add_seabed_to_bodies(const Model& model, const State& state, std::span<double> r, const TangentWeights& weights, bool secant,
                          AddedBlocks blocks) {
  for (const Body& body : model.bodies) {
    if (!may_touch(model, body)) continue;
    const ContactForce contact = force_on(model, state, body, secant ? FrictionTangent::secant : model.seabed->friction_tangent);
    add_force(model, body, contact, r);
    const Chain& c = model.chain(body.line);
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>> D(blocks.D(c, body.node), c.block, c.block);
    D.topLeftCorner(3, 3) -= body.bed_length * (weights.stiffness * contact.d_r + weights.damping * contact.d_v);
  }
}

Vec3 seabed_force(const Model& model, const State& state, const Body& body) {
  if (!may_touch(model, body)) return Vec3::Zero();
  return body.bed_length * force_on(model, state, body, FrictionTangent::exact).force;
}

double lift_of_bodies(const Model& model, const State& state, int line) {
  double lift = 0.0;
  for (const Body& body : model.bodies)
    if (body.line == line && body.node > 0 && body.node < model.lines[line].elements) lift += seabed_force(model, state, body).z();
  return lift;
}

double seabed_energy(const Model& model, const State& state, const Body& body) {
  if (!may_touch(model, body)) return 0.0;
  const ConstVec3 r(&state.q[model.dof(body.line, body.node)]);
  return body.bed_length * contact_energy(model.seabed->law, model.seabed->surface.height(r.x(), r.y()) - r.z());
}

}  // namespace hawser
