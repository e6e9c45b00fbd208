// The program run as a user runs it, in a folder of its own.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/solver/app/scene_text.hpp"

namespace hawser::test {

/// 100 m of rope under a heaving point, with a weight below: 10 elements, 1 s in 20 steps.
inline const std::string small_scene = R"(title = "small"
[environment]
water_density = 1000.0
[line_types.rope]
diameter = 0.04
mass = 2.5
EA = 4.0e7
drag = { normal = 1.2, tangential = 0.02 }
[points.top]
position = [0.0, 0.0, 0.0]
motion = { ramp = 1.0, harmonics = [ { direction = [0, 0, 1], amplitude = 0.5, period = 2.0 } ] }
[points.end]
free = true
position = [0.0, 0.0, -90.0]
mass = 100.0
[lines.a]
from = "top"
to = "end"
sections = [{ type = "rope", length = 100.0, elements = 10 }]
[dynamics]
duration = 1.0
step = 0.05
output_interval = 0.1
fields_interval = 0.5
[output]
stations = { a = [50.0, 93.1] }
)";

/// Slack, without weight, current or load: no equilibrium can be told from another.
inline const std::string slack_scene = R"([environment]
gravity = 0.0
water_density = 0.0
[line_types.thread]
diameter = 0.01
mass = 0.1
EA = 1.0e5
[points.a]
position = [0.0, 0.0, 0.0]
[points.b]
position = [90.0, 0.0, 0.0]
[lines.a]
from = "a"
to = "b"
sections = [{ type = "thread", length = 100.0, elements = 10 }]
[dynamics]
duration = 1.0
step = 0.1
)";

inline std::string contents(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

struct Outcome {
  int code = -1;
  std::string out, err;
  nlohmann::json json() const { return nlohmann::json::parse(out); }
};

class ProgramTest : public SceneFolder {
 protected:
  /// Runs `hawser ARGUMENTS` in the folder of the test.
  Outcome hawser(const std::string& arguments, const std::string& environment = "") const {
    const std::string command =
        "cd '" + folder_.string() + "' && " + environment + " '" HAWSER_PROGRAM "' " + arguments + " > stdout.txt 2> stderr.txt < /dev/null";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contents(folder_ / "stdout.txt"), contents(folder_ / "stderr.txt")};
  }

  bool exists(const std::string& name) const { return std::filesystem::exists(folder_ / name); }
};

}  // namespace hawser::test
