// SceneBuilder: scenes in a few words, for tests of the assembly and the solver (no scene file involved).
#pragma once

#include <cmath>
#include <string>

#include "assembly/scene.hpp"

namespace hawser::test {

/// A line type that carries weight and stretches; everything else zero until set.
inline LineType line_type(const std::string& name, double EA, double wet_weight, double EI = 0.0) {
  LineType type;
  type.name = name;
  type.diameter = 0.04;
  type.mass = 2.5;
  type.EA = EA;
  type.EI = EI;
  type.wet_weight = wet_weight;
  return type;
}

/// U40 of the reference cases: d 0.040 m, 2.5 kg/m, EA 4e7 N, Cdn 1.2, Cdt 0.02, Can 1.
inline LineType u40() {
  LineType type;
  type.name = "U40";
  type.diameter = 0.040;
  type.mass = 2.5;
  type.EA = 4.0e7;
  type.drag_normal = 1.2;
  type.drag_tangential = 0.02;
  type.added_mass_normal = 1.0;
  return type;
}

class SceneBuilder {
 public:
  SceneBuilder& dry() {
    scene.environment.water_density = 0.0;
    return *this;
  }
  SceneBuilder& current(double z, const Vec3& velocity) {
    scene.environment.current.push_back({z, velocity.head<2>().norm(), std::atan2(velocity.y(), velocity.x())});
    return *this;
  }
  SceneBuilder& type(const LineType& t) {
    scene.line_types.push_back(t);
    return *this;
  }
  SceneBuilder& fixed(const std::string& name, const Vec3& position) {
    scene.points.emplace_back();
    scene.points.back().name = name;
    scene.points.back().position = position;
    return *this;
  }
  SceneBuilder& towed(const std::string& name, const Vec3& position, const Vec3& velocity) {
    fixed(name, position);
    scene.points.back().motion = MotionSpec{};
    scene.points.back().motion->velocity = velocity;
    return *this;
  }
  SceneBuilder& free(const std::string& name, const Vec3& position, const BodySpec& body = {}) {
    fixed(name, position);
    scene.points.back().free = true;
    scene.points.back().body = body;
    return *this;
  }
  SceneBuilder& line(const std::string& from, const std::string& to, ModelChoice model = ModelChoice::automatic) {
    LineSpec& spec = scene.lines.emplace_back();
    spec.name = "line";
    spec.from = from;
    spec.to = to;
    spec.model = model;
    return *this;
  }
  SceneBuilder& section(const std::string& type, double length, int elements) {
    SectionSpec& spec = scene.lines.back().sections.emplace_back();
    spec.type = type;
    spec.length = length;
    spec.elements = elements;
    return *this;
  }
  SceneBuilder& clamp_from(const Vec3& direction) {
    scene.lines.back().from_end = {true, direction};
    return *this;
  }
  SceneBuilder& clamp_to(const Vec3& direction) {
    scene.lines.back().to_end = {true, direction};
    return *this;
  }
  SceneBuilder& load(double at, const BodySpec& body) {
    LoadSpec& spec = scene.lines.back().loads.emplace_back();
    spec.at = at;
    spec.body = body;
    return *this;
  }

  Scene scene;
};

/// A body that only weighs, or only pulls.
inline BodySpec weight(double wet_weight) {
  BodySpec body;
  body.wet_weight = wet_weight;
  return body;
}
inline BodySpec force(const Vec3& value) {
  BodySpec body;
  body.wet_weight = 0.0;
  body.force.constant = value;
  return body;
}

}  // namespace hawser::test
