#include "assembly/seabed_build.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "assembly/arc.hpp"
#include "assembly/bracketed_root.hpp"
#include "assembly/mesh.hpp"

namespace hawser {
namespace {

constexpr double longest_way = 1.5;   // of an element in plan, of its length
constexpr double resolution = 1e-15;  // of its length
constexpr double least_sink = 0.1;    // of the diameter of a line (theory 5.4)

/// Where a line was laid from one end: in plan towards the other end, along an arc where it is longer than its way there and up.
class Lay {
 public:
  /// way: plan distance of the ends; laid: length that does not hang from the other end.
  Lay(const Vec3& start, const Vec3& direction, double way, double laid, bool from)
      : start_(start), direction_(direction), laid_(laid), arc_(laid, way), from_(from) {}

  bool from() const { return from_; }  // it starts at the `from` end
  Vec3 at(double s) const {
    if (arc_.straight()) return start_ + s * direction_;
    return start_ + in_plan(arc_.at(std::min(s, laid_)));
  }
  Vec3 direction_at(double s) const { return arc_.straight() ? direction_ : in_plan(arc_.direction(std::min(s, laid_))); }

 private:
  Vec3 in_plan(const Eigen::Vector2d& r) const { return r[0] * direction_ + r[1] * Vec3::UnitZ().cross(direction_); }

