// What a sound scene becomes: values in SI, defaults, order, files beside the scene, overrides, warnings.
#include <cmath>
#include <numbers>

#include "tests/solver/app/scene_text.hpp"

namespace hawser {
namespace {

using test::sound_scene;
using test::with;

using Reader = test::SceneFolder;

TEST_F(Reader, GivesTheDefaultsOfTheReference) {
  const Scene scene = read(with(sound_scene, "[environment]\nwater_density = 1000.0\n", ""));
  EXPECT_TRUE(warnings_.empty());
  EXPECT_EQ(scene.environment.gravity, 9.80665);
  EXPECT_EQ(scene.environment.water_density, 1025.0);
  EXPECT_FALSE(scene.environment.depth);
  EXPECT_TRUE(scene.environment.current.empty());
  const LineType& type = scene.line_types.at(0);
  EXPECT_EQ(type.EI, 0.0);
  EXPECT_EQ(type.drag_normal, 0.0);
  EXPECT_EQ(type.added_mass_tangential, 0.0);
  EXPECT_EQ(type.axial_damping, 0.0);
  EXPECT_FALSE(type.wet_weight);
  EXPECT_FALSE(scene.points.at(0).motion);
  EXPECT_FALSE(scene.points.at(1).body.wet_weight);
  EXPECT_FALSE(scene.points.at(1).body.volume);
  EXPECT_EQ(scene.lines.at(0).model, ModelChoice::automatic);
  EXPECT_FALSE(scene.lines.at(0).from_end.clamped);
  EXPECT_EQ(scene.solve.accuracy, 1e-3);
  EXPECT_FALSE(scene.solve.newton_tolerance);
  EXPECT_EQ(scene.solve.linear_solver, "auto");
  EXPECT_EQ(scene.solve.threads, 0);
  EXPECT_EQ(scene.dynamics->spectral_radius, 0.8);
  EXPECT_EQ(scene.dynamics->output_interval, 0.1);
  EXPECT_EQ(scene.dynamics->fields_interval, 5.0);
  EXPECT_EQ(scene.dynamics->start, StartChoice::equilibrium);
}

TEST_F(Reader, KeepsTheTextThePathAndThePlaces) {
  const Scene scene = read(sound_scene);
  EXPECT_EQ(scene.title, "sound");
  EXPECT_EQ(scene.text, sound_scene);
  EXPECT_EQ(scene.path, path("scene.toml"));
  EXPECT_EQ(scene.line_types[0].place.line, 4);
  EXPECT_EQ(scene.points[1].place.line, 10);
  EXPECT_EQ(scene.lines[0].place.line, 14);
  EXPECT_EQ(scene.lines[0].sections[0].place.line, 17);
  EXPECT_EQ(scene.lines[0].sections[0].place.column, 13);
}

TEST_F(Reader, KeepsTheOrderOfTheFile) {
  const Scene scene =
      read(with(sound_scene, "[points.top]", "[points.zulu]\nposition = [0, 0, 0]\n[points.alfa]\nposition = [0, 0, 0]\n[points.top]"));
  ASSERT_EQ(scene.points.size(), 4u);
  EXPECT_EQ(scene.points[0].name, "zulu");
  EXPECT_EQ(scene.points[1].name, "alfa");
  EXPECT_EQ(scene.points[2].name, "top");
}

TEST_F(Reader, ReadsAnglesInDegreesAndSortsTheCurrent) {
  const Scene scene = read(with(sound_scene, "water_density = 1000.0", "current = [[0, 1, 90], [-50, \"1 kn\", \"1 rad\"], [-20, -0.5, 0]]"));
  const auto& current = scene.environment.current;
  ASSERT_EQ(current.size(), 3u);
  EXPECT_EQ(current[0].z, -50.0);
  EXPECT_DOUBLE_EQ(current[0].speed, 1852.0 / 3600.0);
  EXPECT_EQ(current[0].heading, 1.0);
  EXPECT_EQ(current[1].speed, -0.5);
  EXPECT_DOUBLE_EQ(current[2].heading, std::numbers::pi / 2);
}

TEST_F(Reader, ReadsLoadsEndsAndFunctionsOfTime) {
  std::string text = with(sound_scene, "EA = 4.0e7", "EA = \"40 MN\"\nEI = \"2 kN m2\"\nwet_weight = 0.0");
  text = with(text, "mass = 100.0", "volume = 0.02\nthrust = { force = [1, 2, 3], shape = \"sin2\", duration = \"1 min\" }");
  text = with(text, "[dynamics]", R"(model = "beam"
from_end = { clamped = [0, 0, -2] }
to_end = { pinned = true }
loads = [
  { at = "20 m", mass = 50, wet_weight = -300, drag_area = 0.1, added_mass = 5 },
  { at = 50, over = 0.5, force = { table = [[0, 1, 0, 0], [2, 3, 0, 0], [3, 0, 0, 0]], interpolation = "cubic" } },
  { at = 70, moment = [0, "1 kN m", 0] },
]
[output.stations]
a = [0, "20 m", 100]
[dynamics])");
  const Scene scene = read(text);
  EXPECT_TRUE(warnings_.empty());
  EXPECT_EQ(scene.line_types[0].EA, 4e7);
  EXPECT_EQ(scene.line_types[0].EI, 2000.0);
  EXPECT_EQ(scene.line_types[0].wet_weight, 0.0);
  EXPECT_EQ(scene.points[1].body.volume, 0.02);
  EXPECT_EQ(scene.points[1].body.force.pulse->force, Vec3(1, 2, 3));
  EXPECT_EQ(scene.points[1].body.force.pulse->duration, 60.0);
  const LineSpec& line = scene.lines[0];
  EXPECT_EQ(line.model, ModelChoice::beam);
  EXPECT_TRUE(line.from_end.clamped);
  EXPECT_EQ(line.from_end.direction, Vec3(0, 0, -2));
  EXPECT_FALSE(line.to_end.clamped);
  ASSERT_EQ(line.loads.size(), 3u);
  EXPECT_EQ(line.loads[0].body.mass, 50.0);
  EXPECT_EQ(line.loads[0].body.wet_weight, -300.0);
  EXPECT_EQ(line.loads[0].body.drag_area, 0.1);
  EXPECT_EQ(line.loads[0].body.added_mass, 5.0);
  EXPECT_EQ(line.loads[1].over, 0.5);
  EXPECT_EQ(line.loads[1].body.force.table->interpolation, TimeTable::Interpolation::cubic);
  EXPECT_EQ(line.loads[1].body.force.table->value[1], Vec3(3, 0, 0));
  EXPECT_EQ(line.loads[2].moment.constant, Vec3(0, 1000, 0));
  ASSERT_EQ(scene.output.stations.size(), 1u);
  EXPECT_EQ(scene.output.stations[0].first, "a");
  EXPECT_EQ(scene.output.stations[0].second, (std::vector<double>{0.0, 20.0, 100.0}));
}

TEST_F(Reader, ReadsMotions) {
  const Scene scene = read(
      with(sound_scene, "[points.end]",
           "motion = { velocity = [\"2 kn\", 0, 0], ramp = 10, harmonics = [{ direction = [0, 0, 1], amplitude = 2.5, period = 10, phase = 90 }] }\n"
           "[points.end]"));
  const MotionSpec& motion = *scene.points[0].motion;
  EXPECT_DOUBLE_EQ(motion.velocity.x(), 2 * 1852.0 / 3600.0);
  EXPECT_EQ(motion.ramp, 10.0);
  ASSERT_EQ(motion.harmonics.size(), 1u);
  EXPECT_EQ(motion.harmonics[0].direction, Vec3::UnitZ());
  EXPECT_EQ(motion.harmonics[0].amplitude, 2.5);
  EXPECT_EQ(motion.harmonics[0].period, 10.0);
  EXPECT_DOUBLE_EQ(motion.harmonics[0].phase, std::numbers::pi / 2);
}

TEST_F(Reader, ReadsFilesBesideTheScene) {
  write("ship.csv", "# a comment\r\ntime, x, y, z\r\n0, 1, 2, 3\r\n\r\n10, +1.5, 2, 3e0\r\n");
  write("shape.csv", "s,x,y,z\n0,1,2,3\n100,1,2,-97\n");
  write("start.csv", "line,s,x,y,z,vx,vy,vz\na,0,1,2,3,0.1,0,0\na,100,1,2,-97,0,0.2,0\n");
  std::string text = with(sound_scene, "position = [0.0, 0.0, 0.0]", "motion = { file = \"ship.csv\" }");
  text = with(text, "[dynamics]", "start = { file = \"shape.csv\" }\n[dynamics]\nstart = { file = \"start.csv\" }");
  const Scene scene = read(text);
  EXPECT_TRUE(warnings_.empty());
  const TimeTable& motion = *scene.points[0].motion->file;
  EXPECT_EQ(motion.time, (std::vector<double>{0.0, 10.0}));
  EXPECT_EQ(motion.value[1], Vec3(1.5, 2, 3));
  EXPECT_EQ(motion.interpolation, TimeTable::Interpolation::cubic);
  EXPECT_EQ(scene.points[0].position, Vec3(1, 2, 3));
  EXPECT_EQ(scene.lines[0].start->s, (std::vector<double>{0.0, 100.0}));
  EXPECT_EQ(scene.lines[0].start->position[1], Vec3(1, 2, -97));
  EXPECT_EQ(scene.dynamics->start, StartChoice::file);
  const auto& rows = scene.dynamics->start_table->rows;
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[1].line, "a");
  EXPECT_EQ(rows[1].s, 100.0);
  EXPECT_EQ(rows[1].velocity, Vec3(0, 0.2, 0));
}

TEST_F(Reader, KeepsTheSeabedWithItsDefaults) {
  const Environment plain = read(with(sound_scene, "water_density = 1000.0", "depth = 103.0")).environment;
  EXPECT_EQ(plain.depth, 103.0);
  EXPECT_EQ(plain.seabed.stiffness, 3.0e3);
  EXPECT_EQ(plain.seabed.smoothing, 0.0);
  EXPECT_EQ(plain.seabed.damping, 0.0);
  EXPECT_EQ(plain.seabed.friction_axial, 0.0);
  EXPECT_EQ(plain.seabed.slip, 1.0e-4);
  EXPECT_FALSE(plain.seabed.bathymetry);
}

TEST_F(Reader, KeepsTheLawOfTheSeabed) {
  const std::string bed =
      "depth = 103.0\nseabed = { stiffness = \"4 kN/m2\", smoothing = \"1 cm\", damping = 20, friction = { axial = 0.5, lateral = 0.6 }, slip = "
      "\"0.2 mm\" }";
  const SeabedSpec seabed = read(with(sound_scene, "water_density = 1000.0", bed)).environment.seabed;
  EXPECT_EQ(seabed.stiffness, 4.0e3);
  EXPECT_EQ(seabed.smoothing, 0.01);
  EXPECT_EQ(seabed.damping, 20.0);
  EXPECT_EQ(seabed.friction_axial, 0.5);
  EXPECT_EQ(seabed.friction_lateral, 0.6);
  EXPECT_EQ(seabed.slip, 2.0e-4);
  const SeabedSpec same = read(with(sound_scene, "water_density = 1000.0", "depth = 103.0\nseabed = { friction = 0.7 }")).environment.seabed;
  EXPECT_EQ(same.friction_axial, 0.7);
  EXPECT_EQ(same.friction_lateral, 0.7);
}

TEST_F(Reader, ReadsSoundingsInAnyOrder) {
  write("bed.csv", "# survey\nx,y,z\n10,0,-101\n0,0,-100\n0,5,-102\n\n10,5,-103\n20,5,-105\n20,0,-104\n");
  const auto bed =
      read(with(sound_scene, "water_density = 1000.0", "seabed = { bathymetry = { file = \"bed.csv\" } }")).environment.seabed.bathymetry;
  ASSERT_TRUE(bed);
  EXPECT_EQ(bed->x, (std::vector<double>{0, 10, 20}));
  EXPECT_EQ(bed->y, (std::vector<double>{0, 5}));
  EXPECT_EQ(bed->z, (std::vector<double>{-100, -101, -104, -102, -103, -105}));
}

TEST_F(Reader, WarnsOfWhatTheSeabedCannotMean) {
  std::vector<Diagnostic> warnings;
  const auto warned = [&](const std::string& text) {
    warnings.clear();
    read_scene(write("scene.toml", text), {}, &warnings);
    return warnings.empty() ? std::string() : render(warnings[0]);
  };
  const std::string held = with(sound_scene, "free = true\nposition = [0.0, 0.0, -90.0]\nmass = 100.0", "position = [60.0, 0.0, -50.0]");
  EXPECT_EQ(warned(with(held, "water_density = 1000.0", "depth = 50.0\nseabed = { friction = 0.5 }")), "");
  EXPECT_NE(warned(with(held, "water_density = 1000.0", "depth = 48.5")).find("point `end` is 1.5 m below the seabed"), std::string::npos);
  EXPECT_NE(warned(with(held, "water_density = 1000.0", "depth = 51.0\nseabed = { friction = 0.5 }")).find("none of its ends is on the bed"),
            std::string::npos);
}

TEST_F(Reader, AcceptsSteadyTowAndStartsFromRest) {
  const std::string held =
      with(sound_scene, "free = true\nposition = [0.0, 0.0, -90.0]\nmass = 100.0", "position = [60.0, 0.0, 0.0]\nmotion = { velocity = [1, 0, 0] }");
  EXPECT_EQ(errors(with(held, "[points.end]", "motion = { velocity = [1, 0, 0] }\n[points.end]")), "");
  EXPECT_NE(errors(with(held, "[points.end]", "motion = { velocity = [1, 0, 0], ramp = 5 }\n[points.end]")), "");
  EXPECT_EQ(errors(with(with(held, "motion = { velocity = [1, 0, 0] }", "motion = { velocity = [1, 0, 0], ramp = 9 }"), "[points.end]",
                        "motion = { velocity = [2, 0, 0], ramp = 5 }\n[points.end]")),
            "");
}

TEST_F(Reader, AcceptsAStraightStartWhereTheChordIsTheLength) {
  std::string held = with(sound_scene, "free = true\nposition = [0.0, 0.0, -90.0]\nmass = 100.0", "position = [0.0, 60.0, -80.0]");
  held = with(held, "step = 0.1", "step = 0.1\nstart = \"straight\"");
  EXPECT_EQ(read(held).dynamics->start, StartChoice::straight);
  EXPECT_EQ(read(with(sound_scene, "step = 0.1", "step = 0.1\nstart = \"straight\"")).dynamics->start, StartChoice::straight);
}

TEST_F(Reader, AcceptsAnyNumberOfLineEndsAtAFreePoint) {
  const std::string section = "sections = [{ type = \"rope\", length = 100.0, elements = 10 }]\n";
  const std::string more =
      "[points.other]\nposition = [50, 0, 0]\n[points.tip]\nfree = true\nposition = [0, 0, -150]\n[lines.b]\nfrom = \"other\"\nto = \"end\"\n" +
      section + "[lines.c]\nfrom = \"end\"\nto = \"tip\"\n" + section + "[lines.ring]\nfrom = \"end\"\nto = \"end\"\n" + section;
  EXPECT_EQ(errors(with(sound_scene, "[dynamics]", more + "[dynamics]")), "");
  const Scene scene = read(with(sound_scene, "[dynamics]", more + "[dynamics]"));
  EXPECT_EQ(scene.lines.size(), 4u);
  // A straight start must not tear the lines apart: `end` is 90 m from `top`, the line 100 m long.
  EXPECT_NE(errors(with(with(sound_scene, "[dynamics]", more + "[dynamics]"), "step = 0.1", "step = 0.1\nstart = \"straight\"")), "");
}

TEST_F(Reader, WarnsOfWhatIsSuspicious) {
  struct Case {
    const char *from, *to, *says;
  };
  const Case cases[] = {
      {"[lines.a]", "[points.spare]\nposition = [0, 0, 0]\n[lines.a]", "no line ends at point `spare`"},
      {"[dynamics]", "loads = [{ at = 50 }]\n[dynamics]", "`lines.a.loads.0` loads the line with nothing"},
      {"[dynamics]", "model = \"beam\"\n[dynamics]", "its line types have EI = 0"},
      {"[dynamics]", "from_end = { clamped = [0, 0, -1] }\n[dynamics]", "a clamp does nothing to a line without bending stiffness"},
      {"[points.end]", "motion = { harmonics = [{ direction = [0, 0, 1], amplitude = 1, period = 5 }] }\n[points.end]",
       "starts with a jump of velocity"},
      {"[points.end]", "motion = { ramp = 5, harmonics = [{ direction = [0, 0, 0], amplitude = 1, period = 5 }] }\n[points.end]", "has no direction"},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.says);
    read(with(sound_scene, c.from, c.to));
    ASSERT_EQ(warnings_.size(), 1u);
    EXPECT_EQ(warnings_[0].severity, Severity::warning);
    EXPECT_NE(warnings_[0].message.find(c.says), std::string::npos) << warnings_[0].message;
  }
}

