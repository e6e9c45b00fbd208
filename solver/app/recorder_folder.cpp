#include "solver/app/recorder_folder.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <utility>

#include "solver/app/diagnostics.hpp"

namespace hawser {
namespace fs = std::filesystem;
namespace {

/// The deepest part of the path that exists already.
fs::path existing_ancestor(fs::path path) {
  path = fs::absolute(path);
  while (!fs::exists(path) && path.has_relative_path()) path = path.parent_path();
  return path;
}

/// Removes a folder that an earlier command wrote: only the files hawser writes, so that nobody else's are lost.
void discard(const fs::path& folder) {
  for (const char* name : {"series.csv", "result.h5", "summary.json", "static.json", "profile.png", "tension.png", "tension_history.png", "curve.csv",
                           "curve.json", "curve.png"}) {
    fs::remove(folder / name);
  }
  fs::remove_all(folder / "plots");
  std::error_code not_empty;
  fs::remove(folder, not_empty);
}

}  // namespace

OutputFolder::OutputFolder(fs::path directory) : directory_(std::move(directory)), running_(directory_ / "running") {
  const fs::path ancestor = existing_ancestor(directory_);
  if (!fs::is_directory(ancestor)) throw InputError(fmt::format("--out {}: {} is not a folder", directory_.string(), ancestor.string()));
  if (access(ancestor.c_str(), W_OK | X_OK) != 0)
    throw InputError(fmt::format("--out {}: may not write to {}", directory_.string(), ancestor.string()));
}

const fs::path& OutputFolder::begin() {
  for (const char* name : {"running", "partial", "failed"}) discard(directory_ / name);
  fs::create_directories(running_);
  return running_;
}

fs::path OutputFolder::move_to(const fs::path& target) {
  fs::create_directories(target);
  for (const fs::directory_entry& entry : fs::directory_iterator(running_)) fs::rename(entry.path(), target / entry.path().filename());
  fs::remove(running_);
  return target;
}

fs::path OutputFolder::commit() { return move_to(directory_); }

fs::path OutputFolder::keep_as(const std::string& name) { return move_to(directory_ / name); }

}  // namespace hawser
