#include "assembly/element.hpp"

#include <algorithm>

#include "assembly/seabed.hpp"

namespace hawser {

namespace {

V3<double> load3(const std::vector<double>& x, std::size_t i) { return {{x[i], x[i + 1], x[i + 2]}}; }

V3<double> scaled_slope(const Joint& joint, const State& state, std::size_t slope, int derivative) {
  const V3<double> s = load3(state.q, slope), v = load3(state.v, slope), a = load3(state.a, slope);
  const double mu = state.q[joint.inner], mu_dot = state.v[joint.inner], mu_ddot = state.a[joint.inner];
  switch (derivative) {
    case 0:
      return mu * s;
    case 1:
      return mu_dot * s + mu * v;
    default:
      return mu_ddot * s + (2.0 * mu_dot) * v + mu * a;
  }
}

Properties<double> element_properties(const Model& model, int e, double least_tension) {
  const ElementArrays& p = model.element;
  return {p.length[e],       p.EA[e],
          p.EI[e],           p.axial_damping[e],
          p.mass[e],         p.weight[e],
          p.drag_normal[e],  p.drag_tangential[e],
          p.added_normal[e], p.added_tangential[e],
          least_tension};
}

template <class Family, Want want>
void evaluate(const ElementState<double>& x, const Properties<double>& e, const Weights& w, const CurrentTable& current, Element& out) {
  using Shape = typename Family::Shape;
  constexpr int n = 2 * Shape::node_vectors;
  constexpr int stride = 6 / Shape::node_vectors;  // rows from one vector to the next
  ElementResult<Shape, double> result;
  whole_element<Family, want>(x, e, w, current, result);
  out.f.setZero();
  if constexpr (want == Want::tangent) out.K.setZero();
  for (int i = 0; i < n; ++i) {
    for (int c = 0; c < 3; ++c) out.f[stride * i + c] = result.f[i][c];
    if constexpr (want == Want::tangent)
      for (int j = 0; j < n; ++j)
        for (int c = 0; c < 9; ++c) out.K(stride * i + c % 3, stride * j + c / 3) = result.K[i][j].m[c];
  }
}

template <Want want>
void evaluate_family(Family family, bool wet, const ElementState<double>& x, const Properties<double>& e, const Weights& w,
                     const CurrentTable& current, Element& out) {
  switch (family) {
    case Family::bar:
      return wet ? evaluate<BarWet, want>(x, e, w, current, out) : evaluate<BarDry, want>(x, e, w, current, out);
    case Family::cable:
      return wet ? evaluate<CableWet, want>(x, e, w, current, out) : evaluate<CableDry, want>(x, e, w, current, out);
    case Family::beam:
      return wet ? evaluate<BeamWet, want>(x, e, w, current, out) : evaluate<BeamDry, want>(x, e, w, current, out);
  }
}

void subtract_spread_loads(const Model& model, const State& state, int line, int element, Vector12& f) {
  for (const SpreadLoad& load : model.spread_loads) {
    if (load.element != element) continue;
    const Eigen::Vector4d s = spread_factors(model.lines[line].family, model.element.length[element], load.xi0, load.xi1);
    const Vec3 force = load.share * load.force(state.t);
    for (int i = 0; i < 4; ++i) f.segment<3>(3 * i) -= s[i] * force;
  }
}

}  // namespace

std::array<const std::vector<double>*, property_count - 1> property_arrays(const ElementArrays& e) {
  return {&e.length, &e.EA, &e.EI, &e.axial_damping, &e.mass, &e.weight, &e.drag_normal, &e.drag_tangential, &e.added_normal, &e.added_tangential};
}

CurrentTable current_table(const Model& model) {
  return {static_cast<int>(model.current.z.size()), model.current.z.data(), model.current.ux.data(), model.current.uy.data()};
}

const Joint* joint_of(const Model& model, int element) {
  const auto found = std::lower_bound(model.joints.begin(), model.joints.end(), element, [](const Joint& j, int e) { return j.element < e; });
  return found != model.joints.end() && found->element == element ? &*found : nullptr;
}

ElementState<double> element_state(const Model& model, const State& state, int line, int element) {
  const int node = element - model.lines[line].first_element;
  const std::size_t left = model.dof(line, node), right = model.dof(line, node + 1);
  const bool slopes = model.chain(line).block == 6;
  const Joint* joint = joint_of(model, element);
  ElementState<double> x;
  Nodal<double>* to[3] = {&x.q, &x.v, &x.a};
  const std::vector<double>* from[3] = {&state.q, &state.v, &state.a};
  for (int k = 0; k < 3; ++k) {
    *to[k] = {load3(*from[k], left), zero_vector<double>(), load3(*from[k], right), zero_vector<double>()};
    if (!slopes) continue;
    to[k]->s0 = load3(*from[k], left + 3);
    if (!joint)
      to[k]->s1 = load3(*from[k], right + 3);
    else if (joint->jump == Jump::free)
      to[k]->s1 = load3(*from[k], joint->inner);
    else
      to[k]->s1 = scaled_slope(*joint, state, right + 3, k);
  }
  return x;
}

Element evaluate_element(const Model& model, const State& state, int line, int element, const TangentWeights& weights, double least_tension,
                         bool gauss_newton) {
  Element out;
  const Weights w{weights.stiffness, weights.damping, weights.mass, gauss_newton};
  const ElementState<double> x = element_state(model, state, line, element);
  evaluate_family<Want::tangent>(model.lines[line].family, model.wet, x, element_properties(model, element, least_tension), w, current_table(model),
                                 out);
  subtract_spread_loads(model, state, line, element, out.f);
  add_contact(model, line, element, x, weights, gauss_newton, out.f, &out.K);
  return out;
}

Vector12 element_force(const Model& model, const State& state, int line, int element) {
  Element out;
  const ElementState<double> x = element_state(model, state, line, element);
  evaluate_family<Want::force>(model.lines[line].family, model.wet, x, element_properties(model, element, no_floor), Weights{1.0, 0.0, 0.0, false},
                               current_table(model), out);
  subtract_spread_loads(model, state, line, element, out.f);
  add_contact(model, line, element, x, TangentWeights{}, false, out.f, nullptr);
  return out.f;
}

Observed<double> observe_element(const Model& model, const State& state, int line, int element) {
  const ElementState<double> x = element_state(model, state, line, element);
  const Vector12 f = element_force(model, state, line, element);
  const V3<double> left{{f[0], f[1], f[2]}}, right{{f[6], f[7], f[8]}};
  const double l = model.element.length[element], EA = model.element.EA[element];
  Observed<double> out;
  if (model.lines[line].family == Family::bar)
    observe<StraightShape>(x.q, left, right, l, EA, out);
  else
    observe<HermiteShape>(x.q, left, right, l, EA, out);
  return out;
}

Eigen::Vector4d spread_factors(Family family, double l, double xi0, double xi1) {
  // Antiderivatives of the shape functions over xi, divided by the width: the mean of each s_i over the interval.
  const auto primitive = [&](double x) -> Eigen::Vector4d {
    if (family == Family::bar) return {x - 0.5 * x * x, 0.0, 0.5 * x * x, 0.0};
    const double x2 = x * x, x3 = x2 * x, x4 = x3 * x;
    return {x - x3 + 0.5 * x4, l * (0.5 * x2 - 2.0 / 3.0 * x3 + 0.25 * x4), x3 - 0.5 * x4, l * (0.25 * x4 - x3 / 3.0)};
  };
  return (primitive(xi1) - primitive(xi0)) / (xi1 - xi0);
}

}  // namespace hawser
