// hawser static: what an answer shows for itself, --probe and --method kinsol, from outside.
#include <algorithm>
#include <cmath>

#include "tests/solver/app/cli_program.hpp"

namespace hawser::test {
namespace {

using CliStatic = ProgramTest;
using Json = nlohmann::json;

/// A pipe of 10 m without weight, pushed together between clamps that face each other: nothing holds its bow in any direction around them.
const std::string bowed_scene = R"([environment]
gravity = 0.0
water_density = 0.0
[line_types.pipe]
diameter = 0.04
mass = 2.5
EA = 1.0e7
EI = 100.0
[points.a]
position = [0.0, 0.0, 0.0]
[points.b]
position = [9.0, 0.0, 0.0]
[lines.pipe]
from = "a"
to = "b"
sections = [ { type = "pipe", length = 10.0, elements = 20 } ]
from_end = { clamped = [1.0, 0.0, 0.0] }
to_end = { clamped = [1.0, 0.0, 0.0] }
)";

/// The same on a level bed that it is heavy enough to stay on: it can lie to either side.
const std::string laid_scene = with(
    with(with(bowed_scene, "gravity = 0.0", "gravity = 10.0\ndepth = 19.99\nseabed = { stiffness = 2.5e3 }"), "[0.0, 0.0, 0.0]", "[0.0, 0.0, -20.0]"),
    "[9.0, 0.0, 0.0]", "[9.0, 0.0, -20.0]");

TEST_F(CliStatic, TheCertificateSaysWhereTheTensionIsLeastAndHowMuchOfALineIsCompressed) {
  write("scene.toml", small_scene);
  const Json line = hawser("static scene.toml --json -q").json().at("lines").at("a");
  const std::vector<double> s = line.at("stations").at("s"), tension = line.at("stations").at("tension");
  const auto least = std::min_element(tension.begin(), tension.end()) - tension.begin();
  EXPECT_EQ(line.at("tension_min_s"), s.at(static_cast<std::size_t>(least)));
  EXPECT_EQ(line.at("compressed_length"), 0.0);
  EXPECT_LT(line.at("error_estimate").get<double>(), 1e-3);
  const std::string text = hawser("static scene.toml -q").out;
  for (const char* word : {"stable equilibrium", "least  at s [m]", "compressed", "error"}) EXPECT_NE(text.find(word), std::string::npos) << word;
}

TEST_F(CliStatic, AStableStateHasNoMode) {
  write("scene.toml", small_scene);
  const Json json = hawser("static scene.toml --json -q").json();
  EXPECT_EQ(json.at("stability"), "stable");
  EXPECT_TRUE(json.at("mode").is_null());
  EXPECT_FALSE(json.contains("probe"));
}

TEST_F(CliStatic, ANeutralStateComesWithItsMode) {
  write("scene.toml", bowed_scene);
  const Outcome outcome = hawser("static scene.toml --json -q");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Json json = outcome.json(), mode = json.at("mode");
  EXPECT_EQ(json.at("stability"), "neutral");
  EXPECT_EQ(mode.at("unstable_directions"), 0);
  EXPECT_EQ(mode.at("line"), "pipe");
  EXPECT_NEAR(mode.at("s").get<double>(), 5.0, 1e-9);  // a turn about the clamps moves the middle of the bow most
  // The mode is that turn: across the clamps, and across the bow, which lies in the plane of x and its middle.
  const Json &x = mode.at("shape").at("pipe").at("x"), &y = mode.at("shape").at("pipe").at("y"), &z = mode.at("shape").at("pipe").at("z");
  const Json &shape_y = json.at("lines").at("pipe").at("stations").at("y"), &shape_z = json.at("lines").at("pipe").at("stations").at("z");
  const double largest = std::hypot(shape_y.at(10).get<double>(), shape_z.at(10).get<double>());
  for (std::size_t i = 0; i < x.size(); ++i) {
    EXPECT_NEAR(x.at(i).get<double>(), 0.0, 1e-6) << i;
    const double along_bow = y.at(i).get<double>() * shape_y.at(i).get<double>() + z.at(i).get<double>() * shape_z.at(i).get<double>();
    EXPECT_NEAR(along_bow / largest, 0.0, 1e-6) << i;
    EXPECT_NEAR(std::hypot(y.at(i).get<double>(), z.at(i).get<double>()),
                std::hypot(shape_y.at(i).get<double>(), shape_z.at(i).get<double>()) / largest, 1e-6)
        << i;
  }
  const std::string text = hawser("static scene.toml -q").out;
  for (const char* word : {"neutral equilibrium", "softest mode", "nothing holds it"}) EXPECT_NE(text.find(word), std::string::npos) << word;
}

TEST_F(CliStatic, AnUnstableAnswerIsAFailureWithItsMode) {
  write("scene.toml", bowed_scene);
  const Outcome outcome = hawser("static scene.toml --json --start straight --method kinsol");
  EXPECT_EQ(outcome.code, 3);
  const Json json = outcome.json();
  EXPECT_FALSE(json.at("converged").get<bool>());
  EXPECT_EQ(json.at("stability"), "unstable");
  EXPECT_LT(json.at("mode").at("stiffness").get<double>(), 0.0);
  EXPECT_GT(json.at("mode").at("unstable_directions").get<int>(), 0);
  EXPECT_NEAR(json.at("mode").at("direction").at(0).get<double>(), 0.0, 1e-6);  // a straight column buckles sideways
  EXPECT_NE(outcome.err.find("softest mode"), std::string::npos);
}

TEST_F(CliStatic, ProbeListsTheDistinctEquilibria) {
  write("scene.toml", laid_scene);
  const Outcome outcome = hawser("static scene.toml --probe 10 --json -q");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Json json = outcome.json(), probe = json.at("probe"), equilibria = probe.at("equilibria");
  EXPECT_EQ(probe.at("starts"), 10);
  ASSERT_GE(equilibria.size(), 2u);
  int found = probe.at("failed");
  for (const Json& e : equilibria) {
    EXPECT_TRUE(e.at("stable").get<bool>());
    EXPECT_TRUE(e.at("energy").is_number());
    EXPECT_TRUE(e.at("lines").at("pipe").at("tension_from").is_number());
    found += e.at("found").get<int>();
  }
  EXPECT_EQ(found, 11);  // the answer counts its own start
  EXPECT_EQ(equilibria.at(0).at("distance"), 0.0);
  EXPECT_EQ(equilibria.at(0).at("lines").at("pipe").at("tension_to"), json.at("lines").at("pipe").at("tension_to"));
  for (std::size_t i = 1; i < equilibria.size(); ++i) EXPECT_GT(equilibria.at(i).at("distance"), probe.at("same_within"));
  const std::string text = hawser("static scene.toml --probe 10 -q").out;
  EXPECT_NE(text.find("distinct equilibria"), std::string::npos);
}

TEST_F(CliStatic, ProbeSaysWhereItFoundNoOther) {
  write("scene.toml", small_scene);
  const std::string text = hawser("static scene.toml --probe 5 -q").out;
  EXPECT_NE(text.find("no other equilibrium was found"), std::string::npos) << text;
}

TEST_F(CliStatic, KinsolGivesTheDocumentOfNewton) {
  write("scene.toml", with(small_scene, "[line_types", "current = [[0.0, 0.5, 30.0]]\n[line_types"));
  const Json newton = hawser("static scene.toml --json -q").json(), kinsol = hawser("static scene.toml --json -q --method kinsol").json();
  EXPECT_NE(kinsol.at("stages").at(0).get<std::string>().find("KINSOL"), std::string::npos);
  EXPECT_NE(newton.at("stages").at(0).get<std::string>().find("Newton"), std::string::npos);
  const double expected = newton.at("lines").at("a").at("tension_from");
  EXPECT_NEAR(kinsol.at("lines").at("a").at("tension_from").get<double>(), expected, 1e-9 * expected);  // ten times the tolerance of both
  for (const auto& [key, value] : newton.items()) EXPECT_TRUE(kinsol.contains(key)) << key;
}

}  // namespace
}  // namespace hawser::test
