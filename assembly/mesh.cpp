#include "assembly/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace hawser {

const LineType& find_type(const std::string& name, std::span<const LineType> types) {
  for (const LineType& t : types)
    if (t.name == name) return t;
  throw std::invalid_argument("no line type named " + name);
}

namespace {

Family family_of(const LineSpec& line, std::span<const LineType> types) {
  switch (line.model) {
    case ModelChoice::bar:
      return Family::bar;
    case ModelChoice::cable:
      return Family::cable;
    case ModelChoice::beam:
      return Family::beam;
    case ModelChoice::automatic:
      break;
  }
  const bool bends = std::any_of(line.sections.begin(), line.sections.end(), [&](const SectionSpec& s) { return find_type(s.type, types).EI > 0.0; });
  return bends ? Family::beam : Family::cable;
}

/// Elements of each piece: in proportion to length, at least one, `total` in all where that many pieces allow (largest remainders).
std::vector<int> share_elements(const std::vector<double>& lengths, int total) {
  double sum = 0.0;
  for (double l : lengths) sum += l;
  std::vector<int> count(lengths.size());
  std::vector<double> remainder(lengths.size());
  int given = 0;
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    const double wanted = total * lengths[i] / sum;
    count[i] = std::max(1, static_cast<int>(std::floor(wanted + 1.0e-9)));
    remainder[i] = wanted - count[i];
    given += count[i];
  }
  for (; given < total; ++given) {
    const auto most = std::max_element(remainder.begin(), remainder.end()) - remainder.begin();
    ++count[most];
    remainder[most] -= 1.0;
  }
  return count;
}

class LineMesher {
 public:
  LineMesher(const LineSpec& line, std::span<const LineType> types) : line_(line), types_(types) {
    for (const SectionSpec& s : line.sections) length_ += s.length;
    mesh_.family = family_of(line, types);
    mesh_.s.push_back(0.0);
  }

  LineMesh mesh() {
    double start = 0.0;
    for (const SectionSpec& section : line_.sections) {
      add_section(section, start);
      start += section.length;
    }
    add_joints();
    return std::move(mesh_);
  }

 private:
  bool same(double a, double b) const { return std::abs(a - b) < 1.0e-9 * length_; }

  bool loaded(double s) const {
    return std::any_of(line_.loads.begin(), line_.loads.end(), [&](const LoadSpec& l) { return l.over == 0.0 && same(l.at, s); });
  }

  /// A force or mass makes the tension jump; a moment alone does not.
  bool tension_jumps(double s) const {
    return std::any_of(line_.loads.begin(), line_.loads.end(), [&](const LoadSpec& l) {
      const BodySpec& b = l.body;
      const bool pulls = b.mass > 0.0 || b.wet_weight.value_or(0.0) != 0.0 || b.volume.value_or(0.0) > 0.0 || b.drag_area > 0.0 ||
                         b.added_mass > 0.0 || b.force.any();
      return l.over == 0.0 && pulls && same(l.at, s);
    });
  }

  void add_section(const SectionSpec& section, double start) {
    const double end = start + section.length;
    std::vector<double> cuts{start};
    for (const LoadSpec& l : line_.loads)
      if (l.over == 0.0 && l.at > start && l.at < end && !same(l.at, start) && !same(l.at, end)) cuts.push_back(l.at);
    cuts.push_back(end);
    std::sort(cuts.begin(), cuts.end());
    cuts.erase(std::unique(cuts.begin(), cuts.end(), [this](double a, double b) { return same(a, b); }), cuts.end());
    cuts.back() = end;
    std::vector<double> lengths;
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) lengths.push_back(cuts[i + 1] - cuts[i]);
    const std::vector<int> count = share_elements(lengths, section.elements);
    const LineType& type = find_type(section.type, types_);
    for (std::size_t p = 0; p < lengths.size(); ++p)
      for (int i = 1; i <= count[p]; ++i) {
        mesh_.s.push_back(i == count[p] ? cuts[p + 1] : cuts[p] + lengths[p] * i / count[p]);
        mesh_.type.push_back(&type);
      }
  }

  void add_joints() {
    if (mesh_.family == Family::bar) return;
    const auto bends = [this](const LineType& t) { return mesh_.family == Family::beam && t.EI > 0.0; };
    for (std::size_t i = 1; i < mesh_.type.size(); ++i) {
      const LineType &left = *mesh_.type[i - 1], &right = *mesh_.type[i];
      const bool jumps = left.EA != right.EA || bends(left) != bends(right) || tension_jumps(mesh_.s[i]);
      if (jumps) mesh_.joints.push_back({static_cast<int>(i), bends(left) && bends(right) ? Jump::scaled : Jump::free});
    }
  }

  const LineSpec& line_;
  std::span<const LineType> types_;
  LineMesh mesh_;
  double length_ = 0.0;
};

}  // namespace

LineMesh mesh_line(const LineSpec& line, std::span<const LineType> types) { return LineMesher(line, types).mesh(); }

std::vector<Spread> spread_over(std::span<const double> nodes, double s0, double s1) {
  std::vector<Spread> parts;
  for (std::size_t e = 0; e + 1 < nodes.size(); ++e) {
    const double a = std::max(s0, nodes[e]), b = std::min(s1, nodes[e + 1]), l = nodes[e + 1] - nodes[e];
    if (b > a) parts.push_back({static_cast<int>(e), (a - nodes[e]) / l, (b - nodes[e]) / l, (b - a) / (s1 - s0)});
  }
  return parts;
}

int nearest_node(std::span<const double> nodes, double s) {
  const auto above = std::lower_bound(nodes.begin(), nodes.end(), s);
  if (above == nodes.begin()) return 0;
  if (above == nodes.end()) return static_cast<int>(nodes.size()) - 1;
  const int i = static_cast<int>(above - nodes.begin());
  return s - nodes[i - 1] < nodes[i] - s ? i - 1 : i;
}

}  // namespace hawser
