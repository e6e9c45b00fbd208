// Scenes of lines that meet at free points.
#pragma once

#include "tests/support/scene_builder.hpp"

namespace hawser::test {

/// Two hubs, three legs to held points, a link between the hubs; clump, drag, sheared current.
inline Scene small_network(int elements, ModelChoice choice) {
  LineType type = u40();
  type.EA = 2.0e4;
  type.EI = choice == ModelChoice::beam ? 50.0 : 0.0;
  type.axial_damping = 30.0;
  BodySpec body;
  body.mass = 20.0;
  body.drag_area = 0.3;
  body.added_mass = 5.0;
  SceneBuilder b;
  b.type(type).current(0.0, {0.8, 0.2, 0}).current(-20.0, {0.1, -0.4, 0});
  b.fixed("a", {0, 0, 0}).fixed("b", {12, 1, 0}).fixed("c", {6, 9, -1});
  b.free("hub", {6, 2, -5}, body).free("knot", {7, 5, -6});
  b.line("a", "hub", choice).section("U40", 9.0, elements);
  b.line("hub", "b", choice).section("U40", 8.0, elements);
  b.line("knot", "hub", choice).section("U40", 3.0, elements);
  b.line("c", "knot", choice).section("U40", 6.0, 2 * elements);
  b.load(3.0, weight(40.0));
  return b.scene;
}

/// The same with a ring that begins and ends at the first hub.
inline Scene network_with_ring(int elements, ModelChoice choice) {
  SceneBuilder b;
  b.scene = small_network(elements, choice);
  b.line("hub", "hub", choice).section("U40", 4.0, elements + 1);
  return b.scene;
}

/// Four bars (or beams that do not bend) of length l from the corners (+-b, 0, 0), (0, +-b, 0) to a hub on the axis z, with a force F up on it.
/// At the height h of the hub, d = sqrt(b^2 + h^2),
///   F(h) = 4 EA (h/l - h/d),    energy 2 EA/l (d - l)^2 - F h,    dF/dh = 0 where d^3 = b^2 l.
/// Between the two folds the hub falls through; outside of them it is stable, as each pair of bars holds it in its own direction.
struct Pyramid {
  static constexpr double EA = 1.0e5, b = 10.0, l = 10.5;

  static double force(double h) { return 4.0 * EA * (h / l - h / std::hypot(b, h)); }
  static double energy(double h) { return 2.0 * EA / l * std::pow(std::hypot(b, h) - l, 2) - force(h) * h; }
  static double fold_height() { return std::sqrt(std::pow(b * b * l, 2.0 / 3.0) - b * b); }
  /// The height under this force, between `low` and `high`, where F grows with h.
  static double height(double F, double low, double high) {
    for (int k = 0; k < 100; ++k) (force(0.5 * (low + high)) < F ? low : high) = 0.5 * (low + high);
    return 0.5 * (low + high);
  }

  static Vec3 corner(int k) { return b * (k % 2 == 0 ? Vec3::UnitX() : Vec3::UnitY()) * (k < 2 ? 1.0 : -1.0); }
  /// EI = 0: bars of one element. Every other line runs from the hub.
  static Scene scene(double F, double EI = 0.0, double guess = 4.0) {
    SceneBuilder builder;
    builder.dry().type(line_type("bar", EA, 0.0, EI)).free("hub", {0, 0, guess}, hawser::test::force({0, 0, F}));
    for (int k = 0; k < 4; ++k) {
      const std::string name = "corner" + std::to_string(k);
      builder.fixed(name, corner(k)).line(k % 2 == 0 ? name : "hub", k % 2 == 0 ? "hub" : name, EI == 0.0 ? ModelChoice::bar : ModelChoice::beam);
      builder.section("bar", l, EI == 0.0 ? 1 : 3);
    }
    return builder.scene;
  }
};

}  // namespace hawser::test
