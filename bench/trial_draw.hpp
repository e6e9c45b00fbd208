// Random numbers and parts of a scene for the trial of statics (trial.hpp).
//
// Scene n of a seed is always the same: its numbers come from a generator of its own, seeded with (seed, n), by arithmetic alone.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "assembly/environment/seabed_surface.hpp"
#include "assembly/scene.hpp"
#include "bench/trial.hpp"

namespace hawser::bench {

class TrialDraw {
 public:
  TrialDraw(std::uint64_t seed, std::uint64_t number) {
    std::seed_seq sequence{seed, seed >> 32, number, number >> 32};
    random_.seed(sequence);
  }

 protected:
  // ---- numbers
  double uniform(double a, double b) { return a + (b - a) * static_cast<double>(random_() >> 11) * 0x1.0p-53; }
  double log_uniform(double a, double b) { return a * std::pow(b / a, uniform(0.0, 1.0)); }
  bool chance(double p) { return uniform(0.0, 1.0) < p; }
  int whole(int a, int b) { return a + static_cast<int>(uniform(0.0, 1.0) * (b - a + 1)); }
  Vec3 plan() {
    const double heading = uniform(0.0, 2.0 * std::numbers::pi);
    return {std::cos(heading), std::sin(heading), 0.0};
  }
  Vec3 direction(double steepest) {
    const double up = uniform(-steepest, steepest);
    return std::cos(up) * plan() + std::sin(up) * Vec3::UnitZ();
  }

  // ---- parts of a scene
  LineSpec& line() { return trial_.scene.lines.back(); }
  LineType& type() { return trial_.scene.line_types.front(); }

  /// Names the kind and draws length, weight and mesh; ends and the rest follow.
  void begin(const char* kind, double longest = 5000.0) {
    trial_.kind = kind;
    length_ = log_uniform(10.0, longest);
    weight_ = log_uniform(0.5, 3000.0);
    elements_ = whole(20, 200);
    LineType& t = trial_.scene.line_types.emplace_back();
    t.name = "cable";
    t.diameter = log_uniform(0.005, 0.5);
    t.mass = weight_ / 9.8 * uniform(1.1, 3.0);
    t.wet_weight = weight_;
    LineSpec& l = trial_.scene.lines.emplace_back();
    l.name = "line";
    l.from = "from";
    l.to = "to";
    SectionSpec& section = l.sections.emplace_back();
    section.type = "cable";
    section.length = length_;
    section.elements = elements_;
    stretches(weight_ * length_);
  }

  /// EA from 1e4 to 1e11 N, so that this load strains by less than a third.
  void stretches(double load) {
    for (LineType& t : trial_.scene.line_types) t.EA = std::clamp(t.EA, log_uniform(std::max(1.0e4, 3.0 * load), 1.0e11), 1.0e11);
  }

  /// EI between these shares of w L^3; the radius of gyration stays below 0.3 m.
  void bends(double least, double most) {
    const double share = log_uniform(least, most);
    for (LineType& t : trial_.scene.line_types) t.EI = std::min(share * weight_ * std::pow(length_, 3), 0.09 * t.EA);
  }
  void may_bend() {
    if (chance(0.5)) bends(1e-9, 1e-3);
  }

  PointSpec& point(const char* name, const Vec3& position, bool free = false) {
    PointSpec& p = trial_.scene.points.emplace_back();
    p.name = name;
    p.position = position;
    p.free = free;
    return p;
  }
  /// Ends at -depth or above (up: the `to` end is the higher one, as often as not).
  void ends(const Vec3& from, const Vec3& to) {
    const bool turned = chance(0.5);
    point("from", turned ? to : from);
    point("to", turned ? from : to);
  }
  void span(const Vec3& direction, double chord) { ends({0.0, 0.0, -1500.0}, Vec3(0.0, 0.0, -1500.0) + chord * direction); }
  double slack_chord() { return length_ * (1.0 - std::pow(10.0, uniform(-4.0, -0.05))); }

  void clamp(EndSpec& end, const Vec3& direction) { end = {true, direction}; }

  /// Up to `most` clumps, floats and point forces, and often a force over a short length.
  void loads(int most) {
    const double share = 0.5 * weight_ * length_ / most;
    for (int n = whole(1, most); n > 0; --n) {
      LoadSpec& load = line().loads.emplace_back();
      load.at = uniform(0.05, 0.95) * length_;
      load.body.wet_weight = (chance(0.6) ? 1.0 : -1.0) * share * log_uniform(0.01, 1.0);
      load.body.mass = std::abs(*load.body.wet_weight) / 9.8;
      if (chance(0.3)) load.body.force.constant = share * uniform(0.0, 0.5) * direction(1.5);
    }
    if (!chance(0.5)) return;
    LoadSpec& spread = line().loads.emplace_back();
    spread.over = length_ * log_uniform(1e-3, 0.1);
    spread.at = uniform(0.1, 0.9) * length_;
    spread.body.force.constant = share * uniform(0.1, 1.0) * direction(1.5);
  }

