#include "assembly/seabed_build.hpp"

#include <algorithm>
#include <cmath>

namespace hawser {
namespace {

constexpr int substeps = 4;  // of an element, where the bed slopes

double diameter_of(const Scene& scene, const SectionSpec& section) {
  const auto type = std::find_if(scene.line_types.begin(), scene.line_types.end(), [&](const LineType& t) { return t.name == section.type; });
  return type->diameter;
}

/// Nodes from `start` in the plan direction, arc length measured on the bed.
void lay_out(const SeabedSurface& bed, const Line& line, const Vec3& start, const Vec3& direction, bool from, Vec3* lay) {
  double x = 0.0;  // m, plan distance
  for (int k = 0; k < line.nodes; ++k) {
    const int node = from ? k : line.nodes - 1 - k, before = from ? k - 1 : line.nodes - k;
    const double l = k > 0 ? std::abs(line.s[node] - line.s[before]) : 0.0;
    for (int i = 0; i < substeps; ++i) {
      const Vec3 r = start + x * direction;
      const SurfacePoint<double> here = bed.at(r.x(), r.y());
      x += l / substeps / std::hypot(1.0, here.slope[0] * direction.x() + here.slope[1] * direction.y());
    }
    lay[node] = start + x * direction;
    lay[node].z() = bed.height(lay[node].x(), lay[node].y());
  }
}

}  // namespace

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
  bed.laid.assign(model.lines.size(), false);
  if (!bed.law.rubs()) return bed;
  bed.lay.assign(model.node_length.size(), Vec3::Zero());
  for (std::size_t i = 0; i < model.lines.size(); ++i) {
    const Line& line = model.lines[i];
    const LineSpec& written = scene.lines[i];
    const Vec3 a = model.points[line.from].motion(0.0).r, b = model.points[line.to].motion(0.0).r;
    const auto grounded = [&](const Vec3& end, const SectionSpec& section) {
      return height_above(bed.surface, end) <= grounding_height(diameter_of(scene, section), line.length);
    };
    const bool from = !line.from_free && grounded(a, written.sections.front()), to = !line.to_free && grounded(b, written.sections.back());
    if (!from && !to) continue;
    Vec3 direction = from ? Vec3(b - a) : Vec3(a - b);
    direction.z() = 0.0;
    direction = direction.norm() > 1e-9 * line.length ? direction.normalized() : Vec3::UnitX();
    lay_out(bed.surface, line, from ? a : b, direction, from, &bed.lay[static_cast<std::size_t>(line.first_node)]);
    bed.laid[i] = true;
  }
  return bed;
}

}  // namespace hawser
