#include "solver/static_start_march.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/static_start_loads.hpp"

namespace hawser {
namespace {

constexpr int passes = 30;   // over the position of the free end
constexpr int substeps = 4;  // Runge-Kutta steps in an element

/// Integrates one line from its free end; positions relative to that end.
class March {
 public:
  March(const Model& model, int line) : model_(model), index_(line), line_(model.lines[line]), from_free_(line_.from_free), shape_(line_.nodes) {}

  /// Shape relative to the free end, which is at height z_free.
  const LineShape& run(double z_free) {
    const LineLoads loads = dry_loads(model_, index_, 0.0);
    G_.setZero();
    r_.setZero();
    z_free_ = z_free;
    for (int k = 0; k < line_.nodes; ++k) {
      const int node = from_free_ ? k : line_.nodes - 1 - k;
      if (k > 0) element(from_free_ ? node - 1 : node, loads);
      shape_.r[node] = r_;
      set_slope(node, k - 1, true);
      for (const Body& body : model_.bodies)
        if (body.line == index_ && body.node == node) G_ -= body_force(model_, body, z_free_ + r_.z());
      if (k == 0) direction_ = first_direction(loads);
      set_slope(node, k, false);
    }
    shape_.left.front() = shape_.right.front();
    shape_.right.back() = shape_.left.back();
    return shape_;
  }

 private:
  double EA(int k) const { return model_.element.EA[line_.first_element + (from_free_ ? k : line_.elements - 1 - k)]; }

  /// Slope at a node before (the element already passed) or after the loads of the node; k counts elements from the free end.
  void set_slope(int node, int k, bool before) {
    if (k < 0 || k >= line_.elements) return;
    const Vec3 slope = (1.0 + G_.norm() / EA(k)) * direction(G_) * (from_free_ ? 1.0 : -1.0);
    (before == from_free_ ? shape_.left : shape_.right)[node] = slope;
  }

  /// G/|G|, or the last known direction where the tension vanishes.
  Vec3 direction(const Vec3& G) const {
    const double T = G.norm();
    return T > 1e-9 * scale_ ? Vec3(G / T) : direction_;
  }

  Vec3 first_direction(const LineLoads& loads) {
    scale_ = std::max(load_scale(model_, index_), 1e-300);
    if (G_.norm() > 1e-9 * scale_) return G_.normalized();
    return bare_end_direction(from_free_ ? 0 : line_.elements - 1, loads);
  }

  /// The critical angle, by bisection: between the flow (angle 0) and the weight (90 degrees) the load across the line falls
  /// from the weight to minus the drag.
  Vec3 bare_end_direction(int e, const LineLoads& loads) const {
    const Vec3 flow = model_.current.at(z_free_) - model_.tow, along = flow.stableNormalized();
    const Vec3 weight = loads.density[e] - loads.density[e].dot(along) * along, down = weight.stableNormalized();
    if (weight.isZero(0.0)) return along.isZero(0.0) ? Vec3::UnitZ() : Vec3(-along);
    double low = 0.0, high = 0.5 * std::numbers::pi;
    for (int pass = 0; pass < 60; ++pass) {
      const double angle = 0.5 * (low + high);
      const Vec3 t = std::cos(angle) * along + std::sin(angle) * down, n = std::cos(angle) * down - std::sin(angle) * along;
      const Vec3 load = loads.density[e] + drag_density(model_, line_.first_element + e, t, z_free_);
      (load.dot(n) > 0.0 ? low : high) = angle;
    }
    return -(std::cos(high) * along + std::sin(high) * down);
  }

  void element(int e, const LineLoads& loads) {
    const int global = line_.first_element + e;
    const double h = model_.element.length[global] / substeps;
    const bool drags = model_.element.drag_normal[global] > 0.0 || model_.element.drag_tangential[global] > 0.0;
    struct Rate {
      Vec3 G, r;
    };
    const auto rate = [&](const Vec3& G, const Vec3& r) {
      const Vec3 t = direction(G);
      Vec3 load = loads.density[e];
      if (drags) load += drag_density(model_, global, t, z_free_ + r.z());
      return Rate{-load, (1.0 + G.norm() / model_.element.EA[global]) * t};
    };
    for (int i = 0; i < substeps; ++i) {
      const Rate a = rate(G_, r_), b = rate(G_ + 0.5 * h * a.G, r_ + 0.5 * h * a.r);
      const Rate c = rate(G_ + 0.5 * h * b.G, r_ + 0.5 * h * b.r), d = rate(G_ + h * c.G, r_ + h * c.r);
      G_ += h / 6.0 * (a.G + 2.0 * b.G + 2.0 * c.G + d.G);
      r_ += h / 6.0 * (a.r + 2.0 * b.r + 2.0 * c.r + d.r);
      direction_ = direction(G_);
    }
  }

  const Model& model_;
  int index_;
  const Line& line_;
  bool from_free_;
  LineShape shape_;
  Vec3 G_ = Vec3::Zero(), r_ = Vec3::Zero(), direction_ = Vec3::UnitZ();
  double z_free_ = 0.0, scale_ = 1.0;
};

}  // namespace

LineShape march_from_free_end(const Model& model, int line_index, const Vec3& held) {
  const Line& line = model.lines[line_index];
  March march(model, line_index);
  double z_free = held.z();
  LineShape shape(line.nodes);
  for (int pass = 0; pass < passes; ++pass) {
    shape = march.run(z_free);
    const double z_new = held.z() - (line.from_free ? shape.r.back() : shape.r.front()).z();
    const double change = std::abs(z_new - z_free);
    z_free = z_new;
    if (change <= 1e-9 * line.length) break;
  }
  const Vec3 shift = held - (line.from_free ? shape.r.back() : shape.r.front());
  for (Vec3& r : shape.r) r += shift;
  return shape;
}

}  // namespace hawser
