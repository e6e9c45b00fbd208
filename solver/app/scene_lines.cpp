// [line_types.NAME] and [lines.NAME]: properties, sections, loads, ends, first guesses.
#include <fmt/format.h>

#include <cmath>

#include "solver/app/scene_parts.hpp"
#include "solver/app/table_file.hpp"

namespace hawser {
namespace {

/// A bending stiffness, or its later forms refused by name.
double read_bending_stiffness(TableReader& type) {
  const toml::node* node = type.find("EI");
  if (node != nullptr && node->is_table()) {
    type.not_built("EI", fmt::format("two principal stiffnesses (`{}`)", type.path_of("EI")), "write one number: the isotropic bending stiffness");
    return 0.0;
  }
  return type.number("EI", {kinds::bending_stiffness, not_negative}, 0.0);
}

void refuse_torsion(TableReader& type) {
  if (type.number("GJ", {kinds::bending_stiffness, not_negative}, 0.0) > 0.0) {
    type.not_built("GJ", fmt::format("torsion (`{}` > 0)", type.path_of("GJ")), "remove the key or set it to 0");
  }
}

LineType read_line_type(Document& document, const toml::key& key, const toml::table& table) {
  LineType type;
  type.name = std::string(key.str());
  TableReader reader(document, table, "line_types." + type.name);
  type.place = reader.place();
  type.diameter = reader.number("diameter", {kinds::length, not_negative});
  type.mass = reader.number("mass", {kinds::mass_per_length, not_negative});
  type.EA = reader.number("EA", {kinds::force, positive});
  type.EI = read_bending_stiffness(reader);
  refuse_torsion(reader);
  if (const toml::table* drag = reader.find_table("drag")) {
    TableReader coefficients(document, *drag, reader.path_of("drag"));
    type.drag_normal = coefficients.number("normal", {kinds::number, not_negative}, 0.0);
    type.drag_tangential = coefficients.number("tangential", {kinds::number, not_negative}, 0.0);
    coefficients.finish();
  }
  if (const toml::table* added_mass = reader.find_table("added_mass")) {
    TableReader coefficients(document, *added_mass, reader.path_of("added_mass"));
    type.added_mass_normal = coefficients.number("normal", {kinds::number, not_negative}, 0.0);
    type.added_mass_tangential = coefficients.number("tangential", {kinds::number, not_negative}, 0.0);
    coefficients.finish();
  }
  type.axial_damping = reader.number("axial_damping", {kinds::force_times_time, not_negative}, 0.0);
  type.wet_weight = reader.maybe_number("wet_weight", {kinds::force_per_length});
  reader.finish();
  return type;
}

constexpr int most_elements = 10'000'000;

SectionSpec read_section(Document& document, const toml::table& table, const std::string& path) {
  SectionSpec section;
  TableReader reader(document, table, path);
  section.place = reader.place();
  section.type = reader.text("type");
  section.length = reader.number("length", {kinds::length, positive});
  if (!reader.find("elements") || reader.holds_word("elements", "auto")) {
    reader.not_built("elements", fmt::format("a mesh chosen by the program (`{}` absent or \"auto\")", reader.path_of("elements")),
                     "write the number of elements");
  } else {
    section.elements = reader.integer("elements", 1, most_elements, 0);
  }
  reader.finish();
  return section;
}

LoadSpec read_load(Document& document, const toml::table& table, const std::string& path) {
  LoadSpec load;
  TableReader reader(document, table, path);
  load.place = reader.place();
  load.at = reader.number("at", {kinds::length, positive});
  load.over = reader.number("over", {kinds::length, not_negative}, 0.0);
  load.body = read_body(reader);
  load.body.force = read_time_force(reader, "force", kinds::force);
  load.moment = read_time_force(reader, "moment", kinds::moment);
  if (load.over > 0.0) {
    for (const char* key : {"mass", "wet_weight", "volume", "drag_area", "added_mass", "moment"}) {
      if (!reader.find(key)) continue;
      reader.error_at(key, fmt::format("`{}` cannot be spread over a length", reader.path_of(key)), "`over` spreads `force` only",
                      {"write it as a load of its own, without `over`"});
    }
    if (!reader.find("force")) reader.error_at("over", fmt::format("`{}` has no `force` to spread", path));
  }
  const BodySpec& body = load.body;
  const bool weighs = body.mass != 0.0 || body.wet_weight.value_or(0.0) != 0.0 || body.volume.value_or(0.0) != 0.0;
  if (!weighs && body.drag_area == 0.0 && body.added_mass == 0.0 && !body.force.any() && !load.moment.any()) {
    document.warn(table.source(), fmt::format("`{}` loads the line with nothing", path));
  }
  reader.finish();
  return load;
}

/// "pinned" or { clamped = [x, y, z] }; twist is refused by name.
EndSpec read_end(TableReader& line, std::string_view key) {
  EndSpec end;
  const toml::node* node = line.find(key);
  if (node == nullptr || line.holds_word(key, "pinned")) return end;
  const std::string wanted = fmt::format("`{}` must be \"pinned\" or {{ clamped = [x, y, z] }}", line.path_of(key));
  if (!node->is_table()) {
    line.error_at(key, wanted, fmt::format("this is {}", type_of(*node)));
    return end;
  }
  TableReader reader(line.document(), *node->as_table(), line.path_of(key));
  for (const char* torsion : {"twist", "director"}) {
    if (reader.find(torsion)) reader.not_built(torsion, fmt::format("torsion (`{}`)", reader.path_of(torsion)), "remove the key");
  }
  const bool pinned = reader.boolean("pinned", false);
  end.clamped = reader.find("clamped") != nullptr;
  if (end.clamped) end.direction = reader.vector("clamped", kinds::number);
  if (end.direction.isZero(0.0)) reader.error_at("clamped", fmt::format("`{}` must not be zero", reader.path_of("clamped")), "gives no direction");
  if (pinned == end.clamped) line.error_at(key, wanted);
  reader.finish();
  return end;
}

/// Lists of tables: the reader of one item is called with its path.
template <class Item, class Read>
std::vector<Item> read_list(TableReader& line, std::string_view key, Read read) {
  std::vector<Item> items;
  const toml::array* list = line.find_array(key);
  if (list == nullptr) return items;
  for (std::size_t i = 0; i < list->size(); ++i) {
    const std::string path = fmt::format("{}.{}", line.path_of(key), i);
    const toml::node& node = (*list)[i];
    if (const toml::table* table = node.as_table()) {
      items.push_back(read(line.document(), *table, path));
    } else {
      line.document().error(node.source(), fmt::format("`{}` must be a table", path), fmt::format("this is {}", type_of(node)));
    }
  }
  return items;
}

std::vector<SectionSpec> read_sections(TableReader& line) {
  if (!line.require("sections")) return {};
  const toml::array* list = line.find_array("sections");
  if (list != nullptr && list->empty()) line.error_at("sections", fmt::format("`{}` must hold at least one section", line.path_of("sections")));
  return read_list<SectionSpec>(line, "sections", read_section);
}

ModelChoice read_model(TableReader& line) {
  if (line.holds_word("model", "rod")) {
    line.not_built("model", "the rod (torsion)", "write \"beam\", \"cable\", \"bar\" or \"auto\"");
    return ModelChoice::automatic;
  }
  constexpr ModelChoice choices[] = {ModelChoice::automatic, ModelChoice::bar, ModelChoice::cable, ModelChoice::beam};
  return choices[line.choice("model", {"auto", "bar", "cable", "beam"})];
}

std::optional<ShapeTable> read_start(TableReader& line) {
  const toml::table* table = line.find_table("start");
  if (table == nullptr) return std::nullopt;
  TableReader reader(line.document(), *table, line.path_of("start"));
  const std::string file = file_name(reader);
  reader.finish();
  if (file.empty()) return std::nullopt;
  const TableFile rows = read_table_file(line.document(), *reader.find("file"), file, {"s", "x", "y", "z"}, FirstColumn::number);
  if (rows.rows.empty() || !increases(line.document(), rows, 0, "s")) return std::nullopt;
  ShapeTable shape;
  for (const TableFile::Row& row : rows.rows) {
    shape.s.push_back(row.value[0]);
    shape.position.emplace_back(row.value[1], row.value[2], row.value[3]);
  }
  return shape;
}

LineSpec read_line(Document& document, const toml::key& key, const toml::table& table) {
  LineSpec line;
  line.name = std::string(key.str());
  TableReader reader(document, table, "lines." + line.name);
  line.place = reader.place();
  line.from = reader.text("from");
  line.to = reader.text("to");
  line.sections = read_sections(reader);
  line.model = read_model(reader);
  line.loads = read_list<LoadSpec>(reader, "loads", read_load);
  line.from_end = read_end(reader, "from_end");
  line.to_end = read_end(reader, "to_end");
  line.start = read_start(reader);
  reader.finish();
  return line;
}

}  // namespace

std::vector<LineType> read_line_types(TableReader& scene) { return read_named<LineType>(scene, "line_types", "line type", read_line_type); }

std::vector<LineSpec> read_lines(TableReader& scene) { return read_named<LineSpec>(scene, "lines", "line", read_line); }

}  // namespace hawser
