#include "assembly/model.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>

#include "assembly/mesh.hpp"
#include "assembly/numbering.hpp"
#include "assembly/seabed_build.hpp"

namespace hawser {

const char* name_of(Family family) {
  switch (family) {
    case Family::bar:
      return "bar";
    case Family::cable:
      return "cable";
    case Family::beam:
      return "beam";
  }
  return "?";
}

State Model::make_state() const {
  State s;
  s.q.assign(unknowns, 0.0);
  s.v.assign(unknowns, 0.0);
  s.a.assign(unknowns, 0.0);
  return s;
}

void Model::prescribe(State& state) const {
  for (const Support& support : supports) {
    const Kinematics k = points[support.point].motion(state.t);
    const std::size_t d = dof(support.line, support.node);
    for (int c = 0; c < 3; ++c) {
      state.q[d + c] = k.r[c];
      state.v[d + c] = k.v[c];
      state.a[d + c] = k.a[c];
    }
  }
  for (const Hub& hub : hubs) {
    const std::size_t first = dof(hub.ends.front().line, hub.ends.front().node);
    for (const Support& end : hub.ends)
      for (std::vector<double>* x : {&state.q, &state.v, &state.a}) std::copy_n(&(*x)[first], 3, &(*x)[dof(end.line, end.node)]);
  }
}

void Model::align_clamps(State& state) const {
  for (const Support& support : supports) {
    if (!support.clamped) continue;
    Eigen::Map<Vec3> slope(&state.q[dof(support.line, support.node) + 3]);
    slope = slope.norm() * support.direction;
  }
}

void Model::reset_joints(State& state) const {
  for (const Joint& joint : joints) {
    const std::size_t slope = dof(joint.line, joint.node) + 3;
    for (int c = 0; c < joint.inner_count(); ++c) {
      const bool free = joint.jump == Jump::free;
      state.q[joint.inner + c] = free ? state.q[slope + c] : 1.0;
      state.v[joint.inner + c] = free ? state.v[slope + c] : 0.0;
      state.a[joint.inner + c] = free ? state.a[slope + c] : 0.0;
    }
  }
}

namespace {

class ModelBuilder {
 public:
  explicit ModelBuilder(const Scene& scene) : scene_(scene) {}

  Model build() {
    model_.gravity = scene_.environment.gravity;
    model_.water_density = scene_.environment.water_density;
    add_current();
    add_points();
    for (const LineSpec& line : scene_.lines)
      for (const std::string* end : {&line.from, &line.to}) ++ends_at_[point_index(*end)];
    for (const LineSpec& line : scene_.lines) add_line(line);
    number_unknowns(model_);
    model_.seabed = make_seabed(scene_, model_);
    put_bodies_on_seabed(model_);
    return std::move(model_);
  }

 private:
  void add_current() {
    auto rows = scene_.environment.current;
    if (model_.water_density <= 0.0) return;
    std::sort(rows.begin(), rows.end(), [](const CurrentRow& a, const CurrentRow& b) { return a.z < b.z; });
    for (const CurrentRow& row : rows) {
      model_.current.z.push_back(row.z);
      model_.current.ux.push_back(row.speed * std::cos(row.heading));
      model_.current.uy.push_back(row.speed * std::sin(row.heading));
    }
  }

  void add_points() {
    std::vector<Vec3> steady;
    int moving = 0;
    for (const PointSpec& p : scene_.points) {
      model_.points.push_back({p.name, p.free, p.position, Motion(p.position, p.motion)});
      moving += p.motion.has_value();
      if (const auto velocity = model_.points.back().motion.steady_velocity()) steady.push_back(*velocity);
    }
    const bool common = std::all_of(steady.begin(), steady.end(), [&](const Vec3& v) { return v == steady.front(); });
    if (!steady.empty() && common && static_cast<int>(steady.size()) == moving) model_.tow = steady.front();
  }

  int point_index(const std::string& name) const {
    for (std::size_t i = 0; i < model_.points.size(); ++i)
      if (model_.points[i].name == name) return static_cast<int>(i);
    throw std::invalid_argument("no point named " + name);
  }

