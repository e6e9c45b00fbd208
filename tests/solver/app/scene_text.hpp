// Scenes written by tests: a folder of its own for each test, and a small sound scene to change.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "solver/app/scene_reader.hpp"

namespace hawser::test {

/// A scene that reads without a warning. Lines are numbered for the tests that expect a place.
inline const std::string sound_scene = R"(title = "sound"
[environment]
water_density = 1000.0
[line_types.rope]
diameter = 0.04
mass = 2.5
EA = 4.0e7
[points.top]
position = [0.0, 0.0, 0.0]
[points.end]
free = true
position = [0.0, 0.0, -90.0]
mass = 100.0
[lines.a]
from = "top"
to = "end"
sections = [{ type = "rope", length = 100.0, elements = 10 }]
[dynamics]
duration = 10.0
step = 0.1
)";

/// `text` with the first occurrence of `from` replaced; the test fails where there is none.
inline std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

class SceneFolder : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string("hawser_") + info->test_suite_name() + "_" + info->name() + "_" + std::to_string(::getpid());
    for (char& c : name) c = c == '/' ? '_' : c;
    folder_ = std::filesystem::temp_directory_path() / name;
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return path(name);
  }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  Scene read(const std::string& text, const std::vector<std::string>& overrides = {}) {
    warnings_.clear();
    return read_scene(write("scene.toml", text), overrides, &warnings_);
  }

  /// The printed text of the errors, empty where the scene reads.
  std::string errors(const std::string& text, const std::vector<std::string>& overrides = {}) {
    try {
      read(text, overrides);
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  }

  std::filesystem::path folder_;
  std::vector<Diagnostic> warnings_;
};

}  // namespace hawser::test
