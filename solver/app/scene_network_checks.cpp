#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <queue>

#include "solver/app/scene_checks.hpp"

namespace hawser {
namespace {

/// Lines as edges between points; a held point ends every path.
class NetworkCheck {
 public:
  NetworkCheck(const Scene& scene, Document& document) : scene_(scene), document_(document), lines_at_(scene.points.size()) {
    std::map<std::string, int> index;
    for (std::size_t p = 0; p < scene.points.size(); ++p) index[scene.points[p].name] = static_cast<int>(p);
    for (std::size_t i = 0; i < scene.lines.size(); ++i) {
      const auto from = index.find(scene.lines[i].from), to = index.find(scene.lines[i].to);
      unknown_ends_ |= from == index.end() || to == index.end();
      if (from == index.end() || to == index.end()) continue;
      lines_at_[from->second].push_back({static_cast<int>(i), to->second});
      lines_at_[to->second].push_back({static_cast<int>(i), from->second});
    }
  }

  void run() {
    std::vector<char> reached(scene_.points.size(), 0);
    for (std::size_t p = 0; p < scene_.points.size(); ++p)
      if (!scene_.points[p].free) reach(static_cast<int>(p), reached);
    for (std::size_t p = 0; p < scene_.points.size(); ++p)
      if (!reached[p] && !lines_at_[p].empty() && !unknown_ends_) nothing_holds(static_cast<int>(p), reached);
    for (std::size_t p = 0; p < scene_.points.size(); ++p)
      if (!scene_.points[p].free) lengths_from(static_cast<int>(p));
  }

 private:
  struct Edge {
    int line, other;
  };

  /// Marks all points joined to this one and returns the lines on the way.
  std::vector<int> reach(int from, std::vector<char>& reached) const {
    std::vector<int> lines, waiting{from};
    if (reached[from]) return lines;
    reached[from] = 1;
    while (!waiting.empty()) {
      const int point = waiting.back();
      waiting.pop_back();
      for (const Edge& edge : lines_at_[point]) {
        lines.push_back(edge.line);
        if (reached[edge.other]) continue;
        reached[edge.other] = 1;
        waiting.push_back(edge.other);
      }
    }
    return lines;
  }

  void nothing_holds(int point, std::vector<char>& reached) {
    std::vector<int> lines = reach(point, reached);
    std::sort(lines.begin(), lines.end());
    lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
    document_.error({"lines", scene_.lines[lines.front()].name, "to"}, fmt::format("nothing holds {}: all points there are free", named(lines)),
                    "joined to no held point", {"fix or move one of the points, or join them to a line that ends at a held point"});
  }

  std::string named(const std::vector<int>& lines) const {
    std::string names;
    for (std::size_t i = 0; i < lines.size() && i < 6; ++i) names += fmt::format("{}`{}`", i > 0 ? ", " : "", scene_.lines[lines[i]].name);
    return fmt::format("line{} {}{}", lines.size() > 1 ? "s" : "", names, lines.size() > 6 ? ", ..." : "");
  }

  struct Reached {
    double length = HUGE_VAL;  // m, of the shortest way there
    int line = -1, before = -1;
  };

  /// The shortest ways over free points to other held points, two lines or more.
  void lengths_from(int start) {
    std::map<int, Reached> way{{start, {0.0, -1, -1}}};
    using Entry = std::pair<double, int>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> waiting;
    waiting.push({0.0, start});
    while (!waiting.empty()) {
      const auto [length, point] = waiting.top();
      waiting.pop();
      if (length > way[point].length || (point != start && !scene_.points[point].free)) continue;
      for (const Edge& edge : lines_at_[point]) {
        const double there = length + length_of(scene_.lines[edge.line]);
        if (!(there < way[edge.other].length)) continue;
        way[edge.other] = {there, edge.line, point};
        waiting.push({there, edge.other});
      }
    }
    for (const auto& [point, reached] : way)
      if (point > start && !scene_.points[point].free && reached.before != start) strain(start, point, way);
  }

  void strain(int start, int end, const std::map<int, Reached>& way) {
    const double length = way.at(end).length, chord = (place_at_start(scene_.points[end]) - place_at_start(scene_.points[start])).norm();
    if (!(chord / length - 1.0 > largest_strain)) return;
    std::vector<int> lines;
    for (int point = end; point != start; point = way.at(point).before) lines.insert(lines.begin(), way.at(point).line);
    document_.error({"lines", scene_.lines[lines.front()].name, "sections"},
                    fmt::format("{} are too short together: they would have to stretch {:.0f} %", named(lines), 100.0 * (chord / length - 1.0)),
                    fmt::format("{:g} m in all", length),
                    {fmt::format("points `{}` and `{}` are {:g} m apart at t = 0; lines may stretch by at most 50 %", scene_.points[start].name,
                                 scene_.points[end].name, chord)});
  }

  const Scene& scene_;
  Document& document_;
  std::vector<std::vector<Edge>> lines_at_;  // of every point
  bool unknown_ends_ = false;                // some line ends at no known point: perhaps that one is held
};

}  // namespace

void check_network(const Scene& scene, Document& document) { NetworkCheck(scene, document).run(); }

}  // namespace hawser
