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

}  // namespace hawser::test
