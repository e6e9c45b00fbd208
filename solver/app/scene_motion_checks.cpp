#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "assembly/environment/time_function.hpp"
#include "assembly/seabed_build.hpp"
#include "solver/app/scene_checks.hpp"

namespace hawser {
namespace {

constexpr double straight_tolerance = 1e-6;  // of the length: chord of an unstrained start
constexpr double deep_below_bed = 1.0;       // m: no end of a line is meant to be there

class MotionCheck {
 public:
  MotionCheck(const Scene& scene, Document& document) : scene_(scene), document_(document), bed_(seabed_surface(scene.environment)) {}

  void run() {
    for (const LineSpec& line : scene_.lines) {
      const PointSpec *from = find_point(scene_, line.from), *to = find_point(scene_, line.to);
      if (from == nullptr || to == nullptr) continue;
      if (!from->free && !to->free) strain(line, *from, *to);
      if (scene_.dynamics && scene_.dynamics->start == StartChoice::straight) straight_start(line, *from, *to);
      if (bed_) seabed(line, *from, *to);
    }
    common_velocity();
    for (const PointSpec& point : scene_.points) {
      if (point.motion && scene_.dynamics) start_of_motion(point);
    }
  }

 private:
  void strain(const LineSpec& line, const PointSpec& from, const PointSpec& to) {
    const double chord = (place_at_start(to) - place_at_start(from)).norm(), length = length_of(line);
    if (!(chord / length - 1.0 > largest_strain)) return;
    document_.error({"lines", line.name, "sections"},
                    fmt::format("line `{}` is too short: it would have to stretch {:.0f} %", line.name, 100.0 * (chord / length - 1.0)),
                    fmt::format("{:g} m in all", length),
                    {fmt::format("its ends are {:g} m apart at t = 0; a line may stretch by at most 50 %", chord)});
  }

  void straight_start(const LineSpec& line, const PointSpec& from, const PointSpec& to) {
    const double chord = (place_at_start(to) - place_at_start(from)).norm(), length = length_of(line);
    const KeyPath place{"dynamics", "start"};
    if (chord == 0.0) {
      document_.error(place, fmt::format("a straight start of line `{}` has no direction: its ends are at one place", line.name));
    } else if (!(to.free && ends_at(to) == 1) && std::abs(chord - length) > straight_tolerance * length) {
      document_.error(
          place,
          fmt::format("a straight start of line `{}` needs a free `to` end of its own, or a length equal to the distance of its ends", line.name),
          fmt::format("length {:.9g} m, distance {:.9g} m", length, chord));
    }
  }

  long ends_at(const PointSpec& point) const {
    long ends = 0;
    for (const LineSpec& line : scene_.lines) ends += (line.from == point.name) + (line.to == point.name);
    return ends;
  }

  bool rests_on_bed(const PointSpec& end, double diameter, double length) const {
    return !end.free && height_above(*bed_, place_at_start(end)) <= grounding_height(diameter, length);
  }

  /// Ends far below the bed, and friction that has no grounded end to start from.
  void seabed(const LineSpec& line, const PointSpec& from, const PointSpec& to) {
    for (const PointSpec* end : {&from, &to}) {
      const double depth = end->free ? 0.0 : -height_above(*bed_, place_at_start(*end));
      if (depth > deep_below_bed) {
        document_.warn({"points", end->name}, fmt::format("point `{}` is {:.4g} m below the seabed", end->name, depth),
                       "the bed pushes the line up from there");
      }
    }
    const SeabedSpec& spec = scene_.environment.seabed;
    if (!(spec.friction_axial > 0.0 || spec.friction_lateral > 0.0) || line.sections.empty()) return;
    const LineType *first = find_line_type(scene_, line.sections.front().type), *last = find_line_type(scene_, line.sections.back().type);
    if (first == nullptr || last == nullptr) return;
    const double length = length_of(line);
    if (rests_on_bed(from, first->diameter, length) || rests_on_bed(to, last->diameter, length)) return;
    document_.warn({"environment", "seabed", "friction"},
                   fmt::format("a static leaves out the friction of line `{}`: none of its ends is on the bed", line.name),
                   "acts from where a line was laid, and it is laid from an end on the bed");
  }

  /// Velocity with which a held point starts; empty where a file says it.
  static std::optional<Vec3> initial_velocity(const PointSpec& point) {
    if (!point.motion || point.motion->ramp > 0.0) return Vec3::Zero();
    if (point.motion->file) return std::nullopt;
    return point.motion->velocity;
  }

  bool used(const PointSpec& point) const {
    return std::any_of(scene_.lines.begin(), scene_.lines.end(),
                       [&](const LineSpec& line) { return line.from == point.name || line.to == point.name; });
  }

  /// One velocity for all held points is a steady tow; two without a ramp have no common steady state.
  void common_velocity() {
    const PointSpec* first = nullptr;
    for (const PointSpec& point : scene_.points) {
      const std::optional<Vec3> velocity = initial_velocity(point);
      if (point.free || !velocity || !velocity->allFinite() || !used(point)) continue;
      if (first == nullptr) first = &point;
      const Vec3 other = *initial_velocity(*first);
      if (other == *velocity) continue;
      const PointSpec& moving = velocity->isZero(0.0) ? *first : point;
      document_.error({"points", moving.name, "motion", "velocity"},
                      fmt::format("points `{}` and `{}` have different velocities at t = 0", first->name, point.name), "no common steady state",
                      {"give the motion a `ramp` to start it from rest, or give all held points the same velocity"});
      return;
    }
  }

  void start_of_motion(const PointSpec& point) {
    const MotionSpec& motion = *point.motion;
    const KeyPath place{"points", point.name, "motion"};
    const double duration = scene_.dynamics->duration;
    if (motion.file && (motion.file->time.front() > 0.0 || motion.file->time.back() < duration)) {
      document_.warn(place, fmt::format("the motion of point `{}` does not cover the whole run of {:g} s", point.name, duration),
                     fmt::format("rows from {:g} s to {:g} s", motion.file->time.front(), motion.file->time.back()),
                     {"the point rests outside the rows of its file"});
    }
    if (!motion.file && motion.ramp == 0.0 && !motion.harmonics.empty()) {
      document_.warn(place, fmt::format("the motion of point `{}` starts with a jump of velocity", point.name), "has no `ramp`",
                     {"the run starts from rest; a ramp of a period or more avoids a shock"});
    }
  }

  const Scene& scene_;
  Document& document_;
  std::optional<SeabedSurface> bed_;
};

}  // namespace

Vec3 place_at_start(const PointSpec& point) { return Motion(point.position, point.motion)(0.0).r; }

void check_motion(const Scene& scene, Document& document) { MotionCheck(scene, document).run(); }

}  // namespace hawser
