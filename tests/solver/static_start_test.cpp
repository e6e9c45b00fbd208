// First guesses of a static shape: catenaries of one and several segments, marching from a free end, straight lines, tables.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

#include "solver/static_start_catenary.hpp"
#include "solver/static_start_loads.hpp"
#include "solver/static_start_march.hpp"
#include "solver/static_start_shape.hpp"
#include "tests/support/reference_case.hpp"
#include "tests/support/scene_builder.hpp"
#include "tests/support/static_solution.hpp"

namespace hawser::test {
namespace {

/// A random number in [low, high] with 1e-6 resolution.
double number(double low, double high) { return low + (high - low) * 1e-6 * *rc::gen::inRange(0, 1000001); }

Vec3 node_position(const Model& model, const State& state, int node) { return Eigen::Map<const Vec3>(&state.q[model.dof(0, node)]); }
Vec3 node_slope(const Model& model, const State& state, int node) { return Eigen::Map<const Vec3>(&state.q[model.dof(0, node) + 3]); }

TEST(CatenarySegment, ComplianceIsTheDerivativeOfTheSpan) {
  const CatenarySegment heavy{100.0, 1e6, {1.0, 2.0, -10.0}, Vec3::Zero()};
  const CatenarySegment weightless{100.0, 1e6, Vec3::Zero(), Vec3::Zero()};
  for (const CatenarySegment& segment : {heavy, weightless})
    for (const Vec3& F : {Vec3(300.0, -20.0, -400.0), Vec3(300.0, -20.0, 900.0), Vec3(-5.0, 3.0, -2000.0)}) {
      const Mat3 C = catenary_compliance(segment, F, segment.length);
      Mat3 difference;
      const double h = 1e-3 * F.norm();
      for (int j = 0; j < 3; ++j)
        difference.col(j) = (catenary_span(segment, F + h * Vec3::Unit(j), 100.0) - catenary_span(segment, F - h * Vec3::Unit(j), 100.0)) / (2.0 * h);
      // central differences: error (h/H)^2 relative, H = 5.8 N or more across the load
      EXPECT_LT((C - difference).norm(), 2e-1 * C.norm() * std::min(1.0, std::pow(h / 5.0, 2)));
      EXPECT_LT((C - C.transpose()).norm(), 1e-15 * C.norm());
    }
}

// The end force solves theory 7.1: put into the closed form it must reach the far end. In all directions, taut and slack,
// EA from 1e4 to 1e11 N; the bound on the gap is rounding, 1e-12 of the length.
RC_GTEST_PROP(EndForce, ReachesTheFarEndOverAnySpan, ()) {
  const double EA = std::pow(10.0, number(4.0, 11.0)), L = std::pow(10.0, number(0.0, 4.0)), w = std::pow(10.0, number(-1.0, 3.0));
  const int kind = *rc::gen::inRange(0, 4);
  const double tiny = std::pow(10.0, number(-8.0, -1.0));
  const double ratio = kind == 0 ? number(0.05, 1.0) : kind == 1 ? 1.0 - tiny : kind == 2 ? 1.0 + tiny : 1.0;
  const double angle = *rc::gen::element(number(-1.5707, 1.5707), 0.5 * std::numbers::pi, -0.5 * std::numbers::pi, 0.0);
  const Vec3 chord = ratio * L * Vec3(std::cos(angle), 0.0, std::sin(angle));
  const double sign = *rc::gen::element(1.0, -1.0);  // heavy or buoyant
  const EndForce end = solve_end_force({{L, EA, {0.0, 0.0, -sign * w}, Vec3::Zero()}}, chord);
  RC_ASSERT(end.converged);
  RC_ASSERT(end.gap <= 1e-12 * L);
  const double H = end.force.head<2>().norm(), V = sign * end.force.z();
  if (H > 1e-6 * (std::abs(V) + w * L)) {  // the formula of theory 7.1, where its two square roots do not cancel
    const double x = H * L / EA + H / w * (std::asinh((V + w * L) / H) - std::asinh(V / H));
    RC_ASSERT(std::abs(x - chord.head<2>().norm()) <= 1e-9 * L * (1.0 + 1e-3 * H / (w * L)));
  }
}

RC_GTEST_PROP(EndForce, ReachesTheFarEndThroughSectionsAndClumps, ()) {
  const double L = std::pow(10.0, number(1.0, 3.5));
  std::vector<CatenarySegment> segments(*rc::gen::inRange(2, 6));
  for (CatenarySegment& s : segments) {
    s = {L / segments.size(), std::pow(10.0, number(5.0, 10.0)), {0.0, number(-5.0, 5.0), number(-50.0, 50.0)}, Vec3::Zero()};
    s.point = L * Vec3(number(-5.0, 5.0), number(-5.0, 5.0), number(-20.0, 20.0));
  }
  const EndForce end = solve_end_force(segments, number(0.1, 1.05) * L * Vec3(number(0.5, 1.0), 0.0, number(-1.0, 1.0)).normalized());
  RC_ASSERT(end.converged);
  RC_ASSERT(end.gap <= 1e-11 * L);
}

TEST(StaticStart, CatenaryOfDeepSceneMeetsItsClosedForm) {
  const ReferenceCase reference("static_catenary_deep5000_sceneS1");
  const Scene scene = SceneBuilder().type(u40()).fixed("a", {0, 0, -3000}).fixed("b", {3000, 0, 0}).line("a", "b").section("U40", 5000.0, 10).scene;
  const Model model = build_model(scene);
  const State state = static_start(model, StaticStart::catenary);
  const auto x = reference.value<std::vector<double>>("stations_x"), z = reference.value<std::vector<double>>("stations_z");
  const auto T = reference.value<std::vector<double>>("stations_T");
  for (int i = 0; i <= 10; ++i) {
    // Rounding: the end force is known to about eps EA, positions to eps of the length, times the condition of the span.
    EXPECT_NEAR(node_position(model, state, i).x(), x[i], 1e-10);
    EXPECT_NEAR(node_position(model, state, i).z(), z[i], 1e-10);
    EXPECT_NEAR(node_slope(model, state, i).norm(), 1.0 + T[i] / 4.0e7, 1e-14);
  }
}

TEST(StaticStart, CatenaryOfSeveralSectionsIsTheEquilibriumAndJumpsWhereClumpsAre) {
  const Scene scene = SceneBuilder()
                          .dry()
                          .type(line_type("heavy", 1e8, 100.0))
                          .type(line_type("light", 5e6, -80.0))
                          .fixed("a", {0, 0, 0})
                          .fixed("b", {220, 0, 150})
                          .line("a", "b")
                          .section("heavy", 150.0, 30)
                          .section("light", 100.0, 20)
                          .section("heavy", 120.0, 24)
                          .load(60.0, weight(3000.0))
                          .scene;
  const StaticSolution solution(scene);
  // On 5 m elements the start differs from the equilibrium by the discretisation error alone: two iterations at most.
  EXPECT_LE(solution.report.iterations, 2);
  const Model& model = *solution.model;
  const State start = static_start(model, StaticStart::catenary);
  for (const Joint& joint : model.joints) {
    ASSERT_EQ(joint.jump, Jump::free);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(start.q[joint.inner + c], solution.state.q[joint.inner + c], 1e-2);
  }
}

TEST(StaticStart, DragIsInTheCatenaryOfACurrent) {
  // From the catenary without drag a 2 m/s current takes 12 iterations (theory 7.2).
  const Scene scene = SceneBuilder()
                          .type(u40())
                          .current(0.0, {2.0, 0, 0})
                          .fixed("a", {0, 0, -3000})
                          .fixed("b", {3000, 0, 0})
                          .line("a", "b")
                          .section("U40", 5000.0, 500)
                          .scene;
  EXPECT_LE(StaticSolution(scene).report.iterations, 4);
}

TEST(StaticStart, MarchFromAFreeEndMeetsTheTowReference) {
  const ReferenceCase reference("static_tow_neutral_cable_elastic");
  LineType type = u40();
  type.EA = 2.0e6;
  type.wet_weight = 0.0;
  type.diameter = 0.02;
  type.drag_normal = 1.5;
  type.drag_tangential = 0.01;
  BodySpec body = weight(8000.0);
  body.drag_area = 0.5;
  const Scene scene = SceneBuilder()
                          .type(type)
                          .towed("ship", {0, 0, 0}, {3, 0, 0})
                          .free("fish", {-900, 0, -200}, body)
                          .line("fish", "ship")
                          .section("U40", 1000.0, 400)
                          .scene;
  const Model model = build_model(scene);
  const LineShape shape = march_from_free_end(model, 0, Vec3::Zero());
  // Runge-Kutta of order 4 with steps of 0.6 m on a shape that bends within 100 m: 1e-9 of the length.
  EXPECT_NEAR(-shape.r.front().z(), reference.value("depth of tow (top z - body z) [drag per unstretched length]"), 1e-6);
  EXPECT_NEAR(-shape.r.front().x(), reference.value("layback (top x - body x) [drag per unstretched length]"), 1e-6);
  EXPECT_NEAR(shape.left.back().norm(), 1.0 + reference.value("top tension [drag per unstretched length]") / 2.0e6, 1e-10);
}

TEST(StaticStart, MarchGivesTheSameShapeFromEitherEnd) {
  BodySpec clump = weight(500.0);
  const auto scene = [&](bool from_free) {
    SceneBuilder b;
    b.type(u40()).current(0.0, {0.8, 0.2, 0}).fixed("top", {0, 0, 0}).free("tail", {0, 0, -900}, weight(300.0));
    from_free ? b.line("tail", "top") : b.line("top", "tail");
    b.section("U40", 1000.0, 50).load(from_free ? 600.0 : 400.0, clump);
    return b.scene;
  };
  const Model a = build_model(scene(true)), b = build_model(scene(false));
  const LineShape down = march_from_free_end(b, 0, Vec3::Zero()), up = march_from_free_end(a, 0, Vec3::Zero());
  const int n = a.lines[0].nodes;
  for (int i = 0; i < n; ++i) {
    EXPECT_LT((down.r[i] - up.r[n - 1 - i]).norm(), 1e-9);  // the same arithmetic up to signs and the order of sums
    EXPECT_LT((down.right[i] + up.left[n - 1 - i]).norm(), 1e-12);
  }
}

TEST(StaticStart, BareEndLeavesAlongItsLoadAtTheCriticalAngle) {
  const ReferenceCase reference("static_laying_zero_bottom_tension");
  LineType type = u40();
  type.drag_tangential = 0.0;
  const Scene scene = SceneBuilder()
                          .type(type)
                          .current(0.0, {reference.parameter("U").get<double>(), 0, 0})
                          .fixed("ship", {0, 0, 0})
                          .free("tail", {400, 0, -200})
                          .line("ship", "tail")
                          .section("U40", 500.0, 10)
                          .scene;
  const Model model = build_model(scene);
  const LineShape shape = march_from_free_end(model, 0, Vec3::Zero());
  for (const Vec3& slope : shape.right) EXPECT_NEAR(std::atan2(-slope.z(), slope.x()), reference.value("critical angle from horizontal"), 1e-12);
}

TEST(StaticStart, StraightStartLiesEvenlyOnTheChordWithItsStretch) {
  const Scene scene =
      SceneBuilder().type(u40()).fixed("a", {0, 0, -30}).fixed("b", {40, 0, 0}).line("a", "b").section("U40", 60.0, 4).section("U40", 40.0, 1).scene;
  const Model model = build_model(scene);
  const State state = static_start(model, StaticStart::straight);
  for (int i = 0; i < model.lines[0].nodes; ++i) {
    EXPECT_LT((node_position(model, state, i) - Vec3(0.4 * model.lines[0].s[i], 0, -30 + 0.3 * model.lines[0].s[i])).norm(), 1e-13);
    EXPECT_LT((node_slope(model, state, i) - Vec3(0.4, 0, 0.3)).norm(), 1e-15);
  }
}

TEST(StaticStart, StraightStartOfAFreeEndIsUnstrainedTowardsItsGuess) {
  const Scene scene = SceneBuilder().type(u40()).fixed("a", {1, 0, 0}).free("b", {1, 3, -4}).line("a", "b").section("U40", 100.0, 5).scene;
  const Model model = build_model(scene);
  const State state = static_start(model, StaticStart::straight);
  EXPECT_LT((node_position(model, state, 5) - Vec3(1, 60, -80)).norm(), 1e-12);
  EXPECT_LT((node_slope(model, state, 2) - Vec3(0, 0.6, -0.8)).norm(), 1e-15);
}

TEST(StaticStart, EveryNodeHasTheVelocityOfTheTow) {
  const Scene scene =
      SceneBuilder().type(u40()).towed("s", {0, 0, 0}, {1, 2, 0}).free("b", {0, 0, -90}, weight(10.0)).line("s", "b").section("U40", 100.0, 5).scene;
  const Model model = build_model(scene);
  const State state = static_start(model, StaticStart::catenary);
  for (int i = 0; i < 6; ++i) {
    EXPECT_EQ(Vec3(Eigen::Map<const Vec3>(&state.v[model.dof(0, i)])), Vec3(1, 2, 0));
    EXPECT_EQ(Vec3(Eigen::Map<const Vec3>(&state.v[model.dof(0, i) + 3])), Vec3(0, 0, 0));
  }
}

TEST(StaticStart, TableGivesTheShapeAndUnitSlopes) {
  Scene scene = SceneBuilder().type(u40()).fixed("a", {0, 0, 0}).fixed("b", {60, 0, 0}).line("a", "b").section("U40", 100.0, 7).scene;
  ShapeTable table;  // down and up a semicircle of radius 100/pi, rows every 5 m
  const double R = 100.0 / std::numbers::pi;
  for (double s = 0.0; s <= 100.0; s += 5.0) {
    table.s.push_back(s);
    table.position.push_back({R * (1.0 - std::cos(s / R)), 0.0, -R * std::sin(s / R)});
  }
  scene.lines[0].start = table;
  const Model model = build_model(scene);
  const State state = static_start(model, StaticStart::catenary, scene);
  for (int i = 1; i < 7; ++i) {
    const double s = model.lines[0].s[i];
    // Hermite with central differences for slopes: error h^3/8 |r'''| = 5^3 / (8 R^2) = 0.016 m at most
    EXPECT_LT((node_position(model, state, i) - Vec3(R * (1.0 - std::cos(s / R)), 0.0, -R * std::sin(s / R))).norm(), 0.016);
    EXPECT_NEAR(node_slope(model, state, i).norm(), 1.0, 1e-14);
  }
  EXPECT_EQ(node_position(model, state, 7), Vec3(60, 0, 0));  // the support, not the table
}

}  // namespace
}  // namespace hawser::test
