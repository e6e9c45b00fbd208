// Lines on the seabed from nothing: the laid first guess, and the equilibrium that Newton finds from it.
#include <gtest/gtest.h>

#include "assembly/seabed.hpp"
#include "solver/static_start_bed.hpp"
#include "tests/support/scene_builder.hpp"
#include "tests/support/static_solution.hpp"

namespace hawser {
namespace {

using test::SceneBuilder;

constexpr double depth = 200.0, w = 500.0;

struct Case {
  const char* name;
  Vec3 from, to;
  double length;
  double EI = 0.0, friction = 0.0, sinks = 0.01;  // N m2; -; m, w/k
  double slope = 0.0;                             // of the bed along x
  double current = 0.0;                           // m/s across the line
  int factorizations = 8;                         // at most
};

Scene scene(const Case& s, bool turned = false) {
  SceneBuilder builder;
  LineType type = test::line_type("chain", 3e8, w, s.EI);
  type.drag_normal = 1.5;
  builder.type(type).fixed("a", s.from).fixed("b", s.to);
  if (turned)
    builder.line("b", "a");
  else
    builder.line("a", "b");
  builder.section("chain", s.length, 120);
  if (s.current > 0.0) builder.current(0.0, {0.0, s.current, 0.0});
  SeabedSpec& bed = builder.scene.environment.seabed;
  bed.stiffness = w / s.sinks;
  bed.friction_axial = bed.friction_lateral = s.friction;
  if (s.slope == 0.0)
    builder.scene.environment.depth = depth;
  else
    bed.bathymetry = BathymetryGrid{{0.0, 1.0}, {0.0, 1.0}, {-depth, -depth + s.slope, -depth, -depth + s.slope}};
  return builder.scene;
}

const Case cases[] = {
    {"mooring", {0, 0, -depth}, {600, 0, 0}, 660.0},
    {"mooring_with_much_chain_on_the_bed", {0, 0, -depth}, {600, 0, 0}, 760.0},
    {"mooring_with_friction", {0, 0, -depth}, {600, 0, 0}, 740.0, 0.0, 0.8},
    {"mooring_on_a_hard_bed", {0, 0, -depth}, {600, 0, 0}, 700.0, 0.0, 0.5, 1e-4},
    {"taut_line_that_just_touches", {0, 0, -depth}, {600, 0, 0}, 636.0},
    {"taut_line", {0, 0, -depth}, {600, 0, 0}, 630.0},
    {"both_ends_up", {0, 0, -100}, {500, 100, 0}, 640.0},
    {"both_ends_at_one_height", {0, 0, -50}, {400, 0, -50}, 620.0},
    {"stretched_on_the_bed", {0, 0, -depth}, {500, 0, -depth}, 499.5},
    {"stretched_on_the_bed_with_friction", {0, 0, -depth}, {500, 0, -depth}, 499.5, 0.0, 0.6, 0.01, 0.0, 0.0, 20},
    {"slack_on_the_bed_with_friction", {0, 0, -depth}, {400, 0, -depth}, 500.0, 0.0, 0.6},
    {"pipe", {0, 0, -depth}, {500, 0, 0}, 590.0, 2e7, 0.0, 0.01, 0.0, 0.0, 10},
    {"pipe_with_friction", {0, 0, -depth}, {500, 0, 0}, 590.0, 2e7, 0.7, 0.01, 0.0, 0.0, 10},
    {"mooring_on_a_slope", {0, 0, -depth}, {600, 0, 0}, 680.0, 0.0, 0.0, 0.01, 0.05, 0.0, 8},
    {"mooring_on_a_slope_with_friction", {0, 0, -depth}, {600, 0, 0}, 680.0, 0.0, 0.7, 0.01, -0.05, 0.0, 12},
    {"mooring_in_a_cross_current", {0, 0, -depth}, {600, 0, 0}, 680.0, 0.0, 0.0, 0.01, 0.0, 1.0, 30},
};

void PrintTo(const Case& lying, std::ostream* out) { *out << lying.name; }

class OnTheSeabed : public ::testing::TestWithParam<Case> {};

INSTANTIATE_TEST_SUITE_P(Lines, OnTheSeabed, ::testing::ValuesIn(cases), [](const auto& lying) { return std::string(lying.param.name); });

TEST_P(OnTheSeabed, FindsItsEquilibriumFromNothing) {
  const test::StaticSolution solution(scene(GetParam()));
  EXPECT_LE(solution.report.iterations, GetParam().factorizations);
  const SeabedContact contact = observe_seabed(*solution.model, solution.state, 0);
  EXPECT_LE(contact.largest_penetration, 3.0 * GetParam().sinks);
  if (GetParam().current > 0.0 || (GetParam().slope != 0.0 && GetParam().friction > 0.0)) return;  // drag or friction carries a part too
  // The ends and the bed carry the weight: the residual of every node, added up. Its tolerance is 1e-10 of the largest reaction a node.
  const double carried = -solution.line.force_from.z() - solution.line.force_to.z() + contact.force;
  EXPECT_NEAR(carried, w * GetParam().length, 120 * 1e-10 * w * GetParam().length);
}

// Written the other way round, the line and its residuals are the same up to rounding and the tolerance of Newton. With friction and both
// ends on the bed it is laid from the other end then, and becomes its mirror image.
TEST_P(OnTheSeabed, IsTheSameFromItsOtherEnd) {
  const test::StaticSolution one(scene(GetParam())), other(scene(GetParam(), true));
  const bool mirrored = GetParam().friction > 0.0 && GetParam().to.z() == -depth;
  const double tolerance = 1e-7 * std::max(one.line.tension_from, one.line.tension_to);
  EXPECT_NEAR(one.line.tension_from, mirrored ? other.line.tension_from : other.line.tension_to, tolerance);
  EXPECT_NEAR(one.line.tension_to, mirrored ? other.line.tension_to : other.line.tension_from, tolerance);
  const SeabedContact a = observe_seabed(*one.model, one.state, 0), b = observe_seabed(*other.model, other.state, 0);
  EXPECT_NEAR(a.length, b.length, 1e-5 * GetParam().length);
}

// Friction makes the tangent unsymmetric: CHOLMOD takes its symmetric part. The same state to the tolerance of Newton, by every solver.
TEST(OnTheSeabed, EveryLinearSolverFindsTheSameState) {
  const Case mooring = cases[2];
  const Model model = build_model(scene(mooring));
  const Assembler assembler(model);
  double first = 0.0;
  for (LinearSolverKind kind :
       {LinearSolverKind::chain, LinearSolverKind::band, LinearSolverKind::umfpack, LinearSolverKind::klu, LinearSolverKind::cholmod}) {
    StaticOptions options;
    options.linear_solver = kind;
    State state;
    const StaticReport report = solve_static(assembler, options, state);
    ASSERT_TRUE(report.converged) << report.linear_solver << ": " << report.failure.what;
    const double tension = observe_line(model, state, 0).tension_to;
    if (first == 0.0) first = tension;
    EXPECT_NEAR(tension, first, 1e-7 * first) << report.linear_solver;
  }
}

TEST(LaidShape, IsTheCatenaryOfTheFreePartAndLevelOnTheBed) {
  Scene s = scene(cases[0]);
  const Model model = build_model(s);
  const auto shape = laid_shape(model, 0, cases[0].from, cases[0].to);
  ASSERT_TRUE(shape);
  const Line& line = model.lines[0];
  EXPECT_NEAR((shape->r.back() - cases[0].to).norm(), 0.0, 1e-9);
  // Free part: V = w (s - s0), H constant; the slope tells both. s0 is the touchdown.
  const auto force = [&](int i) { return Vec3(shape->right[i].normalized() * (shape->right[i].norm() - 1.0) * 3e8); };
  const int last = line.nodes - 1;
  const double H = force(last).x();
  for (int i = 0; i <= last; ++i) {
    if (shape->right[i].z() > 0.0) {
      EXPECT_NEAR(force(i).x(), H, 1e-6 * H);
      EXPECT_NEAR(force(last).z() - force(i).z(), w * (line.s[last] - line.s[i]), 1e-6 * H);
    } else {
      EXPECT_NEAR(shape->r[i].z(), -depth - 0.01, 1e-12);
      EXPECT_NEAR(shape->r[i].x(), (1.0 + H / 3e8) * line.s[i], 1e-9 * line.length);
    }
  }
}

TEST(LaidShape, IsNotThereForABuoyantLine) {
  Scene s = scene(cases[0]);
  s.line_types[0].wet_weight = -100.0;
  const Model model = build_model(s);
  EXPECT_FALSE(laid_shape(model, 0, cases[0].from, cases[0].to));
}

TEST(OnTheSeabed, ALineRestsInAValleyAlongAGridLine) {
  Case lying{"valley", {0, 0, -depth}, {600, 0, 0}, 680.0};
  Scene s = scene(lying);
  s.environment.depth.reset();
  BathymetryGrid grid{{-100.0, 200.0, 700.0}, {-50.0, 0.0, 50.0}, {}};
  for (double y : grid.y)
    for (std::size_t i = 0; i < 3; ++i) grid.z.push_back(-depth + 0.1 * std::abs(y));
  s.environment.seabed.bathymetry = grid;
  s.lines[0].start.reset();
  const test::StaticSolution valley(s), level(scene(lying));
  // In the valley the bed is level along the line: the same tensions.
  EXPECT_NEAR(valley.line.tension_to, level.line.tension_to, 1e-7 * level.line.tension_to);
}

}  // namespace
}  // namespace hawser
