// LineShape: a first guess of one line, node by node, before it is written into a State.
#pragma once

#include <vector>

#include "assembly/model.hpp"
#include "assembly/state.hpp"

namespace hawser {

/// The cubic of arc length h from `a` with slope `at_a` to `b` with slope `at_b`, at x h.
struct Cubic {
  Vec3 a, b, at_a, at_b;
  double h;

  Vec3 chord() const { return (b - a) / h; }
  Vec3 r(double x) const { return a + h * (x * chord() + x * (1 - x) * ((1 - x) * (at_a - chord()) - x * (at_b - chord()))); }
  Vec3 slope(double x) const { return chord() + (1 - x) * (1 - 3 * x) * (at_a - chord()) + x * (3 * x - 2) * (at_b - chord()); }
};

struct LineShape {
  std::vector<Vec3> r;      // m
  std::vector<Vec3> left;   // r' at the right end of the element before the node (first node: as `right`)
  std::vector<Vec3> right;  // r' at the left end of the element after it (last node: as `left`)

  explicit LineShape(int nodes) : r(nodes, Vec3::Zero()), left(nodes, Vec3::Zero()), right(nodes, Vec3::Zero()) {}
};

/// Writes a shape into the unknowns of its line, inner unknowns of its joints included.
void write_shape(const Model& model, int line, const LineShape& shape, State& state);

/// Nodes at r0 + direction s (1 + strain).
LineShape straight_shape(const Line& line, const Vec3& r0, const Vec3& direction, double stretch);

/// Elastic catenary between two held ends, drag included as a load per element, from the shape of the pass before.
LineShape catenary_shape(const Model& model, int line, const Vec3& from, const Vec3& to);

/// Between these ends: catenary, on the bed where it would pass below it; with a free end from there to the other end.
LineShape guessed_shape(const Model& model, int line, const Vec3& from, const Vec3& to);

/// Through the rows of a table of positions (Hermite, slopes of unit length along it).
LineShape table_shape(const Line& line, const ShapeTable& table);

}  // namespace hawser
