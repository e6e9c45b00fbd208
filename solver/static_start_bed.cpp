#include "solver/static_start_bed.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "assembly/arc.hpp"
#include "assembly/bracketed_root.hpp"
#include "assembly/seabed_build.hpp"
#include "solver/static_start_catenary.hpp"
#include "solver/static_start_loads.hpp"

namespace hawser {
namespace {

constexpr int scans = 4;   // of a segment, for the first place where the rise reaches the height
constexpr int passes = 3;  // over the level of the bed at the touchdowns
constexpr double fine = 1e-13;
constexpr double smallest_pull = 1e-3;  // H of a slack line, of the weight of an element (of the bending length)

/// Elements from the far end of the line to one of its held ends, neighbours of equal EA and load joined. x forward, z up.
class Side {
 public:
  Side(const Model& model, const Line& line, const LineLoads& loads, bool to_end) {
    for (int k = 0; k < line.elements; ++k) {
      const int i = to_end ? k : line.elements - 1 - k, e = line.first_element + i;
      const Vec3 load(0.0, 0.0, loads.density[i].z()), point(0.0, 0.0, loads.point[to_end ? i : i + 1].z());
      const bool same = k > 0 && list_.back().EA == model.element.EA[e] && list_.back().load == load && point.isZero(0.0);
      if (k > 0) list_.back().point = point;
      if (!same) list_.push_back({0.0, model.element.EA[e], load, Vec3::Zero()});
      list_.back().length += model.element.length[e];
    }
  }

  /// From the touchdown, at the distance a from the end, to the distance b: place and force there.
  struct Place {
    Vec3 r = Vec3::Zero(), F = Vec3::Zero();
    double EA = 0.0;
  };
  Place place(double H, double a, double b) const {
    double length = 0.0;
    for (const CatenarySegment& segment : list_) length += segment.length;
    Place p;
    p.F = H * Vec3::UnitX();
    double left = length;  // distance from the start of the segment to the end
    for (const CatenarySegment& segment : list_) {
      const double first = std::max(left - a, 0.0), last = std::min(left - b, segment.length);
      p.EA = segment.EA;
      if (last > first) {
        p.r += catenary_span(segment, p.F, last - first);
        p.F -= (last - first) * segment.load;
      }
      left -= segment.length;
      if (left <= b) break;
      if (left < a) p.F -= segment.point;
    }
    return p;
  }

  /// The suspended length that rises by h; the whole length where none does.
  double suspended(double H, double h) const {
    if (h <= 0.0) return 0.0;
    const auto rise = [&](double a) { return place(H, a, 0.0).r.z() - h; };
    double before = 0.0, below = -h, reach = 0.0;
    for (auto segment = list_.rbegin(); segment != list_.rend(); ++segment)
      for (int k = 0; k < scans; ++k) {
        reach += segment->length / scans;
        const double here = rise(reach);
        if (here >= 0.0) return bracketed_root(rise, before, reach, below, here, fine * reach);
        before = reach;
        below = here;
      }
    return reach;
  }

 private:
  std::vector<CatenarySegment> list_;
};

class LaidLine {
 public:
  LaidLine(const Model& model, int index, const Vec3& from, const Vec3& to)
      : model_(model),
        line_(model.lines[index]),
        loads_(dry_loads(model, index, 0.5 * (from.z() + to.z()))),
        sides_{Side(model, line_, loads_, false), Side(model, line_, loads_, true)},
        ends_{from, to},
        held_{!line_.from_free, !line_.to_free} {
    forward_ = to - from;
    forward_.z() = 0.0;
    X_ = forward_.norm();
    forward_ = X_ > 1e-9 * line_.length ? Vec3(forward_ / X_) : Vec3::UnitX();
    const double w = -loads_.total(model, line_).z() / line_.length;
    double softest = 0.0;
    for (int e = line_.first_element; e < line_.first_element + line_.elements; ++e)
      softest = std::max({softest, model.element.length[e], std::cbrt(model.element.EI[e] / std::max(w, 1e-300))});
    least_H_ = smallest_pull * w * softest;
    const Seabed& bed = *model.seabed;
    rub_ = bed.law.friction_axial * w;
    lower_ = height_above(bed.surface, from) <= height_above(bed.surface, to) ? 0 : 1;
    if (!held_[lower_]) lower_ = 1 - lower_;
    if (bed.laid[index] != Laid::nowhere) {
      lower_ = bed.laid[index] == Laid::from_start ? 0 : 1;
    }
    // A line that ends where others meet was laid towards a guess of that point: it starts straight towards where the point is now.
    if (bed.laid[index] != Laid::nowhere && line_.from_hub < 0 && line_.to_hub < 0) {
      for (int i = 0; i < line_.nodes; ++i) way_.push_back((bed.lay[line_.first_node + i] - ends_[0]).dot(forward_));
      const Vec3 first = bed.lay_slope[line_.first_node + (lower_ == 0 ? 0 : line_.nodes - 1)];
      bent_ = first.head<2>().normalized().dot(forward_.head<2>()) < 1.0 - 1e-9;
    }
    bed_EA_ = model.element.EA[lower_ == 0 ? line_.first_element : line_.first_element + line_.elements - 1];
  }

