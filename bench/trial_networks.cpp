// Random scenes of lines that meet at free points for the public trial of statics (README.md, "The trial of statics").
// The kind goes round with the number of the scene. Every scene has an equilibrium; the loads strain a line by less than a third.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "bench/trial_draw.hpp"

namespace hawser::bench {
namespace {

class TrialNetworks : private TrialDraw {
 public:
  using TrialDraw::TrialDraw;

  Trial draw(std::uint64_t number) {
    constexpr std::array<void (TrialNetworks::*)(), network_kinds> kind{
        &TrialNetworks::equal_legs,    &TrialNetworks::legs,         &TrialNetworks::legs_in_a_current,
        &TrialNetworks::moored_buoy,   &TrialNetworks::buoy_current, &TrialNetworks::two_buoys,
        &TrialNetworks::anchor_bridle, &TrialNetworks::towed_bridle, &TrialNetworks::row,
        &TrialNetworks::ring,          &TrialNetworks::grid,         &TrialNetworks::tree,
        &TrialNetworks::pipes,         &TrialNetworks::any_network};
    (this->*kind[number % network_kinds])();
    stretches(load_);
    return std::move(trial_);
  }

 private:
  // ---- parts
  void begin_network(const char* kind, double longest = 5000.0) {
    begin(kind, longest);
    trial_.scene.lines.clear();
    elements_ = whole(8, 80);
  }

  std::string held(const Vec3& position) { return point(next_name('a').c_str(), position).name; }

  /// A free point; its position is a guess.
  std::string hub(const Vec3& position, double wet_weight = 0.0) {
    PointSpec& p = point(next_name('h').c_str(), position, true);
    p.body.wet_weight = wet_weight;
    p.body.mass = std::abs(wet_weight) / 5.0;
    if (wet_weight != 0.0) p.body.drag_area = log_uniform(0.01, 3.0);
    load_ += std::abs(wet_weight);
    return p.name;
  }
  void pull(PointSpec& p, const Vec3& direction) { p.body.force.constant = load_ * uniform(0.0, 0.3) * direction; }
  std::string next_name(char letter) const { return letter + std::to_string(trial_.scene.points.size()); }

  void leg(const std::string& from, const std::string& to, double length) {
    LineSpec& l = trial_.scene.lines.emplace_back();
    l.name = "line" + std::to_string(trial_.scene.lines.size());
    const bool turned = chance(0.5);
    l.from = turned ? to : from;
    l.to = turned ? from : to;
    l.sections = {{type().name, {}, length, elements_}};
    load_ += weight_ * length;
  }
  Vec3 at(const std::string& name) const {
    return std::find_if(trial_.scene.points.begin(), trial_.scene.points.end(), [&](const PointSpec& p) { return p.name == name; })->position;
  }
  /// From a part in a thousand longer than this distance to three times as long.
  double slack(double distance) { return distance * (1.0 + std::pow(10.0, uniform(-3.0, 0.3))); }
  void join(const std::string& a, const std::string& b) {
    const double distance = (at(a) - at(b)).norm();
    leg(a, b, chance(0.8) ? slack(distance) : distance * uniform(0.7, 1.0));
  }

  // Every number is drawn in a statement (or braces) of its own: the order of a function's arguments is the compiler's.
  Vec3 somewhere(double least, double most, double steepest = 1.5) {
    const Vec3 d = direction(steepest);
    return length_ * uniform(least, most) * d;
  }
  double weight_share(double least, double most) { return weight_ * length_ * uniform(least, most); }
  Vec3 around(double heading, double radius, double z) const { return {radius * std::cos(heading), radius * std::sin(heading), z}; }
  /// One of `count` anchors around the origin, no two of them near each other in plan.
  std::string anchor_around(int k, int count, double least, double most, double rise) {
    const double heading = turn(k, count) + uniform(-0.4, 0.4), radius = length_ * uniform(least, most);
    return held(around(heading, radius, length_ * uniform(-rise, rise)));
  }
  double turn(int k, int count) const { return 2.0 * std::numbers::pi * k / count; }