  Vec3 start_, direction_;
  double laid_;
  Arc arc_;
  bool from_;
};

/// A place of a line on the bed and its direction there, away from the start.
struct OnBed {
  Vec3 r, t;
};

OnBed on_bed(const SeabedSurface& surface, const Lay& lay, double s) {
  const Vec3 r = lay.at(s), t = lay.direction_at(s);
  const SurfacePoint<double> here = surface.at(r.x(), r.y());
  return {Vec3(r.x(), r.y(), here.height), Vec3(t.x(), t.y(), here.gradient[0] * t.x() + here.gradient[1] * t.y()).normalized()};
}

/// Strain in the middle of an element between two places whose slopes have unit length: there and at the nodes it is measured.
double strain(bool bar, double l, const OnBed& a, const OnBed& b) {
  const Vec3 chord = (b.r - a.r) / l;
  return (bar ? chord : Vec3(1.5 * chord - 0.25 * (a.t + b.t))).norm() - 1.0;
}

/// Nodes of a line as it was laid, and its direction there. Every element is unstrained as the mesh sees it: were it as long as its way over the bed,
/// bends that it cannot follow would compress it, and in a stiff line friction would hold that. s: plan distance along the way.
void lay_out(const Line& line, const Lay& lay, Seabed& bed) {
  double s = 0.0;
  OnBed last = on_bed(bed.surface, lay, s);
  for (int k = 0; k < line.nodes; ++k) {
    const int node = lay.from() ? k : line.nodes - 1 - k, before = lay.from() ? k - 1 : line.nodes - k;
    if (k > 0) {
      const double l = std::abs(line.s[node] - line.s[before]), reach = longest_way * l;
      const auto strain_at = [&](double ds) { return strain(line.family == Family::bar, l, last, on_bed(bed.surface, lay, s + ds)); };
      const double far = strain_at(reach);
      s += far > 0.0 ? bracketed_root(strain_at, 0.0, reach, strain_at(0.0), far, resolution * l) : l;  // the part that hangs is not laid
      last = on_bed(bed.surface, lay, s);
    }
    bed.lay[line.first_node + node] = last.r;
    bed.lay_slope[line.first_node + node] = (lay.from() ? 1.0 : -1.0) * last.t;
  }
}

/// The ends or nodes of lines that a body belongs to.
std::vector<Support> places_of(const Model& model, const Body& body) {
  for (const Hub& hub : model.hubs)
    if (hub.ends.front().line == body.line && hub.ends.front().node == body.node) return hub.ends;
  return {Support{body.line, body.node, -1}};
}

/// What presses a unit length of the line around a body into the bed, or would where the line weighs nothing: max(w, N(d/10)).
double pressure_around(const Model& model, const std::vector<Support>& places) {
  double weight = 0.0, diameter = 0.0;
  for (const Support& place : places) {
    const Line& line = model.lines[place.line];
    for (int i = std::max(0, place.node - 1); i <= std::min(place.node, line.elements - 1); ++i) {
      weight = std::max(weight, model.element.weight[line.first_element + i]);
      diameter = std::max(diameter, model.element.diameter[line.first_element + i]);
    }
  }
  return std::max(weight, contact_pressure(model.seabed->law, least_sink * diameter));
}

std::optional<Vec3> laid_place(const Model& model, const std::vector<Support>& places) {
  std::optional<Vec3> lay;
  for (const Support& place : places) {
    if (model.seabed->laid[place.line] == Laid::nowhere) continue;
    if (lay) return std::nullopt;
    lay = model.seabed->lay[model.lines[place.line].first_node + place.node];
  }
  return lay;
}

}  // namespace

void put_bodies_on_seabed(Model& model) {
  if (!model.seabed) return;
  for (Body& body : model.bodies) {
    const double load = body.wet_weight + std::max(0.0, -body.force(0.0).z());
    if (load <= 0.0) continue;
    const std::vector<Support> places = places_of(model, body);
    const double pressure = pressure_around(model, places);
    if (pressure > 0.0) body.bed_length = load / pressure;
    if (model.seabed->law.rubs()) body.lay = laid_place(model, places);
  }
}

std::optional<SeabedSurface> seabed_surface(const Environment& environment) {
  if (environment.seabed.bathymetry) return SeabedSurface(*environment.seabed.bathymetry);
  if (environment.depth) return SeabedSurface(-*environment.depth);
  return std::nullopt;
}

double grounding_height(double diameter, double length) { return std::max(diameter, 1e-9 * length); }

double height_above(const SeabedSurface& bed, const Vec3& r) { return r.z() - bed.height(r.x(), r.y()); }

std::optional<Seabed> make_seabed(const Scene& scene, const Model& model) {
  const SeabedSpec& spec = scene.environment.seabed;
  const std::optional<SeabedSurface> surface = seabed_surface(scene.environment);
  if (!surface) return std::nullopt;
  Seabed bed;
  bed.surface = *surface;
  bed.law = {spec.stiffness, spec.smoothing, spec.damping, spec.friction_axial, spec.friction_lateral, spec.slip};
  bed.laid.assign(model.lines.size(), Laid::nowhere);
  bed.lay.assign(model.node_length.size(), Vec3::Zero());
  bed.lay_slope = bed.lay;
  for (std::size_t i = 0; i < model.lines.size(); ++i) {
    const Line& line = model.lines[i];
    const LineSpec& written = scene.lines[i];
    const Vec3 a = model.points[line.from].motion(0.0).r, b = model.points[line.to].motion(0.0).r;
    const auto grounded = [&](const Vec3& end, const SectionSpec& section) {
      return height_above(bed.surface, end) <= grounding_height(find_type(section.type, scene.line_types).diameter, line.length);
    };
    const bool from_held = !model.points[line.from].free, to_held = !model.points[line.to].free;
    const bool from = from_held && grounded(a, written.sections.front()), to = to_held && grounded(b, written.sections.back());
    if (!from && !to) continue;
    Vec3 direction = from ? Vec3(b - a) : Vec3(a - b);
    direction.z() = 0.0;
    const double way = from_held && to_held ? direction.norm() : line.length;
    const double up = std::max(0.0, height_above(bed.surface, from ? b : a));
    direction = way > 1e-9 * line.length ? direction.normalized() : Vec3::UnitX();
    const Lay lay(from ? a : b, direction, way, line.length - up, from);
    lay_out(line, lay, bed);
    bed.laid[i] = from ? Laid::from_start : Laid::from_end;
  }
  return bed;
}

}  // namespace hawser
