#include "assembly/symmetry.hpp"

#include <algorithm>

namespace hawser {

namespace {

bool any(const std::vector<double>& values) {
  return std::any_of(values.begin(), values.end(), [](double v) { return v != 0.0; });
}

bool drags(const Model& model) {
  return any(model.element.drag_normal) || any(model.element.drag_tangential) ||
         std::any_of(model.bodies.begin(), model.bodies.end(), [](const Body& body) { return body.drag != 0.0; });
}

bool bed_has_energy(const Seabed& bed) {
  const bool rubs = bed.law.rubs() && std::any_of(bed.laid.begin(), bed.laid.end(), [](Laid laid) { return laid != Laid::nowhere; });
  return bed.surface.level() && !rubs;
}

}  // namespace

Symmetry static_symmetry(const Model& model, const State& state) {
  const bool moves = any(state.v) || any(state.a);
  const bool dragged = model.current.fastest() > 0.0 && drags(model);
  const bool turned = std::any_of(model.bodies.begin(), model.bodies.end(), [](const Body& body) { return body.moment.any(); });
  const bool rests_on_energy = !model.seabed || bed_has_energy(*model.seabed);
  return !moves && !dragged && !turned && rests_on_energy ? Symmetry::symmetric : Symmetry::unknown;
}

}  // namespace hawser