  /// A clump or float on one line in three.
  void clumps() {
    for (LineSpec& l : trial_.scene.lines) {
      if (!chance(0.3)) continue;
      LoadSpec& load = l.loads.emplace_back();
      const double length = l.sections[0].length;
      load.at = uniform(0.1, 0.9) * length;
      load.body.wet_weight = (chance(0.6) ? 1.0 : -1.0) * weight_ * length * log_uniform(0.01, 0.5);
      load.body.mass = std::abs(*load.body.wet_weight) / 9.8;
      load_ += std::abs(*load.body.wet_weight);
    }
  }
  void in_a_current(double top, double bottom) { load_ *= 1.0 + flow(top, bottom, chance(0.5)); }

  // ---- kinds
  void equal_legs() {
    begin_network("equal legs");
    trial_.known = Known::equal_legs;
    const int count = whole(3, 8);
    const double radius = length_ * uniform(0.05, 1.05), weight = weight_ * length_ * count * log_uniform(1e-2, 3.0);
    const Vec3 guess = somewhere(0.0, 0.5);
    const std::string knot = hub(guess, chance(0.7) ? weight : -weight);
    const double first = uniform(0.0, 1.0);
    for (int k = 0; k < count; ++k) leg(held(around(turn(k, count) + first, radius, 0.0)), knot, length_);
  }

  void any_legs(const char* kind) {
    begin_network(kind);
    const int count = whole(2, 6);
    const Vec3 guess = somewhere(0.0, 0.4);
    const std::string knot = hub(guess, chance(0.5) ? 0.0 : weight_share(-1.0, 2.0));
    for (int k = 0; k < count; ++k) join(anchor_around(k, count, 0.2, 1.0, 0.3), knot);
  }

  void legs() {
    any_legs("legs of any length");
    trial_.known = Known::catenaries;
  }

  void legs_in_a_current() {
    any_legs("legs in a current");
    if (chance(0.3)) clumps();
    may_bend();
    in_a_current(0.5 * length_, -1.5 * length_);
  }

  /// A buoy over `count` anchors on the bed around `centre`, `depth` below the surface.
  std::string moor(const Vec3& centre, int count, double depth, double first, double opening) {
    const Vec3 guess = centre - uniform(0.1, 0.6) * depth * Vec3::UnitZ();
    const std::string buoy = hub(guess, -weight_ * length_ * count * log_uniform(0.05, 1.0));
    for (int k = 0; k < count; ++k) {
      const double heading = first + opening * (k + 0.5) / count + uniform(-0.2, 0.2);
      const std::string anchor = held(centre + around(heading, length_ * uniform(0.6, 1.0), -depth));
      leg(anchor, buoy, (at(anchor) - at(buoy)).norm() * (1.0 + std::pow(10.0, uniform(-3.0, -0.5))));
    }
    return buoy;
  }

  void buoy(const char* kind) {
    begin_network(kind);
    const double depth = length_ * uniform(0.05, 0.6);
    bed(depth, chance(0.5));
    const int count = whole(3, 8);
    moor(Vec3::Zero(), count, depth, uniform(0.0, 6.0), 2.0 * std::numbers::pi);
    if (chance(0.3)) bends(1e-9, 1e-4);
  }

  void moored_buoy() {
    buoy("moored buoy");
    if (chance(0.5)) pull(trial_.scene.points.front(), plan());
  }

  void buoy_current() {
    buoy("moored buoy in a current");
    in_a_current(0.0, -length_);
  }

  void two_buoys() {
    begin_network("two moored buoys joined by a line");
    const double depth = length_ * uniform(0.05, 0.6);
    bed(depth, chance(0.3));
    const double apart = length_ * uniform(0.1, 0.8), half = std::numbers::pi;
    const std::string one = moor(Vec3::Zero(), whole(2, 4), depth, 0.5 * half, half);
    const std::string other = moor(apart * Vec3::UnitX(), whole(2, 4), depth, -0.5 * half, half);
    leg(one, other, apart * uniform(0.95, 1.2));
    if (chance(0.3)) in_a_current(0.0, -length_);
  }

