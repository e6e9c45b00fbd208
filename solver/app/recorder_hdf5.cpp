#include "solver/app/recorder_hdf5.hpp"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <functional>
#include <limits>

#include "solver/app/diagnostics.hpp"
#include "solver/app/recorder_hdf5_handle.hpp"

namespace hawser {
using hdf5::Growing;
using hdf5::Handle;

void TensionRange::add(const Line& line, const LineResult& result) {
  const std::size_t ends = 2 * static_cast<std::size_t>(line.elements);
  if (count == 0) {
    s.resize(ends);
    low.assign(ends, std::numeric_limits<double>::infinity());
    high.assign(ends, -std::numeric_limits<double>::infinity());
    sum.assign(ends, 0.0);
  }
  for (std::size_t i = 0; i < ends; ++i) {
    const std::size_t node = (i + 1) / 2;
    const double tension = i % 2 == 0 ? result.tension_right[node] : result.tension_left[node];
    s[i] = line.s[node];
    low[i] = std::min(low[i], tension);
    high[i] = std::max(high[i], tension);
    sum[i] += tension;
  }
  ++count;
}

std::vector<double> TensionRange::mean() const {
  std::vector<double> result = sum;
  for (double& value : result) value /= static_cast<double>(count);
  return result;
}

namespace {

std::string now_in_utc() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm utc{};
  gmtime_r(&now, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text;
}

/// Errors are reported by our own exceptions, not by the library's stack print.
void quiet_hdf5() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

std::string group_of(const Line& line) { return "/lines/" + line.name; }

struct LineFields {
  LineFields(hid_t file, const Line& line)
      : group(hdf5::create_group(file, group_of(line))),
        position(group, "position", {nodes(line), 3}),
        velocity(group, "velocity", {nodes(line), 3}),
        tension(group, "tension", {nodes(line)}),
        curvature(group, "curvature", {nodes(line)}) {
    if (line.family != Family::bar) slope = std::make_unique<Growing>(group, "slope", std::vector<hsize_t>{nodes(line), 3});
    hdf5::write_doubles(group, "s", line.s);
    hdf5::set_attribute(group, "family", std::string(name_of(line.family)));
  }

  static hsize_t nodes(const Line& line) { return static_cast<hsize_t>(line.nodes); }

  Handle group;
  Growing position, velocity, tension, curvature;
  std::unique_ptr<Growing> slope;
};

}  // namespace

struct ResultFile::Impl {
  Impl(const std::filesystem::path& path, const Model& m)
      : model(m),
        file((quiet_hdf5(), H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT)), H5Fclose, "create " + path.string()),
        solver(hdf5::create_group(file, "/solver")),
        time(file, "/time", {}) {
    for (const Line& line : model.lines) lines.emplace_back(file, line);
  }

  void append_line(int index, const State& state);

  const Model& model;
  Handle file, solver;
  Growing time;
  std::vector<LineFields> lines;
};

void ResultFile::Impl::append_line(int index, const State& state) {
  LineFields& fields = lines[static_cast<std::size_t>(index)];
  const std::vector<Station> nodes = observe_nodes(model, state, index);
  std::vector<double> row;
  const auto write = [&](Growing& field, const std::function<void(const Station&)>& add) {
    row.clear();
    for (const Station& node : nodes) add(node);
    field.append(row.data());
  };
  const auto add_vector = [&row](const Vec3& v) { row.insert(row.end(), v.data(), v.data() + 3); };
  write(fields.position, [&](const Station& node) { add_vector(node.position); });
  write(fields.velocity, [&](const Station& node) { add_vector(node.velocity); });
  write(fields.tension, [&](const Station& node) { row.push_back(node.tension); });
  write(fields.curvature, [&](const Station& node) { row.push_back(node.curvature); });
  if (!fields.slope) return;
  row.clear();
  for (int node = 0; node < model.lines[static_cast<std::size_t>(index)].nodes; ++node) {
    const double* slope = state.q.data() + model.dof(index, node) + 3;
    row.insert(row.end(), slope, slope + 3);
  }
  fields.slope->append(row.data());
}

