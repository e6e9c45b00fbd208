// The parts of the scene reader: each fills its part of the Scene from the document. Faults go to the document.
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "assembly/scene.hpp"
#include "solver/app/toml_document.hpp"
#include "solver/app/toml_table.hpp"

namespace hawser {

Environment read_environment(TableReader& scene);
SeabedSpec read_seabed(TableReader& environment);
std::vector<LineType> read_line_types(TableReader& scene);
std::vector<PointSpec> read_points(TableReader& scene);
std::vector<LineSpec> read_lines(TableReader& scene);
SolveSpec read_solve(TableReader& scene);
std::optional<DynamicsSpec> read_dynamics(TableReader& scene);
OutputSpec read_output(TableReader& scene);

/// mass, wet_weight or volume, drag_area, added_mass: the keys that a free point and a load on a line have in common.
BodySpec read_body(TableReader& table);

/// [x, y, z], { table, interpolation } or { force, shape = "sin2", duration }; the pulse of a moment says `moment`.
TimeForce read_time_force(TableReader& table, std::string_view key, const Kind& kind);

/// The file of { file = "..." }; empty where the key is wrong, missing, or names a result file (not built yet).
std::string file_name(TableReader& table);

/// Reports a name that could not stand in a column title of the output.
void check_name(Document& document, const toml::key& key, const std::string& what);

/// Reads every table below `key` (`lines`, `points`, `line_types`) with read(document, name, table).
template <class Item, class Read>
std::vector<Item> read_named(TableReader& scene, const std::string& key, const std::string& what, Read read) {
  std::vector<Item> items;
  const toml::table* tables = scene.find_table(key);
  if (tables == nullptr) return items;
  constexpr std::size_t most = 10'000;  // names are looked up one by one
  if (tables->size() > most) scene.error_at(key, fmt::format("`{}` has {} tables; at most {} are read", key, tables->size(), most));
  if (tables->size() > most) return items;
  for (const auto& [name, node] : in_file_order(*tables)) {
    if (scene.document().full()) break;
    check_name(scene.document(), *name, what);
    if (const toml::table* table = node->as_table()) {
      items.push_back(read(scene.document(), *name, *table));
    } else {
      scene.document().error(node->source(), fmt::format("`{}.{}` must be a table", key, name->str()), fmt::format("this is {}", type_of(*node)));
    }
  }
  return items;
}

}  // namespace hawser