  /// Two or three anchors, a point where their lines meet on the bed or above it, and a line from there to the surface.
  void anchor_bridle() {
    begin_network("bridle of anchors");
    const double depth = length_ * uniform(0.05, 0.5), reach = length_ * uniform(0.1, 0.5);
    bed(depth, chance(0.3));
    const std::string knot = hub(Vec3(0.0, 0.0, -depth + (chance(0.5) ? 0.0 : 0.2 * depth)));
    const int count = whole(2, 3);
    for (int k = 0; k < count; ++k) {
      const std::string anchor = held(around(std::numbers::pi + 0.5 * (k - 0.5 * (count - 1)), reach, -depth));
      leg(anchor, knot, reach * uniform(0.99, 1.1));
    }
    const double across = std::sqrt(length_ * length_ - depth * depth);
    const std::string top = held(Vec3{across * uniform(0.8, 1.0), 0.2 * across * uniform(-1.0, 1.0), 0.0});
    leg(knot, top, length_);
    if (chance(0.3)) bends(1e-9, 1e-4);
  }

  void towed_bridle() {
    begin_network("towed bridle");
    LineType& t = type();
    t.drag_normal = uniform(0.8, 1.6);
    t.drag_tangential = uniform(0.005, 0.05);
    const double arm = length_ * uniform(0.05, 0.5), speed = uniform(0.2, 4.0);
    const Vec3 along = plan(), across = Vec3::UnitZ().cross(along);
    const std::string port = held(arm * uniform(0.1, 0.9) * across);
    const std::string starboard = held(-arm * uniform(0.1, 0.9) * across);
    for (PointSpec& p : trial_.scene.points) p.motion.emplace().velocity = speed * along;
    const Vec3 guess = arm * direction(1.5);
    const std::string knot = hub(guess, chance(0.3) ? weight_ * arm * uniform(0.0, 1.0) : 0.0);
    leg(port, knot, arm * uniform(0.9, 1.0));
    leg(starboard, knot, arm * uniform(0.9, 1.0));
    const std::string fish = hub(-length_ * along, weight_ * length_ * log_uniform(1e-3, 1.0));
    leg(knot, fish, length_);
    if (chance(0.3)) {
      const std::string bird = hub(-length_ * along, weight_ * length_ * log_uniform(1e-3, 1.0));
      leg(knot, bird, length_ * uniform(0.3, 1.0));
    }
    may_bend();
    load_ += 0.5 * 1025.0 * 1.6 * t.diameter * speed * speed * 3.0 * length_;
  }

  void row() {
    begin_network("row of floats and clumps");
    const int count = whole(2, 10);
    const double part = length_ / (count + 1), heaviest = weight_ * part * log_uniform(0.1, 10.0);
    const Vec3 along = direction(0.5);
    std::string before = held(Vec3::Zero());
    for (int k = 1; k <= count; ++k) {
      const Vec3 place = part * k * along;
      const Vec3 guess = place + 0.3 * part * direction(1.5);
      const std::string here = hub(guess, heaviest * uniform(-0.5, 1.0));
      leg(before, here, part * uniform(0.95, 1.5));
      if (chance(0.3)) {
        const std::string side = held(place + part * direction(0.5));
        leg(side, here, part * uniform(0.95, 1.5));
      }
      before = here;
    }
    leg(before, held(length_ * along), part * uniform(0.95, 1.5));
    if (chance(0.5)) may_bend();
    if (chance(0.5)) in_a_current(length_, -length_);
  }

  /// A line that begins and ends at a hub, and two lines between the same points.
  void ring() {
    begin_network("ring and doubled line");
    const int count = whole(2, 4);
    const Vec3 guess = somewhere(0.3, 0.3);
    const std::string knot = hub(guess, chance(0.5) ? 0.0 : weight_share(-1.0, 2.0));
    for (int k = 0; k < count; ++k) join(anchor_around(k, count, 0.3, 0.8, 0.2), knot);
    leg(knot, knot, length_ * uniform(0.1, 1.0));
    if (chance(0.5)) leg("a1", knot, slack((at("a1") - at(knot)).norm()));
    may_bend();
    if (chance(0.5)) in_a_current(0.5 * length_, -1.5 * length_);
  }

