// Small scenes for the tests of assembly: one held line with everything a line can carry.
#pragma once

#include "assembly/scene.hpp"

namespace hawser::test {

/// 100 m from (0,0,-80) to (60,10,0): two sections, a clump, a point force, a spread force, sheared current.
inline Scene loaded_line(int elements, double EI_left, double EI_right, ModelChoice model = ModelChoice::automatic) {
  Scene scene;
  scene.environment.current = {{0.0, 0.8, 0.3}, {-40.0, 0.4, 1.0}, {-100.0, 0.1, 2.0}};
  LineType a;
  a.name = "a";
  a.diameter = 0.05;
  a.mass = 4.0;
  a.EA = 2.0e6;
  a.EI = EI_left;
  a.drag_normal = 1.2;
  a.drag_tangential = 0.02;
  a.added_mass_normal = 1.0;
  a.added_mass_tangential = 0.1;
  a.axial_damping = 1.0e3;
  LineType b = a;
  b.name = "b";
  b.EA = 5.0e6;
  b.EI = EI_right;
  b.mass = 6.0;
  scene.line_types = {a, b};
  PointSpec from, to;
  from.name = "from";
  from.position = {0.0, 0.0, -80.0};
  to.name = "to";
  to.position = {60.0, 10.0, 0.0};
  scene.points = {from, to};
  LineSpec line;
  line.name = "line";
  line.from = "from";
  line.to = "to";
  line.model = model;
  SectionSpec first, second;
  first.type = "a";
  first.length = 60.0;
  first.elements = elements * 6 / 10;
  second.type = "b";
  second.length = 45.0;
  second.elements = elements - first.elements;
  line.sections = {first, second};
  LoadSpec clump, pull, spread;
  clump.at = 25.0;
  clump.body.mass = 80.0;
  clump.body.wet_weight = 600.0;
  clump.body.drag_area = 0.3;
  clump.body.added_mass = 20.0;
  pull.at = 80.0;
  pull.body.force.constant = {300.0, -200.0, 100.0};
  spread.at = 61.0;
  spread.over = 9.0;
  spread.body.force.constant = {0.0, 500.0, 0.0};
  line.loads = {clump, pull, spread};
  scene.lines = {line};
  return scene;
}

}  // namespace hawser::test
