#include "solver/app/scene_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "solver/app/scene_checks.hpp"
#include "solver/app/scene_parts.hpp"

namespace hawser {

std::string file_name(TableReader& table) {
  const std::string file = table.text("file");
  if (!file.ends_with(".h5")) return file;
  table.not_built("file", fmt::format("a start from a result file (`{}`)", table.path_of("file")), "name a CSV file");
  return {};
}

void check_name(Document& document, const toml::key& key, const std::string& what) {
  const std::string_view name = key.str();
  const auto allowed = [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-' || c >= 0x80; };
  if (!name.empty() && std::all_of(name.begin(), name.end(), allowed)) return;
  document.error(key.source(), fmt::format("`{}` cannot be the name of a {}", name, what), "not a usable name",
                 {"a name has letters, digits, `_` and `-` only: it becomes part of column titles"});
}

Scene read_scene(const std::string& path, const std::vector<std::string>& overrides, std::vector<Diagnostic>* warnings) {
  Document document(path, overrides);
  TableReader root(document, document.root(), "");
  Scene scene;
  scene.title = root.text("title", "");
  scene.path = path;
  scene.text = document.text();
  scene.environment = read_environment(root);
  scene.line_types = read_line_types(root);
  scene.points = read_points(root);
  scene.lines = read_lines(root);
  scene.solve = read_solve(root);
  scene.dynamics = read_dynamics(root);
  scene.output = read_output(root);
  root.finish();
  check_scene(scene, document);
  if (document.failed()) throw InputError(document.diagnostics());
  if (warnings != nullptr) *warnings = document.diagnostics();
  if (warnings == nullptr) {
    for (const Diagnostic& warning : document.diagnostics()) fmt::print(stderr, "{}\n", render(warning));
  }
  return scene;
}

}  // namespace hawser
