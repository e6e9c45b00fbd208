#include "solver/app/scene_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace hawser {
namespace {

constexpr long most_elements = 10'000'000;  // in the whole scene
constexpr double end_tolerance = 1e-9;      // of the line's length: nearer to an end is at the end
constexpr double cover_tolerance = 1e-6;    // of the line's length: how far from its ends a file of positions may stop

template <class Item>
std::vector<std::string> names_of(const std::vector<Item>& items) {
  std::vector<std::string> names;
  for (const Item& item : items) names.push_back(item.name);
  return names;
}

std::string defined(const std::vector<std::string>& names) {
  if (names.empty()) return "none is defined";
  std::string out = "defined: ";
  for (std::size_t i = 0; i < names.size() && i < 12; ++i) out += (i > 0 ? ", " : "") + names[i];
  return names.size() > 12 ? out + ", ..." : out;
}

class StructureCheck {
 public:
  StructureCheck(const Scene& scene, Document& document) : scene_(scene), document_(document) {}

  void run() {
    if (scene_.lines.empty()) document_.error(KeyPath{"lines"}, "the scene has no lines", "needs a table [lines.NAME]");
    if (scene_.points.empty()) document_.error(KeyPath{"points"}, "the scene has no points", "needs tables [points.NAME]");
    for (const LineSpec& line : scene_.lines) {
      line_names(line);
      line_ends(line);
      line_loads(line);
      if (line.start) coverage({"lines", line.name, "start"}, line, line.start->s.front(), line.start->s.back());
    }
    point_use();
    element_total();
    inertia();
    stations();
    start_table();
  }

 private:
  void line_names(const LineSpec& line) {
    for (const auto& [key, name] : {std::pair{"from", line.from}, std::pair{"to", line.to}}) {
      if (find_point(scene_, name)) continue;
      unknown_ends_ = true;
      if (name.empty()) continue;
      const auto points = names_of(scene_.points);
      document_.error({"lines", line.name, key}, fmt::format("line `{}` ends at `{}`, which is not a point", line.name, name),
                      did_you_mean(name, points), {defined(points)});
    }
    for (std::size_t i = 0; i < line.sections.size(); ++i) {
      const std::string& type = line.sections[i].type;
      if (type.empty() || find_line_type(scene_, type)) continue;
      const auto types = names_of(scene_.line_types);
      document_.error({"lines", line.name, "sections", std::to_string(i), "type"}, fmt::format("`{}` is not a line type", type),
                      did_you_mean(type, types), {defined(types)});
    }
  }

  bool bends(const LineSpec& line) const {
    return std::any_of(line.sections.begin(), line.sections.end(), [&](const SectionSpec& section) {
      const LineType* type = find_line_type(scene_, section.type);
      return type != nullptr && type->EI > 0.0;
    });
  }

  /// The family that the mesh will choose: theory and data/README.md, `model`.
  bool is_beam(const LineSpec& line) const { return line.model == ModelChoice::beam || (line.model == ModelChoice::automatic && bends(line)); }

  void line_ends(const LineSpec& line) {
    const PointSpec *from = find_point(scene_, line.from), *to = find_point(scene_, line.to);
    for (const auto& [key, end, point] : {std::tuple{"from_end", line.from_end, from}, std::tuple{"to_end", line.to_end, to}}) {
      if (!end.clamped) continue;
      const KeyPath place{"lines", line.name, key};
      if (point && point->free) document_.error(place, "a clamp needs a point that is held", fmt::format("point `{}` is free", point->name));
      if (line.model == ModelChoice::bar)
        document_.error(place, "a bar cannot be clamped: it has no direction at its ends", "", {"use model = \"beam\""});
      if (line.model != ModelChoice::bar && !is_beam(line)) {
        document_.warn(place, "a clamp does nothing to a line without bending stiffness", "needs EI > 0");
      }
    }
    if (line.model == ModelChoice::beam && !bends(line)) {
      document_.warn({"lines", line.name, "model"}, fmt::format("line `{}` is a beam, but its line types have EI = 0", line.name));
    }
  }

  void line_loads(const LineSpec& line) {
    const double length = length_of(line);
    for (std::size_t i = 0; i < line.loads.size(); ++i) {
      const LoadSpec& load = line.loads[i];
      const KeyPath at{"lines", line.name, "loads", std::to_string(i), "at"}, over{"lines", line.name, "loads", std::to_string(i), "over"};
      const double from_end = std::min(load.at, length - load.at);
      if (from_end <= end_tolerance * length) {
        document_.error(at, fmt::format("a load must lie between the ends of the line: 0 < at < {:g} m", length), fmt::format("at {:g} m", load.at),
                        {"loads at an end belong to a free point (mass, wet_weight, thrust)"});
      } else if (0.5 * load.over > from_end * (1.0 + end_tolerance)) {
        document_.error(over, "a spread load must not reach over an end of the line",
                        fmt::format("covers {:g} m to {:g} m of {:g} m", load.at - 0.5 * load.over, load.at + 0.5 * load.over, length));
      }
      if (load.moment.any() && !is_beam(line)) {
        document_.error({"lines", line.name, "loads", std::to_string(i), "moment"}, "a moment needs a beam: a line type with EI > 0",
                        fmt::format("line `{}` does not bend", line.name));
      }
    }
  }