  void add_line(const LineSpec& spec) {
    const LineMesh mesh = mesh_line(spec, scene_.line_types);
    Line line;
    line.name = spec.name;
    line.family = mesh.family;
    line.first_node = static_cast<int>(model_.node_length.size());
    line.nodes = static_cast<int>(mesh.s.size());
    line.first_element = model_.total_elements();
    line.elements = line.nodes - 1;
    line.from = point_index(spec.from);
    line.to = point_index(spec.to);
    line.length = mesh.s.back();
    line.from_free = model_.points[line.from].free && ends_at_[line.from] == 1;
    line.to_free = model_.points[line.to].free && ends_at_[line.to] == 1;
    line.s = mesh.s;
    const int index = static_cast<int>(model_.lines.size());
    for (int e = 0; e < line.elements; ++e) add_element(mesh.s[e + 1] - mesh.s[e], *mesh.type[e]);
    for (int i = 0; i < line.nodes; ++i) {
      const double left = i > 0 ? mesh.s[i] - mesh.s[i - 1] : mesh.s[1] - mesh.s[0];
      const double right = i + 1 < line.nodes ? mesh.s[i + 1] - mesh.s[i] : left;
      model_.node_length.push_back(std::min(left, right));
    }
    for (const MeshJoint& j : mesh.joints) model_.joints.push_back({j.jump, index, line.first_element + j.node - 1, j.node, 0});
    model_.chains.push_back({line.family == Family::bar ? 3 : 6, line.nodes, 0, 0});
    line.from_hub = add_end(spec.from_end, line.from, index, 0);
    line.to_hub = add_end(spec.to_end, line.to, index, line.nodes - 1);
    add_loads(spec, mesh, index, line.first_element);
    model_.lines.push_back(std::move(line));
  }

  void add_element(double length, const LineType& type) {
    ElementArrays& e = model_.element;
    const double rho = model_.water_density, d = type.diameter;
    const double area = std::numbers::pi / 4.0 * d * d;
    const double weight = type.wet_weight.value_or((type.mass - rho * area) * model_.gravity);
    const double drag_normal = 0.5 * rho * type.drag_normal * d;
    const double fastest = model_.current.fastest() + model_.tow.norm();
    e.length.push_back(length);
    e.EA.push_back(type.EA);
    e.EI.push_back(type.EI);
    e.axial_damping.push_back(type.axial_damping);
    e.mass.push_back(type.mass);
    e.weight.push_back(weight);
    e.drag_normal.push_back(drag_normal);
    e.drag_tangential.push_back(0.5 * rho * type.drag_tangential * std::numbers::pi * d);
    e.added_normal.push_back(rho * area * type.added_mass_normal);
    e.added_tangential.push_back(rho * area * type.added_mass_tangential);
    e.minimum_tension.push_back(1.0e-6 * (std::abs(weight) + drag_normal * fastest * fastest) * length);
    e.diameter.push_back(d);
    model_.wet =
        model_.wet ||
        (rho > 0.0 && (type.drag_normal > 0.0 || type.drag_tangential > 0.0 || type.added_mass_normal > 0.0 || type.added_mass_tangential > 0.0));
  }

  /// The number of the hub where the end is at one, else -1.
  int add_end(const EndSpec& end, int point, int line, int node) {
    const bool held = !model_.points[point].free;
    const Support support{line, node, point, true, held && end.clamped, end.direction.normalized()};
    if (held) {
      model_.supports.push_back(support);
      return -1;
    }
    const auto known = std::find_if(model_.hubs.begin(), model_.hubs.end(), [point](const Hub& hub) { return hub.point == point; });
    if (known == model_.hubs.end()) add_body(scene_.points[point].body, TimeForce{}, line, node);
    if (ends_at_[point] == 1) return -1;
    const int index = static_cast<int>(known - model_.hubs.begin());
    if (known == model_.hubs.end()) model_.hubs.push_back({point, {}});
    model_.hubs[index].ends.push_back(support);
    return index;
  }

  void add_body(const BodySpec& body, const TimeForce& moment, int line, int node) {
    const double weight = body.wet_weight.value_or((body.mass - model_.water_density * body.volume.value_or(0.0)) * model_.gravity);
    model_.bodies.push_back({line, node, body.mass, body.added_mass, weight, 0.5 * model_.water_density * body.drag_area, TimeFunction(body.force),
                             TimeFunction(moment), 0.0, std::nullopt});
  }

  void add_loads(const LineSpec& spec, const LineMesh& mesh, int line, int first_element) {
    for (const LoadSpec& load : spec.loads) {
      if (load.over > 0.0) {
        for (const Spread& part : spread_over(mesh.s, load.at - 0.5 * load.over, load.at + 0.5 * load.over))
          model_.spread_loads.push_back({line, first_element + part.element, part.xi0, part.xi1, part.share, TimeFunction(load.body.force)});
      } else {
        add_body(load.body, load.moment, line, nearest_node(mesh.s, load.at));
      }
    }
  }

  const Scene& scene_;
  Model model_;
  std::map<int, int> ends_at_;  // line ends at each point
};

}  // namespace

Model build_model(const Scene& scene) { return ModelBuilder(scene).build(); }

Scene coarsened(const Scene& scene) {
  Scene coarse = scene;
  for (LineSpec& line : coarse.lines)
    for (SectionSpec& section : line.sections) section.elements = std::max(1, section.elements / 2);
  return coarse;
}

}  // namespace hawser
