#include "assembly/observables.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "assembly/element.hpp"
#include "assembly/seabed.hpp"
#include "assembly/seabed_bodies.hpp"
#include "assembly/sweep.hpp"

namespace hawser {

namespace {

Vec3 to_vec(const V3<double>& x) { return {x[0], x[1], x[2]}; }

/// A nodal quantity inside one element, at xi in [0, 1].
class Interpolation {
 public:
  Interpolation(Family family, double length, const Nodal<double>& n) : bar_(family == Family::bar), length_(length) {
    if (bar_)
      to_modes<StraightShape>(n, 1.0 / length, y_);
    else
      to_modes<HermiteShape>(n, 1.0 / length, y_);
  }

  Vec3 value(double xi) const { return to_vec(y_[0]) + length_ * sum(Channel::r, xi); }
  Vec3 slope(double xi) const { return sum(Channel::a, xi); }
  Vec3 second(double xi) const { return sum(Channel::b, xi) / length_; }

 private:
  Vec3 sum(Channel channel, double xi) const { return bar_ ? sum_of<StraightShape>(channel, xi - 0.5) : sum_of<HermiteShape>(channel, xi - 0.5); }

  /// Without the mean.
  template <class Shape>
  Vec3 sum_of(Channel channel, double eta) const {
    V3<double> x = zero_vector<double>();
    for (int j = 1; j < Shape::modes; ++j) add_scaled(x, Shape::coefficient(channel, j, eta), y_[j]);
    return to_vec(x);
  }

  bool bar_;
  double length_;
  V3<double> y_[4];
};

struct ElementView {
  Interpolation q, v, a;
  double length;
};

ElementView view(const Model& model, const State& state, int line, int element) {
  const ElementState<double> x = element_state(model, state, line, element);
  const Family family = model.lines[line].family;
  const double l = model.element.length[element];
  return {Interpolation(family, l, x.q), Interpolation(family, l, x.v), Interpolation(family, l, x.a), l};
}

double material_curvature(const ElementView& e, double xi) {
  const Vec3 a = e.q.slope(xi);
  return a.cross(e.q.second(xi)).norm() / a.squaredNorm();
}

/// Tension vector [N] in the line at the two ends of an element: what the part beyond pulls with.
struct EndForces {
  Vec3 left, right;              // T t
  Vec3 slope_left, slope_right;  // generalized forces conjugate to r' [N m]
};

EndForces end_forces(const Model& model, const State& state, int line, int element) {
  const Vector12 f = element_force(model, state, line, element);
  return {-f.segment<3>(0), f.segment<3>(6), f.segment<3>(3), f.segment<3>(9)};
}

/// d/ds of the tension vector from equilibrium of a slice: inertia - loads [N/m], spread loads and the bed left out.
Vec3 force_rate(const Model& model, const ElementView& e, int element, double xi) {
  const ElementArrays& p = model.element;
  const Vec3 t = e.q.slope(xi).normalized(), acceleration = e.a.value(xi);
  V3<double> u, gradient;
  current_at(current_table(model), e.q.value(xi)[2], u, gradient);
  const Vec3 flow = to_vec(u) - e.v.value(xi);
  const double along = flow.dot(t), along_a = acceleration.dot(t);
  const Vec3 normal = flow - along * t, normal_a = acceleration - along_a * t;
  Vec3 rate = p.mass[element] * acceleration + Vec3(0.0, 0.0, p.weight[element]);
  rate += p.added_normal[element] * normal_a + p.added_tangential[element] * along_a * t;
  rate -= p.drag_normal[element] * normal.norm() * normal + p.drag_tangential[element] * std::abs(along) * along * t;
  return rate;
}

/// Tension vector inside an element: cubic Hermite through both ends with the rates of equilibrium.
Vec3 force_inside(const Model& model, const State& state, int line, const ElementView& e, const EndForces& f, int element, double xi) {
  const double l = e.length, x2 = xi * xi, x3 = x2 * xi;
  const bool spread = std::any_of(model.spread_loads.begin(), model.spread_loads.end(), [&](const SpreadLoad& s) { return s.element == element; });
  if (spread) return (1.0 - xi) * f.left + xi * f.right;
  const auto rate = [&](double end) -> Vec3 { return force_rate(model, e, element, end) - seabed_force(model, state, line, element, end); };
  return (1.0 - 3.0 * x2 + 2.0 * x3) * f.left + (3.0 * x2 - 2.0 * x3) * f.right + l * (xi - 2.0 * x2 + x3) * rate(0.0) + l * (x3 - x2) * rate(1.0);
}

Station station_at(const Model& model, const State& state, int line, int element, double xi) {
  const ElementView e = view(model, state, line, element);
  Station s;
  s.position = e.q.value(xi);
  s.velocity = e.v.value(xi);
  s.tension = force_inside(model, state, line, e, end_forces(model, state, line, element), element, xi).dot(e.q.slope(xi).normalized());
  s.curvature = model.lines[line].family == Family::bar ? 0.0 : material_curvature(e, xi);
  return s;
}

/// Moment on the point at an end: the generalized force on r' turned into r' x f, seen from the point.
Vec3 end_moment(const Vec3& slope, const Vec3& generalized) { return -slope.cross(generalized); }

/// Elements of a line, a panel at a time in packs.
class ObservedPanel {
 public:
  ObservedPanel(const SweepTable& sweep, const Model& model, const State& state, int line, int first, int count) {
    const Line& l = model.lines[line];
    const auto source = property_arrays(model.element);
    SweepLine panel{};
    for (int k = 0; k < property_count; ++k) {
      std::fill_n(property_[k], observed_stride, k == 0 ? 1.0 : 0.0);
      if (k + 1 < property_count) std::copy_n(source[k]->data() + l.first_element + first, count, property_[k]);
      panel.property[k] = property_[k];
    }
    const std::size_t dof = model.dof(line, first);
    panel.elements = count;
    panel.q = state.q.data() + dof;
    panel.v = state.v.data() + dof;
    panel.a = state.a.data() + dof;
    panel.current = current_table(model);
    sweep.observe[sweep_family(static_cast<int>(l.family), model.wet)](panel, row_[0]);
  }