  void point_use() {
    std::set<std::string> used;
    for (const LineSpec& line : scene_.lines) used.insert({line.from, line.to});
    for (const PointSpec& point : scene_.points) {
      if (unknown_ends_ || used.count(point.name) > 0) continue;
      const KeyPath place{"points", point.name};
      if (point.free) document_.error(place, fmt::format("no line ends at the free point `{}`", point.name), "nothing holds it");
      if (!point.free && !scene_.lines.empty()) document_.warn(place, fmt::format("no line ends at point `{}`", point.name), "unused");
    }
  }

  void element_total() {
    long total = 0;
    for (const LineSpec& line : scene_.lines) {
      for (std::size_t i = 0; i < line.sections.size(); ++i) {
        const long before = total;
        total += line.sections[i].elements;
        if (before > most_elements || total <= most_elements) continue;
        document_.error({"lines", line.name, "sections", std::to_string(i), "elements"},
                        fmt::format("the whole scene may have {} elements", most_elements), "more than that up to here");
      }
    }
  }

  /// Without mass a moving line has no acceleration.
  void inertia() {
    if (!scene_.dynamics) return;
    for (const LineType& type : scene_.line_types) {
      if (type.mass == 0.0) document_.error({"line_types", type.name, "mass"}, "a scene with [dynamics] needs line types with mass > 0");
    }
  }

  const LineSpec* known_line(const KeyPath& place, const std::string& name) {
    const auto at = std::find_if(scene_.lines.begin(), scene_.lines.end(), [&](const LineSpec& line) { return line.name == name; });
    if (at != scene_.lines.end()) return &*at;
    const auto lines = names_of(scene_.lines);
    document_.error(place, fmt::format("`{}` is not a line", name), did_you_mean(name, lines), {defined(lines)});
    return nullptr;
  }

  void stations() {
    for (const auto& [name, arc_lengths] : scene_.output.stations) {
      const KeyPath place{"output", "stations", name};
      const LineSpec* line = known_line(place, name);
      if (line == nullptr) continue;
      const double length = length_of(*line);
      for (std::size_t i = 0; i < arc_lengths.size(); ++i) {
        if (!(arc_lengths[i] > length * (1.0 + end_tolerance))) continue;
        document_.error({"output", "stations", name, std::to_string(i)}, fmt::format("a station of line `{}` must lie in 0 to {:g} m", name, length),
                        "beyond the end of the line");
      }
    }
  }

  void coverage(const KeyPath& place, const LineSpec& line, double first, double last) {
    const double length = length_of(line), gap = std::max(std::abs(first), std::abs(last - length));
    if (gap > cover_tolerance * length) {
      document_.error(place, fmt::format("the file must give line `{}` from s = 0 to s = {:g} m", line.name, length),
                      fmt::format("it goes from {:g} m to {:g} m", first, last));
    }
  }

  void start_table() {
    if (!scene_.dynamics || !scene_.dynamics->start_table) return;
    const KeyPath place{"dynamics", "start", "file"};
    std::map<std::string, std::vector<double>> arc_lengths;
    for (const StartTable::Row& row : scene_.dynamics->start_table->rows) arc_lengths[row.line].push_back(row.s);
    for (const auto& [name, s] : arc_lengths) {
      const LineSpec* line = known_line(place, name);
      const auto back = std::adjacent_find(s.begin(), s.end(), [](double a, double b) { return !(b > a); });
      if (back != s.end())
        document_.error(place, fmt::format("`s` of line `{}` must increase from row to row", name), fmt::format("not after {:g} m", *back));
      if (line) coverage(place, *line, s.front(), s.back());
    }
    for (const LineSpec& line : scene_.lines) {
      if (!arc_lengths.count(line.name)) document_.error(place, fmt::format("the file has no rows of line `{}`", line.name));
    }
  }

  const Scene& scene_;
  Document& document_;
  bool unknown_ends_ = false;  // some line ends at no known point: that a point is unused says nothing
};

}  // namespace

const PointSpec* find_point(const Scene& scene, const std::string& name) {
  const auto at = std::find_if(scene.points.begin(), scene.points.end(), [&](const PointSpec& point) { return point.name == name; });
  return at == scene.points.end() ? nullptr : &*at;
}

const LineType* find_line_type(const Scene& scene, const std::string& name) {
  const auto at = std::find_if(scene.line_types.begin(), scene.line_types.end(), [&](const LineType& type) { return type.name == name; });
  return at == scene.line_types.end() ? nullptr : &*at;
}

double length_of(const LineSpec& line) {
  double length = 0.0;
  for (const SectionSpec& section : line.sections) length += section.length;
  return length;
}

void check_structure(const Scene& scene, Document& document) { StructureCheck(scene, document).run(); }

void check_scene(const Scene& scene, Document& document) {
  if (document.full()) return;
  check_structure(scene, document);
  check_network(scene, document);
  check_motion(scene, document);
}

}  // namespace hawser
