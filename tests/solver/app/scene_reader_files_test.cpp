// Files that are not what they should be, and overrides.
#include <random>

#include "assembly/model.hpp"
#include "tests/solver/app/scene_text.hpp"

namespace hawser {
namespace {

using test::sound_scene;
using test::with;

using ReaderFiles = test::SceneFolder;
using ReaderOverrides = test::SceneFolder;

std::string refusal(const std::string& path) {
  try {
    read_scene(path);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST_F(ReaderFiles, ThatCannotBeReadAreNamed) {
  EXPECT_NE(refusal(path("nothing.toml")).find("the scene file does not exist\n --> " + path("nothing.toml")), std::string::npos);
  EXPECT_NE(refusal(folder_.string()).find("the scene file is a directory"), std::string::npos);
  EXPECT_NE(refusal("/dev/zero").find("the scene file is not a regular file"), std::string::npos);
  EXPECT_NE(refusal(path(std::string(5000, 'x'))).find("1 error. Nothing was run.\n"), std::string::npos);
  EXPECT_NE(refusal("").find("the scene file does not exist"), std::string::npos);
}

TEST_F(ReaderFiles, WithoutPermissionAreNamed) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may read everything";
  const std::string file = write("secret.toml", sound_scene);
  std::filesystem::permissions(file, std::filesystem::perms::none);
  EXPECT_NE(refusal(file).find("cannot be opened"), std::string::npos);
}

TEST_F(ReaderFiles, OfHundredMegabytesAreRefusedUnread) {
  const std::string file = write("big.toml", "");
  std::filesystem::resize_file(file, 100u << 20);
  EXPECT_NE(refusal(file).find("is too large: 104857600 bytes, at most 16777216 are read"), std::string::npos);
}

TEST_F(ReaderFiles, OfNoiseAreRefused) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 200; ++trial) {
    std::string noise(5000, '\0');
    for (char& c : noise) c = static_cast<char>(random());
    EXPECT_NE(refusal(write("noise.toml", noise)), "accepted");
    for (char& c : noise) c = static_cast<char>(32 + random() % 95);
    EXPECT_NE(refusal(write("noise.toml", noise)), "accepted");
  }
  EXPECT_NE(refusal(write("zero.toml", std::string("a = 1\0\n", 7))).find("is a binary file, not text"), std::string::npos);
  EXPECT_NE(refusal(write("latin.toml", "title = \"caf\xE9\"\n")).find("latin.toml:1:1"), std::string::npos);
}

TEST_F(ReaderFiles, OfSoundingsMustFillAGrid) {
  const auto refused = [this](const std::string& rows) {
    write("bed.csv", rows);
    return errors(with(sound_scene, "water_density = 1000.0", "seabed = { bathymetry = { file = \"bed.csv\" } }"));
  };
  EXPECT_EQ(refused("x,y,z\n0,0,-100\n1,0,-100\n0,1,-100\n1,1,-100\n"), "");
  EXPECT_NE(refused("x,y,z\n0,0,-100\n1,0,-100\n0,1,-100\n").find("2 x and 2 y need 4 rows, it has 3"), std::string::npos);
  EXPECT_NE(refused("x,y,z\n0,0,-100\n1,0,-100\n").find("it holds 2 x 1"), std::string::npos);
  const std::string again = refused("x,y,z\n0,0,-100\n1,0,-100\n0,1,-100\n1,1,-100\n1,0,-99\n");
  EXPECT_NE(again.find("bed.csv:6:1"), std::string::npos) << again;
  EXPECT_NE(again.find("x = 1, y = 0 again: it stands in line 3"), std::string::npos) << again;
  EXPECT_NE(refused("x,y\n0,0\n").find("the first line must be `x,y,z`"), std::string::npos);
  EXPECT_NE(refused("x,y,z\n0,0,deep\n").find("bed.csv:2:5"), std::string::npos);
}

TEST_F(ReaderFiles, NestedAgainstTheStackAreRefused) {
  std::string dotted = "a", headers = "[a", quoted = "\",\"", lists = "a = ", tables = "a = ";
  for (int i = 0; i < 200000; ++i) {
    dotted += ".a";
    headers += ".a";
    quoted += ".\",\"";
    lists += "[";
    tables += "{a=";
  }
  for (const std::string& text : {dotted + "=1", headers + "]", quoted + "=1", lists, tables, "b = [\"\"\"x\"\"\"\", {" + dotted + "=1}]"}) {
    EXPECT_NE(refusal(write("deep.toml", text)), "accepted");
  }
}

TEST_F(ReaderFiles, HoldAnyCharacterInTextAndCommentsButNotElsewhere) {
  const auto title = [this](const std::string& written) { return read(with(sound_scene, "\"sound\"", written + " # é")).title; };
  EXPECT_EQ(title("\"Größe\""), "Größe");
  EXPECT_EQ(title("'Größe'"), "Größe");
  EXPECT_EQ(title("\"\"\"\nGröße\"\"\""), "Größe");
  EXPECT_EQ(title("\"\"\"one \\\n   two\"\"\""), "one two");
  EXPECT_EQ(title("\"\"\"one\\\n\"\"\""), "one");
  EXPECT_EQ(title("\"\"\"a \\\" \"b\"\"\"\""), "a \" \"b\"");
  const std::string key = errors(with(sound_scene, "title", "größe")), after = errors(with(sound_scene, "2.5", "2.5é"));
  EXPECT_NE(key.find("characters outside ASCII need quotes around them"), std::string::npos) << key;
  EXPECT_NE(key.find("scene.toml:1:3\n"), std::string::npos) << key;
  EXPECT_NE(after.find("scene.toml:6:11\n"), std::string::npos) << after;
  EXPECT_NE(errors(with(sound_scene, "\"sound\"", "\"\"\"one \\\n é\"\"\"")).find("line-ending backslash"), std::string::npos);
}

TEST_F(ReaderFiles, OfOneLongLineShowOnlyAPartOfIt) {
  const std::string report = refusal(write("long.toml", "title = [" + std::string(1000000, ' ') + "1, }"));
  EXPECT_LT(report.size(), 1000u);
  EXPECT_NE(report.find("long.toml:1:1000013"), std::string::npos) << report;
}

TEST_F(ReaderFiles, WithOneByteChangedBuildOrThrowInputError) {
  std::mt19937 random(42);
  int read_well = 0, refused = 0;
  for (const auto& entry : std::filesystem::directory_iterator(std::string(HAWSER_SOURCE_DIR) + "/data/scenes")) {
    std::ifstream stream(entry.path(), std::ios::binary);
    const std::string original{std::istreambuf_iterator<char>(stream), {}};
    ASSERT_FALSE(original.empty());
    for (int trial = 0; trial < 400; ++trial) {
      std::string text = original;
      text[random() % text.size()] = static_cast<char>(trial % 2 ? random() : 32 + random() % 95);
      try {
        std::vector<Diagnostic> warnings;
        const Scene scene = read_scene(write("mutant.toml", text), {}, &warnings);
        ++read_well;
        if (scene.lines[0].sections[0].elements > 2000) continue;
        EXPECT_GT(build_model(scene).unknowns, 0u);
      } catch (const InputError& error) {
        EXPECT_FALSE(error.diagnostics().empty());
        ++refused;
      }
    }
  }
  EXPECT_GT(read_well, 500);  // comments, digits
  EXPECT_GT(refused, 500);
}

struct BadTable {
  const char *content, *place, *says;
};

TEST_F(ReaderFiles, OfMotionsAreCheckedRowByRow) {
  const std::string scene = with(sound_scene, "[points.end]", "motion = { file = \"ship.csv\" }\n[points.end]");
  const BadTable cases[] = {
      {"", "ship.csv:1:1", "the table is empty; the first line must be `time,x,y,z`"},
      {"t,x,y,z\n0,0,0,0\n1,0,0,0\n", "ship.csv:1:1", "the first line must be `time,x,y,z`"},
      {"time,x,y,z\n0,0,0,0\n1,0,0\n", "ship.csv:3:1", "3 values in a row, 4 wanted"},
      {"time,x,y,z\n0,0,0,0\n1,0, zero,0\n", "ship.csv:3:6", "`y` must be a finite number"},
      {"time,x,y,z\n0,0,0,0\n1,0,0,nan\n", "ship.csv:3:7", "`z` must be a finite number"},
      {"time,x,y,z\n0,0,0,0\n1,0,0,\n", "ship.csv:3:7", "`z` must be a finite number"},
      {"time,x,y,z\n0,0,0,0\n0,0,0,0\n", "ship.csv:3:1", "`time` must increase from row to row: 0 after 0"},
      {"time,x,y,z\n0,0,0,0\n", "ship.csv:2:1", "a motion needs at least two rows"},
      {"time,x,y,z\n", "ship.csv:1:1", "the table has no rows"},
  };
  for (const BadTable& c : cases) {
    write("ship.csv", c.content);
    const std::string report = errors(scene);
    EXPECT_NE(report.find(c.place), std::string::npos) << c.says << "\n" << report;
    EXPECT_NE(report.find(c.says), std::string::npos) << report;
    EXPECT_TRUE(report.ends_with("\n1 error. Nothing was run.\n")) << report;
  }
}

TEST_F(ReaderFiles, ThatAreMissingAreReportedWhereTheyAreNamed) {
  const std::string report = errors(with(sound_scene, "[points.end]", "motion = { file = \"nowhere/ship.csv\" }\n[points.end]"));
  EXPECT_NE(report.find("the file `" + path("nowhere/ship.csv") + "` does not exist"), std::string::npos) << report;
  EXPECT_NE(report.find("scene.toml:10:19\n"), std::string::npos) << report;
}

TEST_F(ReaderFiles, OfShapesMustCoverTheLine) {
  const std::string scene = with(sound_scene, "[dynamics]", "start = { file = \"shape.csv\" }\n[dynamics]");
  write("shape.csv", "s,x,y,z\n0,0,0,0\n90,0,0,-90\n");
  EXPECT_NE(errors(scene).find("must give line `a` from s = 0 to s = 100 m"), std::string::npos);
  write("shape.csv", "s,x,y,z\n0,0,0,0\n100,0,0,-90\n50,0,0,0\n");
  EXPECT_NE(errors(scene).find("shape.csv:4:1"), std::string::npos);
}

TEST_F(ReaderFiles, OfStartsMustKnowTheLines) {
  const std::string scene = with(sound_scene, "step = 0.1", "step = 0.1\nstart = { file = \"start.csv\" }");
  const std::string header = "line,s,x,y,z,vx,vy,vz\n";
  write("start.csv", header + "aa,0,0,0,0,0,0,0\naa,100,0,0,-90,0,0,0\n");
  const std::string unknown = errors(scene);
  EXPECT_NE(unknown.find("`aa` is not a line"), std::string::npos) << unknown;
  EXPECT_NE(unknown.find("the file has no rows of line `a`"), std::string::npos) << unknown;
  write("start.csv", header + "a,0,0,0,0,0,0,0\na,100,0,0,-90,0,0,0\na,60,0,0,-90,0,0,0\n");
  EXPECT_NE(errors(scene).find("`s` of line `a` must increase from row to row"), std::string::npos);
  write("start.csv", header + "a,0,0,0,0,0,0,0\na,60,0,0,-60,0,0,0\n");
  EXPECT_NE(errors(scene).find("it goes from 0 m to 60 m"), std::string::npos);
}

TEST_F(ReaderOverrides, SetAnyKey) {
  const Scene scene = read(
      sound_scene, {"lines.a.sections.0.elements=77", "lines.a.sections.0.length=\"0.2 km\"", "line_types.rope.EA = 5 MN", "solve.linear_solver=band",
                    "points.end.position=[1, 2, -80]", "environment.current=[[0, 1, 0]]", "environment.current.0.1=2", "title=Größe"});
  EXPECT_EQ(scene.title, "Größe");
  EXPECT_EQ(scene.lines[0].sections[0].elements, 77);
  EXPECT_EQ(scene.lines[0].sections[0].length, 200.0);
  EXPECT_EQ(scene.line_types[0].EA, 5e6);
  EXPECT_EQ(scene.solve.linear_solver, "band");
  EXPECT_EQ(scene.points[1].position, Vec3(1, 2, -80));
  EXPECT_EQ(scene.environment.current[0].speed, 2.0);
}

TEST_F(ReaderOverrides, MakeTablesThatAreMissing) {
  const Scene scene = read(sound_scene, {"points.top.motion.ramp=5", "points.top.motion.velocity=[1, 0, 0]", "output.stations.a=[50]"});
  EXPECT_EQ(scene.points[0].motion->ramp, 5.0);
  EXPECT_EQ(scene.points[0].motion->velocity, Vec3::UnitX());
  EXPECT_EQ(scene.output.stations.at(0).second, std::vector<double>{50.0});
}

TEST_F(ReaderOverrides, AreNamedInTheirErrors) {
  struct Case {
    const char *argument, *says;
  };
  const Case cases[] = {
      {"lines.a.sections.0.elements", "there is no `=`"},
      {"lines.a.sections.0.elements=", "not a valid override"},
      {"lines.a.sections.0.elements=ten", "whole number from 1 to 10000000"},
      {"lines.a.sections.0.elemnts=10", "did you mean `elements`?"},
      {"lines.a.sections.1.elements=10", "is a list: use a number from 0 to 0, not `1`"},
      {"lines.a.sections.x.elements=10", "is a list: use a number from 0 to 0, not `x`"},
      {"lines.aa.sections.0.elements=10", "`lines` has no `aa`"},
      {"lines.a.from.x=10", "has no key `x`"},
      {"solve.acuracy=1e-4", "did you mean `accuracy`?"},
      {"lines.a.sections.0.length=3 kg", "`kg` is a unit of mass"},
      {"environment.current=[[0, 1, 0]", "not a valid override"},
      {"a=1\nb=2", "an override sets one key"},
      {"=3", "not a valid override"},
      {"dynamics.step=auto", "not built yet"},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.argument);
    const std::string report = errors(sound_scene, {c.argument});
    EXPECT_NE(report.find(std::string(" --> --set ") + c.argument), std::string::npos) << report;
    EXPECT_NE(report.find(c.says), std::string::npos) << report;
    EXPECT_TRUE(report.ends_with("\n1 error. Nothing was run.\n")) << report;
  }
}

TEST_F(ReaderOverrides, OfNoiseNeverCrash) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 1000; ++trial) {
    std::string argument = "lines.a.sections.0.length=10";
    for (int change = 0; change < 3; ++change) argument[random() % argument.size()] = static_cast<char>(random());
    errors(sound_scene, {argument});
  }
}

}  // namespace
}  // namespace hawser
