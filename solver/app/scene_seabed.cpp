// [environment.seabed]: the law of contact, friction, soundings.
#include <fmt/format.h>

#include <algorithm>

#include "solver/app/scene_parts.hpp"
#include "solver/app/table_file.hpp"

namespace hawser {
namespace {

void read_friction(TableReader& seabed, SeabedSpec& spec) {
  const toml::node* friction = seabed.find("friction");
  if (friction == nullptr || !friction->is_table()) {
    spec.friction_axial = spec.friction_lateral = seabed.number("friction", {kinds::number, not_negative}, 0.0);
    return;
  }
  TableReader both(seabed.document(), *friction->as_table(), seabed.path_of("friction"));
  spec.friction_axial = both.number("axial", {kinds::number, not_negative});
  spec.friction_lateral = both.number("lateral", {kinds::number, not_negative});
  both.finish();
}

std::vector<double> sorted_column(const TableFile& table, std::size_t column) {
  std::vector<double> values;
  for (const TableFile::Row& row : table.rows) values.push_back(row.value[column]);
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

std::size_t position_in(const std::vector<double>& sorted, double value) {
  return static_cast<std::size_t>(std::lower_bound(sorted.begin(), sorted.end(), value) - sorted.begin());
}

/// Rows of soundings in any order; together they must fill a rectangular grid, each place once.
std::optional<BathymetryGrid> grid_of(TableReader& reader, const TableFile& table) {
  BathymetryGrid grid{sorted_column(table, 0), sorted_column(table, 1), {}};
  const std::size_t nx = grid.x.size(), ny = grid.y.size(), wanted = nx * ny;
  if (nx < 2 || ny < 2) {
    reader.error_at("file", fmt::format("`{}` must hold a grid of at least two x and two y", table.path), fmt::format("it holds {} x {}", nx, ny));
    return std::nullopt;
  }
  if (table.rows.size() < wanted) {
    reader.error_at("file", fmt::format("the soundings of `{}` must fill a grid: every x with every y", table.path),
                    fmt::format("{} x and {} y need {} rows, it has {}", nx, ny, wanted, table.rows.size()));
    return std::nullopt;
  }
  grid.z.assign(wanted, 0.0);
  std::vector<int> line(wanted, 0);
  for (const TableFile::Row& row : table.rows) {
    const std::size_t at = position_in(grid.y, row.value[1]) * nx + position_in(grid.x, row.value[0]);
    if (line[at] != 0) {
      report_row(reader.document(), table, row, fmt::format("x = {:g}, y = {:g} again: it stands in line {}", row.value[0], row.value[1], line[at]));
      return std::nullopt;
    }
    line[at] = row.line;
    grid.z[at] = row.value[2];
  }
  return grid;
}

std::optional<BathymetryGrid> read_bathymetry(TableReader& seabed) {
  const toml::table* table = seabed.find_table("bathymetry");
  if (table == nullptr) return std::nullopt;
  TableReader reader(seabed.document(), *table, seabed.path_of("bathymetry"));
  const std::string file = reader.text("file");
  reader.finish();
  if (file.empty()) return std::nullopt;
  const TableFile rows = read_table_file(reader.document(), *reader.find("file"), file, {"x", "y", "z"}, FirstColumn::number);
  if (rows.rows.empty()) return std::nullopt;
  return grid_of(reader, rows);
}

}  // namespace

SeabedSpec read_seabed(TableReader& environment) {
  SeabedSpec spec;
  const toml::table* table = environment.find_table("seabed");
  if (table == nullptr) return spec;
  TableReader seabed(environment.document(), *table, environment.path_of("seabed"));
  spec.stiffness = seabed.number("stiffness", {kinds::force_per_area, positive}, spec.stiffness);
  spec.smoothing = seabed.number("smoothing", {kinds::length, not_negative}, spec.smoothing);
  spec.damping = seabed.number("damping", {kinds::damping_per_area, not_negative}, spec.damping);
  spec.slip = seabed.number("slip", {kinds::length, positive}, spec.slip);
  read_friction(seabed, spec);
  const bool depth = environment.find("depth") != nullptr, bathymetry = seabed.find("bathymetry") != nullptr;
  if (depth && bathymetry) {
    seabed.error_at("bathymetry", fmt::format("`{}` and `environment.depth` both say where the bed is", seabed.path_of("bathymetry")),
                    "remove one of them");
  } else if (bathymetry) {
    spec.bathymetry = read_bathymetry(seabed);
  } else if (!depth) {
    environment.error_at("seabed", "`environment.seabed` needs `environment.depth`, or a `bathymetry`");
  }
  seabed.finish();
  return spec;
}

}  // namespace hawser
