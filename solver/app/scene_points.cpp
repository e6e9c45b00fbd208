// [points.NAME]: fixed, moved and free points, their bodies, and functions of time.
#include <fmt/format.h>

#include <cmath>

#include "solver/app/scene_parts.hpp"
#include "solver/app/table_file.hpp"

namespace hawser {
namespace {

Harmonic read_harmonic(Document& document, const toml::node& node, const std::string& path) {
  Harmonic harmonic;
  const toml::table* table = node.as_table();
  if (table == nullptr) {
    document.error(node.source(), fmt::format("`{}` must be a table such as {{ direction = [0, 0, 1], amplitude = 2.5, period = 10.0 }}", path),
                   fmt::format("this is {}", type_of(node)));
    return harmonic;
  }
  TableReader reader(document, *table, path);
  harmonic.direction = reader.vector("direction", kinds::number);
  harmonic.amplitude = reader.number("amplitude", {kinds::length});
  harmonic.period = reader.number("period", {kinds::time, positive});
  harmonic.phase = reader.number("phase", {kinds::angle}, 0.0);
  if (harmonic.direction.isZero(0.0)) document.warn(node.source(), fmt::format("`{}` has no direction and moves nothing", path));
  reader.finish();
  return harmonic;
}

std::optional<TimeTable> read_motion_file(TableReader& motion) {
  const std::string file = motion.text("file");
  if (file.empty()) return std::nullopt;
  Document& document = motion.document();
  const TableFile rows = read_table_file(document, *motion.find("file"), file, {"time", "x", "y", "z"}, FirstColumn::number);
  if (rows.rows.empty()) return std::nullopt;
  if (rows.rows.size() < 2) {
    report_row(document, rows, rows.rows[0], "a motion needs at least two rows");
    return std::nullopt;
  }
  if (!increases(document, rows, 0, "time")) return std::nullopt;
  TimeTable table;
  table.interpolation = TimeTable::Interpolation::cubic;
  for (const TableFile::Row& row : rows.rows) {
    table.time.push_back(row.value[0]);
    table.value.emplace_back(row.value[1], row.value[2], row.value[3]);
  }
  return table;
}

MotionSpec read_motion(Document& document, const toml::table& table, const std::string& path) {
  MotionSpec motion;
  TableReader reader(document, table, path);
  if (reader.find("file") != nullptr) {
    motion.file = read_motion_file(reader);
    for (const char* other : {"velocity", "ramp", "harmonics"}) {
      if (reader.find(other)) reader.error_at(other, fmt::format("`{}` cannot stand beside `{}`", reader.path_of(other), reader.path_of("file")));
    }
    reader.finish();
    return motion;
  }
  if (reader.find("velocity")) motion.velocity = reader.vector("velocity", kinds::speed);
  motion.ramp = reader.number("ramp", {kinds::time, not_negative}, 0.0);
  if (const toml::array* harmonics = reader.find_array("harmonics")) {
    for (std::size_t i = 0; i < harmonics->size(); ++i) {
      motion.harmonics.push_back(read_harmonic(document, (*harmonics)[i], fmt::format("{}.{}", reader.path_of("harmonics"), i)));
    }
  }
  reader.finish();
  return motion;
}

/// Keys that only a free point has: mass, weight and forces of a held point would change nothing.
void refuse_body_keys(TableReader& point) {
  for (const char* key : {"mass", "wet_weight", "volume", "drag_area", "added_mass", "thrust"}) {
    if (!point.find(key)) continue;
    point.error_at(key, fmt::format("`{}` has no effect on a point that is held", point.path_of(key)), "only a free point has it",
                   {"write `free = true`, or remove this key"});
  }
}

PointSpec read_point(Document& document, const toml::key& key, const toml::table& table) {
  PointSpec point;
  point.name = std::string(key.str());
  TableReader reader(document, table, "points." + point.name);
  point.place = reader.place();
  point.free = reader.boolean("free", false);
  const toml::table* motion = reader.find_table("motion");
  if (motion != nullptr) point.motion = read_motion(document, *motion, reader.path_of("motion"));
  const bool follows_file = motion != nullptr && motion->contains("file");
  if (!follows_file || reader.find("position")) point.position = reader.vector("position", kinds::length);
  if (follows_file) point.position = point.motion->file ? point.motion->file->value.front() : Vec3::Constant(std::nan(""));
  if (point.free) {
    if (motion != nullptr) reader.error_at("motion", fmt::format("`{}` is free: it cannot have a motion", "points." + point.name));
    point.body = read_body(reader);
    point.body.force = read_time_force(reader, "thrust", kinds::force);
  } else {
    refuse_body_keys(reader);
  }
  reader.finish();
  return point;
}

TimeTable read_time_table(TableReader& reader, const Kind& kind) {
  TimeTable table;
  const std::size_t interpolation = reader.choice("interpolation", {"linear", "cubic"});
  table.interpolation = interpolation == 0 ? TimeTable::Interpolation::linear : TimeTable::Interpolation::cubic;
  const toml::array* rows = reader.find_array("table");
  if (rows == nullptr) return table;
  if (rows->size() < 2) reader.error_at("table", fmt::format("`{}` needs at least two rows [t, x, y, z]", reader.path_of("table")));
  for (std::size_t i = 0; i < rows->size(); ++i) {
    const std::string path = fmt::format("{}.{}", reader.path_of("table"), i);
    const toml::node& row = (*rows)[i];
    const std::vector<double> values = read_numbers(reader.document(), row, {{kinds::time}, {kind}, {kind}, {kind}}, path);
    if (values.empty()) continue;
    if (!table.time.empty() && values[0] <= table.time.back()) {
      reader.document().error(row.source(), fmt::format("the times of `{}` must increase from row to row", reader.path_of("table")),
                              fmt::format("{:g} s after {:g} s", values[0], table.time.back()));
    }
    table.time.push_back(values[0]);
    table.value.emplace_back(values[1], values[2], values[3]);
  }
  return table;
}

}  // namespace

TimeForce read_time_force(TableReader& table, std::string_view key, const Kind& kind) {
  TimeForce out;
  const toml::node* node = table.find(key);
  if (node == nullptr) return out;
  if (!node->is_table()) {
    out.constant = read_vector(table.document(), *node, kind, table.path_of(key));
    return out;
  }
  TableReader reader(table.document(), *node->as_table(), table.path_of(key));
  const std::string pulse = kind.dimension == kinds::moment.dimension ? "moment" : "force";
  if (reader.find("table")) {
    out.table = read_time_table(reader, kind);
  } else if (reader.find(pulse)) {
    TimeForce::Pulse& shaped = out.pulse.emplace(TimeForce::Pulse{});
    shaped.force = reader.vector(pulse, kind);
    if (reader.require("shape")) reader.choice("shape", {"sin2"});
    shaped.duration = reader.number("duration", {kinds::time, positive});
  } else {
    for (const char* known : {"interpolation", "shape", "duration"}) reader.find(known);
    table.error_at(
        key, fmt::format("`{}` must be [x, y, z], {{ table, interpolation }} or {{ {}, shape = \"sin2\", duration }}", table.path_of(key), pulse));
  }
  reader.finish();
  return out;
}

BodySpec read_body(TableReader& table) {
  BodySpec body;
  body.mass = table.number("mass", {kinds::mass, not_negative}, 0.0);
  body.wet_weight = table.maybe_number("wet_weight", {kinds::force});
  body.volume = table.maybe_number("volume", {kinds::volume, not_negative});
  body.drag_area = table.number("drag_area", {kinds::area, not_negative}, 0.0);
  body.added_mass = table.number("added_mass", {kinds::mass, not_negative}, 0.0);
  if (body.wet_weight && body.volume) {
    table.error_at("volume", fmt::format("`{}` cannot stand beside `{}`", table.path_of("volume"), table.path_of("wet_weight")),
                   "give one of the two");
  }
  return body;
}

std::vector<PointSpec> read_points(TableReader& scene) { return read_named<PointSpec>(scene, "points", "point", read_point); }

}  // namespace hawser
