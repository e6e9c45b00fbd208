// [environment], [solve], [dynamics] and [output].
#include <fmt/format.h>

#include <algorithm>

#include "solver/app/scene_parts.hpp"
#include "solver/app/table_file.hpp"

namespace hawser {
namespace {

std::vector<CurrentRow> read_current(TableReader& environment) {
  std::vector<CurrentRow> current;
  const toml::array* rows = environment.find_array("current");
  if (rows == nullptr) return current;
  for (std::size_t i = 0; i < rows->size(); ++i) {
    const toml::node& node = (*rows)[i];
    const std::string path = fmt::format("{}.{}", environment.path_of("current"), i);
    const std::vector<double> row = read_numbers(environment.document(), node, {{kinds::length}, {kinds::speed}, {kinds::angle}}, path);
    if (row.empty()) continue;
    const auto same = [&](const CurrentRow& other) { return other.z == row[0]; };
    if (std::any_of(current.begin(), current.end(), same)) {
      environment.document().error(node.source(), fmt::format("`{}` repeats the z of another row", environment.path_of("current")),
                                   fmt::format("z = {:g} m again", row[0]), {"a row is [z, speed, heading]"});
    }
    current.push_back({row[0], row[1], row[2]});
  }
  std::sort(current.begin(), current.end(), [](const CurrentRow& a, const CurrentRow& b) { return a.z < b.z; });
  return current;
}

std::optional<StartTable> read_start_table(TableReader& start) {
  const std::string file = file_name(start);
  if (file.empty()) return std::nullopt;
  const std::vector<std::string> columns{"line", "s", "x", "y", "z", "vx", "vy", "vz"};
  const TableFile rows = read_table_file(start.document(), *start.find("file"), file, columns, FirstColumn::name);
  if (rows.rows.empty()) return std::nullopt;
  StartTable table;
  for (const TableFile::Row& row : rows.rows) {
    const std::vector<double>& v = row.value;
    table.rows.push_back({row.name, v[0], Vec3(v[1], v[2], v[3]), Vec3(v[4], v[5], v[6])});
  }
  return table;
}

void read_start(TableReader& dynamics, DynamicsSpec& spec) {
  const toml::node* node = dynamics.find("start");
  if (node == nullptr) return;
  if (!node->is_table()) {
    spec.start = dynamics.choice("start", {"equilibrium", "straight"}) == 0 ? StartChoice::equilibrium : StartChoice::straight;
    return;
  }
  TableReader start(dynamics.document(), *node->as_table(), dynamics.path_of("start"));
  spec.start = StartChoice::file;
  spec.start_table = read_start_table(start);
  start.finish();
}

double read_step(TableReader& dynamics) {
  if (dynamics.find("step") && !dynamics.holds_word("step", "auto")) return dynamics.number("step", {kinds::time, positive});
  dynamics.not_built("step", "a time step chosen by the program (`dynamics.step` absent or \"auto\")", "write the step in seconds");
  return std::nan("");
}

}  // namespace

Environment read_environment(TableReader& scene) {
  Environment environment;
  const toml::table* table = scene.find_table("environment");
  if (table == nullptr) return environment;
  TableReader reader(scene.document(), *table, "environment");
  environment.gravity = reader.number("gravity", {kinds::acceleration, not_negative}, environment.gravity);
  environment.water_density = reader.number("water_density", {kinds::density, not_negative}, environment.water_density);
  environment.depth = reader.maybe_number("depth", {kinds::length, positive});
  environment.current = read_current(reader);
  environment.seabed = read_seabed(reader);
  reader.finish();
  return environment;
}

SolveSpec read_solve(TableReader& scene) {
  SolveSpec solve;
  const toml::table* table = scene.find_table("solve");
  if (table == nullptr) return solve;
  const std::vector<std::string> solvers{"auto", "chain", "band", "cholmod", "umfpack", "klu"};
  TableReader reader(scene.document(), *table, "solve");
  solve.accuracy = reader.number("accuracy", {kinds::number, {0.0, 1.0, true}}, solve.accuracy);
  if (!reader.holds_word("newton_tolerance", "auto")) {
    solve.newton_tolerance = reader.maybe_number("newton_tolerance", {kinds::number, {0.0, 1.0, true}});
  }
  solve.linear_solver = solvers[reader.choice("linear_solver", solvers)];
  solve.threads = reader.integer("threads", 0, 4096, solve.threads);
  reader.finish();
  return solve;
}

std::optional<DynamicsSpec> read_dynamics(TableReader& scene) {
  const toml::table* table = scene.find_table("dynamics");
  if (table == nullptr) return std::nullopt;
  DynamicsSpec spec;
  TableReader reader(scene.document(), *table, "dynamics");
  spec.duration = reader.number("duration", {kinds::time, positive});
  spec.step = read_step(reader);
  spec.spectral_radius = reader.number("spectral_radius", {kinds::number, {0.0, 1.0, false}}, spec.spectral_radius);
  spec.output_interval = reader.number("output_interval", {kinds::time, positive}, spec.output_interval);
  spec.fields_interval = reader.number("fields_interval", {kinds::time, positive}, spec.fields_interval);
  if (reader.holds_word("integrator", "ida")) {
    reader.not_built("integrator", "the integrator \"ida\"", "write \"generalized-alpha\"");
  } else {
    reader.choice("integrator", {"generalized-alpha"});
  }
  read_start(reader, spec);
  reader.finish();
  return spec;
}

OutputSpec read_output(TableReader& scene) {
  OutputSpec output;
  const toml::table* table = scene.find_table("output");
  if (table == nullptr) return output;
  TableReader reader(scene.document(), *table, "output");
  if (const toml::table* stations = reader.find_table("stations")) {
    for (const auto& [key, node] : in_file_order(*stations)) {
      const std::string path = fmt::format("output.stations.{}", key->str());
      const toml::array* list = node->as_array();
      if (list == nullptr) {
        scene.document().error(node->source(), fmt::format("`{}` must be a list of arc lengths", path), fmt::format("this is {}", type_of(*node)));
        continue;
      }
      std::vector<double> s;
      for (std::size_t i = 0; i < list->size(); ++i) {
        s.push_back(read_number(scene.document(), (*list)[i], {kinds::length, not_negative}, fmt::format("{}.{}", path, i)));
      }
      output.stations.emplace_back(std::string(key->str()), std::move(s));
    }
  }
  reader.finish();
  return output;
}

}  // namespace hawser