ResultFile::ResultFile(const std::filesystem::path& path, const Scene& scene, const Model& model, const std::vector<std::string>& overrides,
                       std::string_view kind)
    : impl_(std::make_unique<Impl>(path, model)) {
  std::string override_text;
  for (const std::string& text : overrides) override_text += text + '\n';
  hdf5::write_text(impl_->file, "/scene", scene.text);
  hdf5::write_text(impl_->file, "/overrides", override_text);
  hdf5::set_attribute(impl_->file, "hawser_version", std::string(HAWSER_VERSION));
  hdf5::set_attribute(impl_->file, "created", now_in_utc());
  hdf5::set_attribute(impl_->file, "kind", std::string(kind));
  hdf5::set_attribute(impl_->file, "title", scene.title);
  hdf5::set_attribute(impl_->file, "scene_path", scene.path);
}

ResultFile::~ResultFile() = default;

void ResultFile::append(const State& state) {
  impl_->time.append(&state.t);
  for (int line = 0; line < static_cast<int>(impl_->lines.size()); ++line) impl_->append_line(line, state);
  hdf5::check(H5Fflush(impl_->file, H5F_SCOPE_LOCAL), "write to the disk");
}

void ResultFile::write_state(const State& state) {
  const Handle group = hdf5::create_group(impl_->file, "/state");
  hdf5::write_doubles(group, "q", state.q);
  hdf5::write_doubles(group, "v", state.v);
  hdf5::write_doubles(group, "a", state.a);
  hdf5::set_attribute(group, "t", H5T_NATIVE_DOUBLE, &state.t);
}

void ResultFile::write_range(const Line& line, const TensionRange& range) {
  const Handle group = hdf5::create_group(impl_->file, group_of(line) + "/envelope");
  hdf5::write_doubles(group, "s", range.s);
  hdf5::write_doubles(group, "tension_min", range.low);
  hdf5::write_doubles(group, "tension_mean", range.mean());
  hdf5::write_doubles(group, "tension_max", range.high);
}

void ResultFile::set_solver(const std::string& name, const Attribute& value) {
  if (const auto* number = std::get_if<double>(&value)) hdf5::set_attribute(impl_->solver, name, H5T_NATIVE_DOUBLE, number);
  if (const auto* count = std::get_if<long>(&value)) hdf5::set_attribute(impl_->solver, name, H5T_NATIVE_LONG, count);
  if (const auto* text = std::get_if<std::string>(&value)) hdf5::set_attribute(impl_->solver, name, *text);
}

void ResultFile::set_status(const std::string& status) { hdf5::set_attribute(impl_->file, "status", status); }

State read_last_state(const std::filesystem::path& path, const Model& model) {
  quiet_hdf5();
  State state;
  try {
    const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, "open it as an HDF5 file");
    for (const Line& line : model.lines) {
      if (hdf5::read_doubles(file, group_of(line) + "/s") != line.s)
        throw std::runtime_error(fmt::format("line {} has another mesh there", line.name));
    }
    const Handle group(H5Gopen2(file, "/state", H5P_DEFAULT), H5Gclose, "find /state");
    state.q = hdf5::read_doubles(group, "q");
    state.v = hdf5::read_doubles(group, "v");
    state.a = hdf5::read_doubles(group, "a");
    const Handle time(H5Aopen(group, "t", H5P_DEFAULT), H5Aclose, "find the time of /state");
    hdf5::check(H5Aread(time, H5T_NATIVE_DOUBLE, &state.t), "read the time of /state");
  } catch (const std::runtime_error& error) {
    throw InputError(fmt::format("{} is not a result on the mesh of this scene: {}", path.string(), error.what()));
  }
  const auto fits = [&model](const std::vector<double>& x) { return x.size() == model.unknowns; };
  if (!fits(state.q) || !fits(state.v) || !fits(state.a)) {
    throw InputError(fmt::format("{} holds {} unknowns, this scene has {}", path.string(), state.q.size(), model.unknowns));
  }
  return state;
}

}  // namespace hawser