  Observed<double> at(int i) const { return {{row_[0][i], row_[1][i]}, {row_[2][i], row_[3][i]}, {row_[4][i], row_[5][i], row_[6][i]}}; }

 private:
  alignas(64) double property_[property_count][observed_stride];
  alignas(64) double row_[observed_rows][observed_stride];
};

void note(const Line& l, int i, double length, const Observed<double>& seen, LineResult& out) {
  out.tension_right[i] = seen.tension[0];
  out.tension_left[i + 1] = seen.tension[1];
  for (int end = 0; end < 2; ++end) out.curvature[i + end] = std::max(out.curvature[i + end], seen.curvature[end]);
  double least = seen.strain_tension[0];
  for (int k = 0; k < 3; ++k) {
    least = std::min(least, seen.strain_tension[k]);
    if (seen.strain_tension[k] < out.least_strain_tension) {
      out.least_strain_tension = seen.strain_tension[k];
      out.least_strain_tension_s = l.s[i] + 0.5 * k * length;
    }
  }
  if (least < 0.0) out.compressed_length += length;
}

/// Where a slope jumps, a load is spread or the bed carries, the packs do not see everything.
void correct(const Model& model, const State& state, int line, int i, Observed<double>& seen) {
  const int element = model.lines[line].first_element + i;
  const bool spread = std::any_of(model.spread_loads.begin(), model.spread_loads.end(), [&](const SpreadLoad& s) { return s.element == element; });
  if (spread || joint_of(model, element)) {
    seen = observe_element(model, state, line, element);
    return;
  }
  if (!model.seabed) return;
  const ElementState<double> x = element_state(model, state, line, element);
  Vector12 f = Vector12::Zero();
  if (!add_contact(model, line, element, x, TangentWeights{}, false, f, nullptr)) return;
  const bool bar = model.lines[line].family == Family::bar;
  const V3<double> chord = x.q.r1 - x.q.r0;
  seen.tension[0] -= f.segment<3>(0).dot(to_vec(bar ? chord : x.q.s0).normalized());
  seen.tension[1] += f.segment<3>(6).dot(to_vec(bar ? chord : x.q.s1).normalized());
}

void observe_ends(const Model& model, const State& state, int line, LineResult& out) {
  const Line& l = model.lines[line];
  const auto slope = [&](int element, double xi) { return view(model, state, line, element).q.slope(xi); };
  const int last = l.first_element + l.elements - 1;
  const EndForces from = end_forces(model, state, line, l.first_element), to = end_forces(model, state, line, last);
  out.force_from = from.left;
  out.moment_from = end_moment(slope(l.first_element, 0.0), from.slope_left);
  out.force_to = -to.right;
  out.moment_to = end_moment(slope(last, 1.0), to.slope_right);
  out.tension_from = out.force_from.norm();
  out.tension_to = out.force_to.norm();
}

}  // namespace

LineResult observe_line(const Model& model, const State& state, int line) {
  const Line& l = model.lines[line];
  LineResult out;
  out.tension_left.assign(l.nodes, 0.0);
  out.tension_right.assign(l.nodes, 0.0);
  out.curvature.assign(l.nodes, 0.0);
  out.least_strain_tension = std::numeric_limits<double>::infinity();
  const SweepTable& sweep = widest_sweep_table();
  for (int first = 0; first < l.elements; first += panel_elements) {
    const int count = std::min(panel_elements, l.elements - first);
    const ObservedPanel panel(sweep, model, state, line, first, count);
    for (int k = 0; k < count; ++k) {
      Observed<double> seen = panel.at(k);
      correct(model, state, line, first + k, seen);
      note(l, first + k, model.element.length[l.first_element + first + k], seen, out);
    }
  }
  observe_ends(model, state, line, out);
  out.tension_left.front() = out.tension_right.front();
  out.tension_right.back() = out.tension_left.back();
  out.tension_max = std::max(*std::max_element(out.tension_left.begin(), out.tension_left.end()),
                             *std::max_element(out.tension_right.begin(), out.tension_right.end()));
  out.tension_min = std::min(*std::min_element(out.tension_left.begin(), out.tension_left.end()),
                             *std::min_element(out.tension_right.begin(), out.tension_right.end()));
  const auto most = std::max_element(out.curvature.begin(), out.curvature.end());
  out.curvature_max = *most;
  out.curvature_max_s = l.s[most - out.curvature.begin()];
  return out;
}

std::vector<Station> observe_stations(const Model& model, const State& state, int line, std::span<const double> s) {
  const Line& l = model.lines[line];
  std::vector<Station> out;
  for (double at : s) {
    const double inside = std::clamp(at, 0.0, l.length);
    const auto above = std::upper_bound(l.s.begin() + 1, l.s.end() - 1, inside);
    const int i = static_cast<int>(above - l.s.begin()) - 1;
    out.push_back(station_at(model, state, line, l.first_element + i, (inside - l.s[i]) / (l.s[i + 1] - l.s[i])));
    out.back().s = at;
  }
  return out;
}

std::vector<Station> observe_nodes(const Model& model, const State& state, int line) {
  const Line& l = model.lines[line];
  const LineResult r = observe_line(model, state, line);
  std::vector<Station> out(l.nodes);
  for (int i = 0; i < l.nodes; ++i) {
    const std::size_t d = model.dof(line, i);
    out[i].s = l.s[i];
    out[i].position = Eigen::Map<const Vec3>(&state.q[d]);
    out[i].velocity = Eigen::Map<const Vec3>(&state.v[d]);
    out[i].tension = r.tension_right[i];
    out[i].curvature = r.curvature[i];
  }
  return out;
}

std::vector<PointResult> observe_points(const Model& model, const State& state) {
  std::vector<PointResult> out(model.points.size());
  for (std::size_t p = 0; p < out.size(); ++p) {
    const Kinematics k = model.points[p].motion(state.t);
    out[p].position = k.r;
    out[p].velocity = k.v;
  }
  for (std::size_t i = 0; i < model.lines.size(); ++i) {
    const Line& l = model.lines[i];
    const int line = static_cast<int>(i);
    out[l.from].force += end_forces(model, state, line, l.first_element).left;
    out[l.to].force -= end_forces(model, state, line, l.first_element + l.elements - 1).right;
    for (const auto& [point, node] : {std::pair{l.from, 0}, std::pair{l.to, l.nodes - 1}}) {
      const std::size_t d = model.dof(line, node);
      out[point].position = Eigen::Map<const Vec3>(&state.q[d]);
      out[point].velocity = Eigen::Map<const Vec3>(&state.v[d]);
    }
  }
  for (const Body& body : model.bodies) {
    const Line& l = model.lines[body.line];
    if (body.node == 0 || body.node == l.elements) out[body.node == 0 ? l.from : l.to].bed += seabed_force(model, state, body);
  }
  return out;
}

namespace {

void add_element_energies(const Model& model, const State& state, int line, int element, Energies& sum) {
  const ElementArrays& p = model.element;
  const ElementView e = view(model, state, line, element);
  const double l = e.length;
  // Mass and weight by four Gauss points: exact for the sextic of the consistent mass.
  for (int q = 0; q < 4; ++q) {
    const double m = four_gauss_weight[q] * l * p.mass[element];
    const Vec3 r = e.q.value(four_gauss_xi[q]), v = e.v.value(four_gauss_xi[q]);
    sum.kinetic += 0.5 * m * v.squaredNorm();
    sum.potential += four_gauss_weight[q] * l * p.weight[element] * r[2];
    sum.momentum += m * v;
    sum.angular_momentum += m * r.cross(v);
  }
  const bool bar = model.lines[line].family == Family::bar;
  for (int q = 0; q < 3; ++q) {
    const double strain = e.q.slope(0.5 * q).norm() - 1.0;
    const double weight = bar ? (q == 1 ? 1.0 : 0.0) : (q == 1 ? HermiteShape::middle_weight : HermiteShape::end_weight);
    sum.axial += 0.5 * p.EA[element] * l * weight * strain * strain;
    if (model.lines[line].family != Family::beam) continue;
    const double kappa = material_curvature(e, 0.5 + gauss_eta[q]);
    sum.bending += 0.5 * p.EI[element] * l * gauss_weight[q] * kappa * kappa;
  }
  sum.bed += seabed_energy(model, state, line, element);
}

}  // namespace

Energies observe_energies(const Model& model, const State& state) {
  Energies sum;
  for (std::size_t i = 0; i < model.lines.size(); ++i)
    for (int k = 0; k < model.lines[i].elements; ++k) add_element_energies(model, state, static_cast<int>(i), model.lines[i].first_element + k, sum);
  for (const Body& b : model.bodies) {
    const std::size_t d = model.dof(b.line, b.node);
    const Eigen::Map<const Vec3> r(&state.q[d]), v(&state.v[d]);
    sum.kinetic += 0.5 * b.mass * v.squaredNorm();
    sum.potential += b.wet_weight * r[2];
    sum.bed += seabed_energy(model, state, b);
    sum.momentum += b.mass * v;
    sum.angular_momentum += b.mass * Vec3(r).cross(Vec3(v));
  }
  return sum;
}

}  // namespace hawser