  std::optional<LineShape> shape() {
    if (!(least_H_ > 0.0)) return std::nullopt;
    for (int end = 0; end < 2; ++end) level_[end] = bed_at(ends_[end]);
    for (int pass = 0; pass < passes; ++pass) {
      if (!balance()) return std::nullopt;
      if (model_.seabed->surface.level()) break;
      level_[0] = bed_at(ends_[0] + x_[0] * forward_);
      level_[1] = bed_at(ends_[1] - x_[1] * forward_);
    }
    return written();
  }

 private:
  double bed_at(const Vec3& r) const { return model_.seabed->surface.height(r.x(), r.y()); }
  /// (-p, -q, 1)/(1 + p^2 + q^2): moving against it deepens the vertical penetration by as much.
  Vec3 normal_at(const Vec3& r) const {
    const SurfacePoint<double> bed = model_.seabed->surface.at(r.x(), r.y());
    const Vec3 e(-bed.slope[0], -bed.slope[1], 1.0);
    return e / e.squaredNorm();
  }
  double on_bed() const { return line_.length - a_[0] - a_[1]; }

  /// Suspended lengths and spans for this H; the span of the whole line less X, or "too far" where no part is left on the bed.
  double excess(double H) {
    H_ = H;
    for (int end = 0; end < 2; ++end) {
      a_[end] = held_[end] ? sides_[end].suspended(H, ends_[end].z() - level_[end]) : 0.0;
      x_[end] = sides_[end].place(H, a_[end], 0.0).r.x();
    }
    if (on_bed() <= 0.0 || bent_) return line_.length;
    return x_[0] + x_[1] + way(line_.length - a_[1]) - way(a_[0]) + stretch(line_.length - a_[1]) - X_;
  }

  /// Plan distance along the way to arc length s: on the bed where the line was laid on it, else s itself.
  double way(double s) const {
    if (way_.empty()) return s;
    const int i = std::clamp(static_cast<int>(std::upper_bound(line_.s.begin(), line_.s.end(), s) - line_.s.begin()) - 1, 0, line_.elements - 1);
    return way_[i] + (s - line_.s[i]) / (line_.s[i + 1] - line_.s[i]) * (way_[i + 1] - way_[i]);
  }

  /// Tension on the bed at arc length s: it falls from the touchdown that pulls, the one away from the lower end.
  double bed_tension(double s) const { return std::max(0.0, H_ - rub_ * std::abs(s - pulled_at())); }
  double pulled_at() const { return lower_ == 0 ? line_.length - a_[1] : a_[0]; }

  /// How much the bed part before s is longer than unstretched: the integral of the tension over EA.
  double stretch(double s) const {
    const auto integral = [&](double d) {
      const double m = rub_ > 0.0 ? std::min(d, H_ / rub_) : d;
      return m * (H_ - 0.5 * rub_ * m) / bed_EA_;
    };
    return lower_ == 0 ? integral(pulled_at() - a_[0]) - integral(pulled_at() - s) : integral(s - pulled_at());
  }

  bool balance() {
    const double slack = excess(least_H_);
    if (!held_[0] || !held_[1] || slack >= 0.0) return on_bed() > 0.0;
    double low = std::log(least_H_), below = slack, high = low, above = slack;
    for (int i = 0; i < 60 && above < 0.0; ++i) {
      low = high, below = above;
      high += 2.0;
      above = excess(std::exp(high));
    }
    if (above < 0.0) return false;
    excess(std::exp(bracketed_root([&](double x) { return excess(std::exp(x)); }, low, high, below, above, fine)));
    return on_bed() > 0.0;
  }

