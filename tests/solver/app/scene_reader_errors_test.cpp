// Every kind of fault that the reader finds, each with the place it must point at.
#include "tests/solver/app/scene_text.hpp"

namespace hawser {
namespace {

using test::sound_scene;
using test::with;

struct Fault {
  const char* name;
  const char* from;  // replaced in the sound scene
  const char* to;
  const char* place;  // ":line:column\n" of the one error
  std::vector<const char*> says;
};

std::ostream& operator<<(std::ostream& out, const Fault& fault) { return out << fault.name; }

class ReaderFault : public test::SceneFolder, public ::testing::WithParamInterface<Fault> {};

TEST_P(ReaderFault, IsReportedOnceWithItsPlace) {
  const Fault& fault = GetParam();
  const std::string text = errors(with(sound_scene, fault.from, fault.to));
  EXPECT_NE(text.find("scene.toml" + std::string(fault.place) + "\n"), std::string::npos) << text;
  for (const char* says : fault.says) EXPECT_NE(text.find(says), std::string::npos) << says << "\n" << text;
  EXPECT_TRUE(text.ends_with("\n\n1 error. Nothing was run.\n")) << text;
}

const Fault typing[] = {
    {"Syntax", "EA = 4.0e7", "EA = = 4.0e7", ":7:6", {"not a valid scene file"}},
    {"OpenString", "from = \"top\"", "from = \"top", ":15:12", {"not a valid scene file"}},
    {"DuplicateKey", "EA = 4.0e7", "EA = 4.0e7\nEA = 1", ":8:6", {"not a valid scene file", "cannot redefine existing"}},
    {"UnknownTopKey", "[environment]", "[enviroment]", ":2:2", {"unknown key `enviroment` at the top of the scene", "did you mean `environment`?"}},
    {"UnknownKey",
     "water_density",
     "water_densty",
     ":3:1",
     {"unknown key `water_densty` in `environment`", "^^^^^^^^^^^^ did you mean `water_density`?",
      "allowed: gravity, water_density, depth, current, seabed"}},
    {"MisspeltRequiredKey", "diameter", "diametre", ":5:1", {"did you mean `diameter`?"}},
    {"MissingKey", "diameter = 0.04\n", "", ":4:1", {"`line_types.rope.diameter` is missing", "[line_types.rope]", "needs `diameter`"}},
    {"WrongUnit",
     "length = 100.0",
     "length = \"100 kg\"",
     ":17:39",
     {"`lines.a.sections.0.length` must be a length: a number in m, or a string with a unit such as \"4 km\"", "`kg` is a unit of mass"}},
    {"UnknownUnit", "diameter = 0.04", "diameter = \"4 cmm\"", ":5:12", {"`cmm` is not a unit; did you mean `cm`?"}},
    {"BareWord", "mass = 2.5", "mass = \"heavy\"", ":6:8", {"does not begin with a number"}},
    {"WrongType", "mass = 2.5", "mass = true", ":6:8", {"`line_types.rope.mass` must be a mass per length", "this is a boolean"}},
    {"NotATable", "title = \"sound\"", "solve = 3", ":1:9", {"`solve` must be a table", "this is a number"}},
    {"NotATableOfPoints", "title = \"sound\"", "points.other = 3", ":1:16", {"`points.other` must be a table", "this is a number"}},
    {"NotANumber", "EA = 4.0e7", "EA = nan", ":7:6", {"must be finite"}},
    {"Infinite", "EA = 4.0e7", "EA = inf", ":7:6", {"must be finite"}},
    {"InfiniteWithUnit", "EA = 4.0e7", "EA = \"inf N\"", ":7:6", {"must be finite"}},
    {"NegativeLength", "length = 100.0", "length = -100.0", ":17:39", {"must be greater than 0 m", "out of range: -100"}},
    {"ZeroLength", "length = 100.0", "length = 0", ":17:39", {"must be greater than 0 m"}},
    {"NegativeMass", "mass = 2.5", "mass = -2.5", ":6:8", {"must not be negative"}},
    {"ZeroEA", "EA = 4.0e7", "EA = 0.0", ":7:6", {"must be greater than 0 N"}},
    {"NegativeEI", "EA = 4.0e7", "EA = 4.0e7\nEI = -1", ":8:6", {"must not be negative"}},
    {"ZeroElements", "elements = 10", "elements = 0", ":17:57", {"whole number from 1 to 10000000"}},
    {"TooManyElements", "elements = 10", "elements = 10000001", ":17:57", {"whole number from 1 to 10000000"}},
    {"FractionOfElements", "elements = 10", "elements = 10.5", ":17:57", {"whole number"}},
    {"ShortVector", "position = [0.0, 0.0, 0.0]", "position = [0.0, 0.0]", ":9:12", {"must be a list of 3 numbers", "this is a list of 2"}},
    {"WordInVector", "position = [0.0, 0.0, 0.0]", "position = [0.0, \"x\", 0.0]", ":9:18", {"`points.top.position.1` must be a length"}},
    {"NoSections", "sections = [{ type = \"rope\", length = 100.0, elements = 10 }]", "sections = []", ":17:12", {"at least one section"}},
    {"BadName", "[lines.a]", "[lines.\"a,b\"]", ":14:8", {"`a,b` cannot be the name of a line"}},
    {"Density", "water_density = 1000.0", "water_density = \"-1 kg/m3\"", ":3:17", {"must not be negative"}},
};

const Fault meaning[] = {
    {"MissingPoint",
     "to = \"end\"",
     "to = \"ned\"",
     ":16:6",
     {"line `a` ends at `ned`, which is not a point", "did you mean `end`?", "defined: top, end"}},
    {"MissingType", "type = \"rope\"", "type = \"rop\"", ":17:22", {"`rop` is not a line type", "did you mean `rope`?"}},
    {"MassOfHeldPoint", "[points.end]", "mass = 3\n[points.end]", ":10:8", {"`points.top.mass` has no effect on a point that is held"}},
    {"MotionOfFreePoint", "free = true", "free = true\nmotion = { velocity = [1, 0, 0] }", ":12:10", {"it cannot have a motion"}},
    {"WeightAndVolume", "mass = 100.0", "mass = 100.0\nwet_weight = 1\nvolume = 1", ":15:10", {"cannot stand beside `points.end.wet_weight`"}},
    {"TooShort",
     "free = true\nposition = [0.0, 0.0, -90.0]\nmass = 100.0",
     "position = [0.0, 0.0, -173.0]",
     ":15:12",
     {"line `a` is too short: it would have to stretch 73 %", "at most 50 %"}},
    {"LoadBeyondEnd", "[dynamics]", "loads = [{ at = 100.0, mass = 1 }]\n[dynamics]", ":18:17", {"0 < at < 100 m", "free point"}},
    {"LoadWithoutPlace", "[dynamics]", "loads = [{ mass = 1 }]\n[dynamics]", ":18:10", {"`lines.a.loads.0.at` is missing"}},
    {"SpreadOverEnd",
     "[dynamics]",
     "loads = [{ at = 99.0, over = 4.0, force = [1, 0, 0] }]\n[dynamics]",
     ":18:30",
     {"must not reach over an end", "97 m to 101 m"}},
    {"SpreadMass",
     "[dynamics]",
     "loads = [{ at = 9.0, over = 4.0, force = [1, 0, 0], mass = 3 }]\n[dynamics]",
     ":18:60",
     {"`over` spreads `force` only"}},
    {"SpreadNothing", "[dynamics]", "loads = [{ at = 9.0, over = 4.0 }]\n[dynamics]", ":18:29", {"`lines.a.loads.0` has no `force` to spread"}},
    {"MomentOnCable", "[dynamics]", "loads = [{ at = 9.0, moment = [1, 0, 0] }]\n[dynamics]", ":18:31", {"needs a beam"}},
    {"ClampAtFreePoint",
     "[dynamics]",
     "to_end = { clamped = [0, 0, -1] }\n[dynamics]",
     ":18:10",
     {"a clamp needs a point that is held", "point `end` is free"}},
    {"ClampedBar", "[dynamics]", "model = \"bar\"\nfrom_end = { clamped = [0, 0, -1] }\n[dynamics]", ":19:12", {"a bar cannot be clamped"}},
    {"ClampWithoutDirection", "[dynamics]", "from_end = { clamped = [0, 0, 0] }\n[dynamics]", ":18:24", {"must not be zero"}},
    {"UnknownEnd", "[dynamics]", "from_end = \"fixed\"\n[dynamics]", ":18:12", {"must be \"pinned\" or { clamped = [x, y, z] }"}},
    {"UnknownModel",
     "[dynamics]",
     "model = \"cabel\"\n[dynamics]",
     ":18:9",
     {"one of \"auto\", \"bar\", \"cable\", \"beam\"", "did you mean `cable`?"}},
    {"UnusedFreePoint",
     "[lines.a]",
     "[points.lost]\nfree = true\nposition = [1, 1, 1]\n[lines.a]",
     ":14:1",
     {"no line ends at the free point `lost`"}},
    {"NothingHoldsALine", "[points.end]", "free = true\n[points.end]", ":17:6", {"nothing holds line `a`: all points there are free"}},
    {"NothingHoldsAPart",
     "[dynamics]",
     "[points.p]\nfree = true\nposition = [1, 0, 0]\n[points.q]\nfree = true\nposition = [2, 0, 0]\n"
     "[lines.b]\nfrom = \"p\"\nto = \"q\"\nsections = [{ type = \"rope\", length = 1.0, elements = 1 }]\n"
     "[lines.c]\nfrom = \"q\"\nto = \"p\"\nsections = [{ type = \"rope\", length = 2.0, elements = 1 }]\n[dynamics]",
     ":26:6",
     {"nothing holds lines `b`, `c`", "joined to no held point"}},
    {"TooShortTogether",
     "[dynamics]",
     "[points.far]\nposition = [0, 0, -400]\n"
     "[lines.b]\nfrom = \"end\"\nto = \"far\"\nsections = [{ type = \"rope\", length = 100.0, elements = 10 }]\n[dynamics]",
     ":17:12",
     {"lines `a`, `b` are too short together: they would have to stretch 100 %", "`top` and `far` are 400 m apart"}},
    {"MasslessDynamics", "mass = 2.5", "mass = 0.0", ":6:8", {"a scene with [dynamics] needs line types with mass > 0"}},
    {"ElementTotal",
     "elements = 10 }",
     "elements = 6000000 }, { type = \"rope\", length = 10.0, elements = 6000000 }",
     ":17:111",
     {"the whole scene may have 10000000 elements"}},
    {"StationName", "[dynamics]", "[output]\nstations = { b = [1.0] }\n[dynamics]", ":19:18", {"`b` is not a line", "defined: a"}},
    {"StationRange", "[dynamics]", "[output]\nstations = { a = [1.0, 100.5] }\n[dynamics]", ":19:24", {"must lie in 0 to 100 m"}},
    {"RepeatedDepth", "water_density = 1000.0", "current = [[0, 1, 0], [-9, 1, 0], [0, 2, 0]]", ":3:35", {"repeats the z of another row"}},
    {"SeabedWithoutDepth", "water_density = 1000.0", "seabed = { stiffness = 3e3 }", ":3:10", {"needs `environment.depth`, or a `bathymetry`"}},
    {"SeabedTwice",
     "water_density = 1000.0",
     "depth = 99.0\nseabed = { bathymetry = { file = \"bed.csv\" } }",
     ":4:25",
     {"`environment.seabed.bathymetry` and `environment.depth` both say where the bed is"}},
    {"SeabedStiffness", "water_density = 1000.0", "depth = 99.0\nseabed = { stiffness = 0 }", ":4:24", {"`environment.seabed.stiffness`"}},
    {"SeabedFriction", "water_density = 1000.0", "depth = 99.0\nseabed = { friction = -0.1 }", ":4:23", {"`environment.seabed.friction`"}},
    {"SeabedKey", "water_density = 1000.0", "depth = 99.0\nseabed = { sliip = 1e-3 }", ":4:12", {"did you mean `slip`?"}},
    {"SeabedFrictionKey",
     "water_density = 1000.0",
     "depth = 99.0\nseabed = { friction = { axial = 0.1 } }",
     ":4:23",
     {"`environment.seabed.friction.lateral` is missing"}},
    {"DecreasingTable",
     "mass = 100.0",
     "thrust = { table = [[0, 1, 0, 0], [0, 2, 0, 0]] }",
     ":13:35",
     {"times of `points.end.thrust.table` must increase"}},
    {"OneRowTable", "mass = 100.0", "thrust = { table = [[0, 1, 0, 0]] }", ":13:20", {"at least two rows"}},
    {"PulseShape", "mass = 100.0", "thrust = { force = [1, 0, 0], shape = \"sin\", duration = 4 }", ":13:39", {"one of \"sin2\""}},
    {"PulseLength", "mass = 100.0", "thrust = { force = [1, 0, 0], shape = \"sin2\", duration = 0 }", ":13:58", {"must be greater than 0 s"}},
    {"EmptyForce", "mass = 100.0", "thrust = { shape = \"sin2\" }", ":13:10", {"must be [x, y, z], { table, interpolation } or { force, shape"}},
};

const Fault moving[] = {
    {"ZeroPeriod",
     "[points.end]",
     "motion = { harmonics = [{ direction = [0, 0, 1], amplitude = 1, period = 0 }] }\n[points.end]",
     ":10:74",
     {"must be greater than 0 s"}},
    {"FileAndVelocity",
     "[points.end]",
     "motion = { file = \"\", velocity = [1, 0, 0] }\n[points.end]",
     ":10:34",
     {"cannot stand beside `points.top.motion.file`"}},
    {"Duration", "duration = 10.0", "duration = 0.0", ":19:12", {"must be greater than 0 s"}},
    {"Step", "step = 0.1", "step = -0.1", ":20:8", {"must be greater than 0 s"}},
    {"SpectralRadius", "step = 0.1", "step = 0.1\nspectral_radius = 1.01", ":21:19", {"at least 0 and at most 1"}},
    {"OutputInterval", "step = 0.1", "step = 0.1\noutput_interval = 0", ":21:19", {"must be greater than 0 s"}},
    {"Accuracy", "[dynamics]", "[solve]\naccuracy = 2\n[dynamics]", ":19:12", {"greater than 0 and at most 1"}},
    {"LinearSolver", "[dynamics]", "[solve]\nlinear_solver = \"cholmd\"\n[dynamics]", ":19:17", {"did you mean `cholmod`?"}},
    {"Threads", "[dynamics]", "[solve]\nthreads = -1\n[dynamics]", ":19:11", {"whole number from 0 to 4096"}},
    {"StraightStartOfHeldLine",
     "free = true\nposition = [0.0, 0.0, -90.0]\nmass = 100.0\n[lines.a]\nfrom = \"top\"\nto = \"end\"\nsections = [{ type = \"rope\", length = "
     "100.0, elements = 10 }]\n[dynamics]",
     "position = [0.0, 0.0, -90.0]\n[lines.a]\nfrom = \"top\"\nto = \"end\"\nsections = [{ type = \"rope\", length = 100.0, elements = 10 "
     "}]\n[dynamics]\nstart = \"straight\"",
     ":17:9",
     {"needs a free `to` end", "length 100 m, distance 90 m"}},
    {"StraightStartNowhere",
     "position = [0.0, 0.0, -90.0]\nmass = 100.0\n[lines.a]\nfrom = \"top\"\nto = \"end\"\nsections = [{ type = \"rope\", length = 100.0, elements = "
     "10 }]\n[dynamics]",
     "position = [0.0, 0.0, 0.0]\n[lines.a]\nfrom = \"top\"\nto = \"end\"\nsections = [{ type = \"rope\", length = 100.0, elements = 10 "
     "}]\n[dynamics]\nstart = \"straight\"",
     ":18:9",
     {"has no direction"}},
    {"TowedAgainstAFixedPoint",
     "position = [0.0, 0.0, 0.0]\n[points.end]\nfree = true\nposition = [0.0, 0.0, -90.0]\nmass = 100.0",
     "position = [0.0, 0.0, 0.0]\nmotion = { velocity = [1, 0, 0] }\n[points.end]\nposition = [0.0, 0.0, -90.0]",
     ":10:23",
     {"`top` and `end` have different velocities at t = 0", "`ramp`"}},
};

const Fault later[] = {
    {"NoElements", ", elements = 10", "", ":17:13", {"`lines.a.sections.0.elements` absent", "not built yet"}},
    {"AutoElements", "elements = 10", "elements = \"auto\"", ":17:57", {"not built yet"}},
    {"NoStep", "step = 0.1\n", "", ":18:1", {"`dynamics.step` absent", "not built yet"}},
    {"AutoStep", "step = 0.1", "step = \"auto\"", ":20:8", {"not built yet"}},
    {"Ida", "step = 0.1", "step = 0.1\nintegrator = \"ida\"", ":21:14", {"\"ida\" is not built yet"}},
    {"Rod", "[dynamics]", "model = \"rod\"\n[dynamics]", ":18:9", {"the rod (torsion) is not built yet"}},
    {"GJ", "EA = 4.0e7", "EA = 4.0e7\nGJ = 1.0", ":8:6", {"torsion (`line_types.rope.GJ` > 0) is not built yet"}},
    {"TwoStiffnesses", "EA = 4.0e7", "EA = 4.0e7\nEI = { flat = 1, edge = 2 }", ":8:6", {"not built yet"}},
    {"Twist",
     "[dynamics]",
     "from_end = { clamped = [0, 0, -1], twist = 5.0 }\n[lines.a.to_end]\npinned = true\n[dynamics]",
     ":18:44",
     {"torsion (`lines.a.from_end.twist`) is not built yet"}},
    {"Director", "[dynamics]", "to_end = { pinned = true, director = [1, 0, 0] }\n[dynamics]", ":18:38", {"not built yet"}},
    {"StartFromResult", "step = 0.1", "step = 0.1\nstart = { file = \"result.h5\" }", ":21:18", {"a start from a result file", "not built yet"}},
};

std::string name_of(const ::testing::TestParamInfo<Fault>& info) { return info.param.name; }
INSTANTIATE_TEST_SUITE_P(Typing, ReaderFault, ::testing::ValuesIn(typing), name_of);
INSTANTIATE_TEST_SUITE_P(Meaning, ReaderFault, ::testing::ValuesIn(meaning), name_of);
INSTANTIATE_TEST_SUITE_P(Moving, ReaderFault, ::testing::ValuesIn(moving), name_of);
INSTANTIATE_TEST_SUITE_P(NotBuiltYet, ReaderFault, ::testing::ValuesIn(later), name_of);

using ReaderErrors = test::SceneFolder;

TEST_F(ReaderErrors, AreFoundAllInOnePassInTheOrderOfTheFile) {
  std::string text = with(sound_scene, "water_density", "water_densty");
  text = with(text, "mass = 2.5", "mass = \"2.5 m\"");
  text = with(text, "to = \"end\"", "to = \"ende\"");
  text = with(text, "elements = 10", "elements = -1");
  text = with(text, "step = 0.1", "step = \"auto\"");
  const std::string report = errors(text);
  std::size_t at = 0;
  for (const char* place : {"toml:3:1\n", "toml:6:8\n", "toml:16:6\n", "toml:17:57\n", "toml:20:8\n", "5 errors. Nothing was run."}) {
    const std::size_t next = report.find(place, at);
    ASSERT_NE(next, std::string::npos) << place << report;
    at = next;
  }
}

TEST_F(ReaderErrors, StopAtManyOfTheSameKind) {
  std::string keys, points;
  for (int i = 0; i < 20000; ++i) {
    keys += "k" + std::to_string(i) + " = 1\n";
    points += "[points.p" + std::to_string(i) + "]\nposition = [0, 0, 0]\n";
  }
  const std::string unknown = errors(keys + sound_scene), many = errors(points + sound_scene.substr(sound_scene.find("[environment]")));
  EXPECT_NE(unknown.find("... and 950 more"), std::string::npos);
  EXPECT_NE(many.find("`points` has 20002 tables; at most 10000 are read"), std::string::npos) << many;
}

TEST_F(ReaderErrors, OfAnEmptySceneNameWhatItNeeds) {
  for (const char* text : {"", "\n\n", "# nothing\n", "\xEF\xBB\xBF"}) {
    const std::string report = errors(text);
    EXPECT_NE(report.find("scene.toml:1:1\n"), std::string::npos) << report;
    EXPECT_NE(report.find("the scene has no lines"), std::string::npos);
    EXPECT_NE(report.find("the scene has no points"), std::string::npos);
  }
}

}  // namespace
}  // namespace hawser