  /// A net hung at its corners, or at its edge.
  void grid() {
    begin_network("net");
    elements_ = whole(3, 10);
    const int nx = whole(3, 5), ny = whole(3, 5);
    const double mesh = length_ / nx, give = 1.0 + std::pow(10.0, uniform(-3.0, -0.5));
    const bool edge = chance(0.5);
    const double tilt = uniform(-1.0, 1.0);
    std::vector<std::string> names;
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) {
        const bool x_end = i == 0 || i == nx - 1, y_end = j == 0 || j == ny - 1;
        const Vec3 place(mesh * i, mesh * j * std::cos(tilt), mesh * j * std::sin(tilt));
        names.push_back((edge ? x_end || y_end : x_end && y_end) ? held(place) : hub(place, chance(0.3) ? weight_ * mesh * uniform(0.0, 3.0) : 0.0));
      }
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) {
        if (i + 1 < nx) leg(names[j * nx + i], names[j * nx + i + 1], mesh * give * uniform(1.0, 1.05));
        if (j + 1 < ny) leg(names[j * nx + i], names[(j + 1) * nx + i], mesh * give * uniform(1.0, 1.05));
      }
    if (chance(0.5)) in_a_current(length_, -length_);
  }

  /// Branches of branches, with bodies at the tips, hung from one or two points in a current.
  void tree() {
    begin_network("tree in a current");
    const std::string root = hub(somewhere(0.5, 0.5));
    for (int k = whole(1, 2); k > 0; --k) {
      const std::string top = held(0.3 * length_ * plan());
      leg(top, root, length_ * uniform(0.5, 1.0));
    }
    for (int k = whole(2, 3); k > 0; --k) {
      const std::string branch = hub(somewhere(1.0, 1.0));
      leg(root, branch, length_ * uniform(0.1, 0.6));
      for (int left = whole(1, 3); left > 0; --left) {
        const Vec3 guess = somewhere(1.0, 1.0);
        const std::string tip = hub(guess, weight_ * length_ * log_uniform(1e-2, 1.0));
        leg(branch, tip, length_ * uniform(0.1, 0.6));
      }
    }
    may_bend();
    in_a_current(0.0, -2.0 * length_);
  }

  void pipes() {
    begin_network("pipes, clamped where they are held");
    bends(1e-6, 1.0);
    const int count = whole(2, 4);
    const Vec3 guess = somewhere(0.1, 0.1);
    const std::string knot = hub(guess, chance(0.5) ? 0.0 : weight_share(-0.5, 1.0));
    for (int k = 0; k < count; ++k) {
      const std::string end = anchor_around(k, count, 0.3, 0.8, 0.2);
      const Vec3 way = at(knot) - at(end);
      leg(end, knot, way.norm() * uniform(1.0, 1.3));
      const bool from = line().from == end;
      if (chance(0.7)) clamp(from ? line().from_end : line().to_end, (from ? 1.0 : -1.0) * way.normalized() + 0.5 * direction(1.5));
    }
    if (chance(0.3)) in_a_current(0.5 * length_, -1.5 * length_);
  }

  /// Hubs joined to anchors and to one another as chance will, lines from taut to three times as long as the way.
  void any_network() {
    begin_network("any network");
    elements_ = whole(8, 30);
    const int count = whole(1, 6);
    std::vector<std::string> knots;
    for (int i = 0; i < count; ++i) {
      const Vec3 guess = somewhere(0.0, 0.7);
      knots.push_back(hub(guess, chance(0.5) ? 0.0 : weight_share(-1.0, 2.0)));
      for (int k = i == 0 ? 2 : whole(0, 2); k > 0; --k) join(held(somewhere(0.3, 1.0, 0.8)), knots[i]);
      if (i > 0) join(knots[i], knots[whole(0, i - 1)]);
    }
    for (int k = whole(0, count - 1); k > 0; --k) {
      const int a = whole(0, count - 1), b = whole(0, count - 1);
      if (a != b) join(knots[a], knots[b]);
    }
    if (chance(0.5)) clumps();
    may_bend();
    if (chance(0.5)) in_a_current(length_, -2.0 * length_);
  }

  double load_ = 0.0;  // N, of all lines and bodies
};

}  // namespace

Trial draw_network(std::uint64_t seed, std::uint64_t number) { return TrialNetworks(seed, number).draw(number); }

}  // namespace hawser::bench
