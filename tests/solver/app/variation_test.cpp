// KEY=a:b:n and what is wrong with it.
#include "solver/app/variation.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "solver/app/diagnostics.hpp"

namespace hawser::test {
namespace {

std::string refusal(const std::string& text) {
  try {
    parse_variation("--vary", text);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(Variation, ValuesAreEvenAndEndExactlyAtTheBounds) {
  const Variation vary = parse_variation("--vary", "points.top.position.0=-0.1:0.2:4");
  EXPECT_EQ(vary.key, "points.top.position.0");
  EXPECT_EQ(vary.count, 4);
  EXPECT_EQ(vary.value(0), -0.1);
  EXPECT_NEAR(vary.value(1), 0.0, 1e-16);  // rounding of -0.1 + 0.3/3
  EXPECT_NEAR(vary.value(2), 0.1, 1e-16);
  EXPECT_EQ(vary.value(3), 0.2);
}

TEST(Variation, EveryValueIsAnOverride) {
  const Variation elements = parse_variation("--vary", "lines.a.sections.0.elements=10:30:3");
  EXPECT_EQ(elements.override_at(1), "lines.a.sections.0.elements=20");
  EXPECT_EQ(parse_variation("--vary", "x=1:2:3").override_at(1), "x=1.5");
  EXPECT_EQ(parse_variation("--vary", "x=0:-1e30:2").override_at(1), "x=-1e+30");
}

TEST(Variation, AUnitIsKeptWithEveryValue) {
  const Variation vary = parse_variation("--vary", "environment.depth = 1 km : 2 km : 3");
  EXPECT_EQ(vary.unit, "km");
  EXPECT_EQ(vary.override_at(0), "environment.depth=1 km");
  EXPECT_EQ(vary.override_at(1), "environment.depth=1.5 km");
}

TEST(Variation, EachFaultIsSaidInItsOwnWords) {
  const std::vector<std::pair<std::string, std::string>> faults{{"depth", "no key with a range"},
                                                                {"=1:2:3", "no key with a range"},
                                                                {"points.top.position[0]=1:2:3", "position.0 and not position[0]"},
                                                                {"depth=1:2", "this has 2"},
                                                                {"depth=1:2:3:4", "this has 4"},
                                                                {"depth=:2:3", "the first value `` is not a number"},
                                                                {"depth=1:two:3", "the last value `two` is not a number"},
                                                                {"depth=nan:2:3", "the first value `nan`"},
                                                                {"depth=1:inf:3", "the last value `inf`"},
                                                                {"depth=1 km:2000 m:3", "the same unit"},
                                                                {"depth=1:2 km:3", "the same unit"},
                                                                {"depth=5:5:3", "are the same"},
                                                                {"depth=-1e308:1e308:3", "too wide"},
                                                                {"depth=1:2:1", "from 2 to 1000000, not `1`"},
                                                                {"depth=1:2:-3", "not `-3`"},
                                                                {"depth=1:2:2.5", "not `2.5`"},
                                                                {"depth=1:2:", "not ``"},
                                                                {"depth=1:2:99999999999", "not `99999999999`"}};
  for (const auto& [text, message] : faults) {
    const std::string said = refusal(text);
    EXPECT_NE(said.find(message), std::string::npos) << text << ": " << said;
    EXPECT_NE(said.find("--vary " + text), std::string::npos) << said;
    EXPECT_NE(said.find("KEY=a:b:n"), std::string::npos) << said;
  }
}

}  // namespace
}  // namespace hawser::test