TEST_F(Reader, WarnsWhereAMotionFileEndsBeforeTheRun) {
  write("ship.csv", "time,x,y,z\n0,0,0,0\n5,0,0,1\n9,0,0,0\n");
  read(with(sound_scene, "[points.end]", "motion = { file = \"ship.csv\" }\n[points.end]"));
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_NE(warnings_[0].message.find("does not cover the whole run of 10 s"), std::string::npos);
}

struct SceneFile {
  const char *name, *line;
  std::size_t elements;
};
class Scenes : public ::testing::TestWithParam<SceneFile> {};

TEST_P(Scenes, ReadWithoutAWarning) {
  std::vector<Diagnostic> warnings;
  const Scene scene = read_scene(std::string(HAWSER_SOURCE_DIR) + "/data/scenes/" + GetParam().name + ".toml", {}, &warnings);
  EXPECT_TRUE(warnings.empty());
  EXPECT_FALSE(scene.title.empty());
  ASSERT_FALSE(scene.lines.empty());
  EXPECT_EQ(scene.lines[0].name, GetParam().line);
  EXPECT_EQ(static_cast<std::size_t>(scene.lines[0].sections.at(0).elements), GetParam().elements);
  EXPECT_TRUE(scene.dynamics.has_value());
}

INSTANTIATE_TEST_SUITE_P(Data, Scenes,
                         ::testing::Values(SceneFile{"umbilical-heave", "umbilical", 200}, SceneFile{"catenary-5000", "tether", 1000},
                                           SceneFile{"falling-line", "rope", 512}, SceneFile{"swinging-bob", "rope", 128},
                                           SceneFile{"steady-tow", "tow", 200}, SceneFile{"current-shear", "tether", 1000},
                                           SceneFile{"vehicle-on-tether", "tether", 150}, SceneFile{"lazy-wave-960", "wave", 389},
                                           SceneFile{"three-leg-mooring", "leg_east", 90}));

TEST(Scenes, OfTheDataFolderAreAllListedHere) {
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(std::string(HAWSER_SOURCE_DIR) + "/data/scenes")) {
    files += entry.path().extension() == ".toml";
  }
  EXPECT_EQ(files, 10u);
}

}  // namespace
}  // namespace hawser
