#include "solver/app/diagnostics.hpp"

#include <gtest/gtest.h>

namespace hawser {
namespace {

Diagnostic typo() {
  Diagnostic d;
  d.message = "unknown key `curent` in `environment`";
  d.where = "scene.toml";
  d.place = {44, 3};
  d.source = "  curent = 1";
  d.source_column = 3;
  d.width = 6;
  d.label = "did you mean `current`?";
  d.notes = {"allowed: gravity, current"};
  return d;
}

TEST(Diagnostics, PointAtTheOffendingText) {
  EXPECT_EQ(render(typo()),
            "error: unknown key `curent` in `environment`\n"
            "  --> scene.toml:44:3\n"
            "   |\n"
            "44 |   curent = 1\n"
            "   |   ^^^^^^ did you mean `current`?\n"
            "   = allowed: gravity, current\n");
}

TEST(Diagnostics, KeepTabsAndCountCharactersNotBytes) {
  Diagnostic d = typo();
  d.source = "\té = curent";
  d.source_column = 6;
  EXPECT_NE(render(d).find("\n   | \t    ^^^^^^ did"), std::string::npos) << render(d);
}

TEST(Diagnostics, CloseWithTheNumberOfErrors) {
  Diagnostic warning = typo();
  warning.severity = Severity::warning;
  const InputError one({typo(), warning}), two({typo(), typo()});
  EXPECT_TRUE(std::string(one.what()).ends_with("\n1 error. Nothing was run.\n")) << one.what();
  EXPECT_TRUE(std::string(two.what()).ends_with("\n2 errors. Nothing was run.\n")) << two.what();
  EXPECT_NE(std::string(one.what()).find("\nwarning: unknown key"), std::string::npos);
  EXPECT_EQ(two.diagnostics().size(), 2u);
}

TEST(Diagnostics, ShowAtMostFifty) {
  const InputError many(std::vector<Diagnostic>(60, typo()));
  EXPECT_NE(std::string(many.what()).find("... and 10 more"), std::string::npos);
  EXPECT_TRUE(std::string(many.what()).ends_with("60 errors. Nothing was run.\n"));
}

TEST(Diagnostics, NeedNoPlace) {
  EXPECT_STREQ(InputError("no scene file given").what(), "error: no scene file given\n\n1 error. Nothing was run.\n");
}

TEST(DidYouMean, FindsSlipsOfTheFinger) {
  const std::vector<std::string> keys{"length", "elements", "type", "mass", "EA", "EI"};
  EXPECT_EQ(nearest("lenght", keys), "length");
  EXPECT_EQ(nearest("element", keys), "elements");
  EXPECT_EQ(nearest("typ", keys), "type");
  EXPECT_EQ(nearest("Mass", keys), "mass");
  EXPECT_EQ(nearest("ea", keys), "EA");
  EXPECT_EQ(did_you_mean("lenght", keys), "did you mean `length`?");
}

TEST(DidYouMean, IsSilentWhenNothingIsNear) {
  const std::vector<std::string> keys{"length", "elements", "EA"};
  EXPECT_EQ(nearest("colour", keys), "");
  EXPECT_EQ(nearest("xy", keys), "");
  EXPECT_EQ(nearest("", keys), "");
  EXPECT_EQ(nearest(std::string(100000, 'x'), keys), "");
  EXPECT_EQ(did_you_mean("colour", {}), "");
}

}  // namespace
}  // namespace hawser