  LineShape written() const {
    LineShape shape(line_.nodes);
    const double room = held_[0] && held_[1] ? X_ - x_[0] - x_[1] : on_bed();
    const Arc arc(on_bed(), room);
    const Vec3 start = held_[0] ? Vec3(ends_[0] + x_[0] * forward_) : Vec3(ends_[1] - (x_[1] + on_bed()) * forward_);
    const Vec3 sideways = Vec3::UnitZ().cross(forward_);
    for (int i = 0; i < line_.nodes; ++i) {
      const double s = line_.s[i], before_end = line_.length - s;
      if (s < a_[0])
        suspended(0, s, shape, i);
      else if (before_end < a_[1])
        suspended(1, before_end, shape, i);
      else
        on_the_bed(arc, start, sideways, s, shape, i);
    }
    return shape;
  }

  void suspended(int end, double b, LineShape& shape, int i) const {
    const Side::Place top = sides_[end].place(H_, a_[end], 0.0), here = sides_[end].place(H_, a_[end], b);
    const double sign = end == 1 ? 1.0 : -1.0;
    const auto turned = [&](const Vec3& r) -> Vec3 { return sign * r.x() * forward_ + r.z() * Vec3::UnitZ(); };
    shape.r[i] = ends_[end] + turned(here.r - top.r);
    shape.left[i] = shape.right[i] = sign * turned(catenary_slope(here.EA, here.F));
  }

  void on_the_bed(const Arc& arc, const Vec3& start, const Vec3& sideways, double s, LineShape& shape, int i) const {
    const int e = line_.first_element + std::min(i, line_.elements - 1);
    const double lambda = 1.0 + bed_tension(s) / model_.element.EA[e];
    const double depth = std::max(model_.element.weight[e], 0.0) / model_.seabed->law.stiffness;
    if (!way_.empty()) {
      const int node = line_.first_node + i;
      const Vec3& t = model_.seabed->lay_slope[node];
      const double moved = lower_ == 0 ? stretch(s) : stretch(s) - stretch(line_.length);
      shape.r[i] = model_.seabed->lay[node] + moved * t;
      shape.r[i] -= depth * normal_at(shape.r[i]);
      shape.left[i] = shape.right[i] = lambda * t;
      return;
    }
    const double along = s - a_[0];
    const Eigen::Vector2d at = arc.at(along), t = arc.direction(along);
    const Vec3 r = start + (at[0] + (arc.straight() ? stretch(s) : 0.0)) * forward_ + at[1] * sideways;
    const SurfacePoint<double> bed = model_.seabed->surface.at(r.x(), r.y());
    Vec3 direction = t[0] * forward_ + t[1] * sideways;
    direction.z() = bed.slope[0] * direction.x() + bed.slope[1] * direction.y();
    shape.r[i] = Vec3(r.x(), r.y(), bed.height - depth);
    shape.left[i] = shape.right[i] = lambda * direction.normalized();
  }

  const Model& model_;
  const Line& line_;
  LineLoads loads_;
  Side sides_[2];  // towards the `from` and the `to` end
  Vec3 ends_[2];
  bool held_[2];
  Vec3 forward_;
  double X_ = 0.0, least_H_ = 0.0;
  double rub_ = 0.0, bed_EA_ = 0.0;  // N/m, friction on the bed; N
  std::vector<double> way_;          // m, plan distance of the nodes along the way; empty where the line has no end on the bed
  bool bent_ = false;                // it is laid in an arc: slack
  int lower_ = 0;                    // the end nearer to the bed
  double level_[2] = {0.0, 0.0};     // m, of the bed at the touchdowns
  double H_ = 0.0, a_[2] = {0.0, 0.0}, x_[2] = {0.0, 0.0};
};

}  // namespace

std::optional<LineShape> laid_shape(const Model& model, int line, const Vec3& from, const Vec3& to) {
  return LaidLine(model, line, from, to).shape();
}

bool reaches_bed(const Model& model, const LineShape& shape) {
  if (!model.seabed) return false;
  return std::any_of(shape.r.begin() + 1, shape.r.end() - 1, [&](const Vec3& r) { return r.z() < model.seabed->surface.height(r.x(), r.y()); });
}

void lift_onto_bed(const Model& model, LineShape& shape) {
  for (std::size_t i = 0; i < shape.r.size(); ++i) {
    Vec3& r = shape.r[i];
    const SurfacePoint<double> bed = model.seabed->surface.at(r.x(), r.y());
    if (r.z() >= bed.height) continue;
    r.z() = bed.height;
    for (Vec3* slope : {&shape.left[i], &shape.right[i]}) {
      Vec3 along = *slope;
      along.z() = bed.slope[0] * along.x() + bed.slope[1] * along.y();
      if (!along.isZero(0.0)) *slope = slope->norm() * along.normalized();
    }
  }
}

}  // namespace hawser