  /// Cuts the line into two to five sections; `lightest` of the weight of the first type is the least of the others.
  void sections(double lightest) {
    const int count = whole(2, 5);
    const LineType first = type();
    for (int k = 1; k < count; ++k) {
      LineType& t = trial_.scene.line_types.emplace_back(first);
      t.name = "cable" + std::to_string(k);
      t.wet_weight = weight_ * uniform(lightest, 2.0);
      t.EA = std::min(first.EA * log_uniform(1.0, 10.0), 1.0e11);
      t.diameter = first.diameter * uniform(0.5, 2.0);
    }
    share(std::vector<double>(count, 0.0), count);
  }
  void share(std::vector<double> part, int count) {
    double sum = 0.0;
    for (double& p : part) sum += p = p > 0.0 ? p : uniform(0.2, 1.0);
    line().sections.clear();
    for (int k = 0; k < count; ++k) {
      SectionSpec& section = line().sections.emplace_back();
      section.type = k == 0 ? "cable" : "cable" + std::to_string(k);
      section.length = length_ * part[k] / sum;
      section.elements = std::max(4, static_cast<int>(elements_ * part[k] / sum));
    }
  }

  /// A current that is sheared and may turn with depth; its drag across the line is up to ten times the weight, the ratio that it returns.
  double flow(double top, double bottom, bool turns) {
    LineType& t = type();
    for (LineType& other : trial_.scene.line_types) {
      other.drag_normal = uniform(0.8, 1.6);
      other.drag_tangential = chance(0.7) ? uniform(0.0, 0.05) : 0.0;
    }
    const double ratio = log_uniform(0.01, 10.0);
    const double speed = std::min(6.0, std::sqrt(2.0 * ratio * weight_ / (1025.0 * t.drag_normal * t.diameter)));
    const int rows = whole(1, 4);
    double heading = uniform(0.0, 2.0 * std::numbers::pi);
    for (int k = 0; k < rows; ++k) {
      const double part = k == 0 ? 1.0 : uniform(0.0, 1.0);
      trial_.scene.environment.current.push_back({top + (bottom - top) * k / std::max(1, rows - 1), part * speed, heading});
      if (turns) heading += uniform(-1.5, 1.5);
    }
    stretches(weight_ * length_ * (1.0 + ratio));
    return ratio;
  }

  /// A level bed, or a slope, or bumps; returns its height at the origin. Sinks by 1 mm to 0.1 m under the line.
  void bed(double depth, bool rubs) {
    trial_.scene.environment.depth = depth;
    SeabedSpec& seabed = trial_.scene.environment.seabed;
    seabed.stiffness = weight_ / log_uniform(1e-3, 0.1);
    if (!rubs) return;
    seabed.friction_axial = uniform(0.1, 1.2);
    seabed.friction_lateral = chance(0.5) ? seabed.friction_axial : uniform(0.1, 1.2);
    seabed.slip = log_uniform(1e-4, 1e-2);
  }
  void bumps(double depth, double reach) {
    BathymetryGrid grid;
    const int n = chance(0.4) ? 2 : whole(3, 8);
    const double slope_x = uniform(-0.1, 0.1), slope_y = uniform(-0.1, 0.1), height = n == 2 ? 0.0 : 0.03 * reach / n;
    for (int i = 0; i < n; ++i) {
      grid.x.push_back(reach * (2.0 * i / (n - 1) - 1.0));
      grid.y.push_back(grid.x.back());
    }
    for (double y : grid.y)
      for (double x : grid.x) grid.z.push_back(-depth + slope_x * x + slope_y * y + uniform(-1.0, 1.0) * height);
    trial_.scene.environment.depth.reset();
    trial_.scene.environment.seabed.bathymetry = grid;
    for (PointSpec& p : trial_.scene.points)
      p.position.z() = std::max(p.position.z(), SeabedSurface(grid).height(p.position.x(), p.position.y()) + (p.position.z() <= -depth ? 0.0 : 1.0));
  }
  std::mt19937_64 random_;
  Trial trial_;
  double length_ = 0.0, weight_ = 0.0;  // m, N/m of the first type
  int elements_ = 0;
};

}  // namespace hawser::bench
