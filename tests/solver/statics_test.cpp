// Static solves: stages, certificate, failures, and what the answers must satisfy on any mesh.
#include "solver/statics.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "solver/newton.hpp"
#include "solver/static_system.hpp"
#include "tests/support/deep_span.hpp"
#include "tests/support/reference_case.hpp"
#include "tests/support/scene_builder.hpp"
#include "tests/support/static_solution.hpp"

namespace hawser::test {
namespace {

TEST(Statics, DeepCatenaryTakesThreeFactorizationsOrFewerAndMeetsItsEndTensionsTo1e9) {
  const ReferenceCase reference("static_catenary_deep5000_sceneS1");
  const StaticSolution s(deep(1000).scene);
  EXPECT_LE(s.report.iterations, 3);
  EXPECT_NEAR(s.line.tension_from, reference.value("T_end_s0"), 1e-9 * reference.value("T_end_s0"));
  EXPECT_NEAR(s.line.tension_to, reference.value("T_end_sL0"), 1e-9 * reference.value("T_end_sL0"));
}

TEST(Statics, StraightStartOfTheDeepCatenaryEndsInTheSameState) {
  const StaticSolution catenary(deep(1000).scene), straight(deep(1000).scene, StaticStart::straight);
  EXPECT_LE(straight.report.iterations, 20);
  // Both residuals are below F_floor; a transverse force f moves the line by f L/(4H), H = 13.2 kN.
  const double noise = 2.0 * straight.report.roundoff_floor * 5000.0 / (4.0 * 13161.0);
  EXPECT_LT(largest_distance(*catenary.model, catenary.state, straight.state), noise);
}

TEST(Statics, EveryFamilyAndStartFindsTheSameCatenary) {
  for (const double EI : {0.0, 1.0e3})
    for (const double L : {4240.0, 4300.0, 5000.0, 7500.0}) {
      const StaticSolution catenary(deep(500, EI, L).scene), straight(deep(500, EI, L).scene, StaticStart::straight);
      EXPECT_LE(catenary.report.iterations, 3) << EI << " " << L;
      EXPECT_LE(straight.report.iterations, 25) << EI << " " << L;
      EXPECT_NEAR(straight.line.tension_to, catenary.line.tension_to, 2.0 * catenary.report.roundoff_floor) << EI << " " << L;
    }
  Scene bars = deep(500).scene;
  bars.lines[0].model = ModelChoice::bar;
  EXPECT_LE(StaticSolution(bars).report.iterations, 6);
  EXPECT_LE(StaticSolution(bars, StaticStart::straight).report.iterations, 25);
}

TEST(Statics, NewtonConvergesQuadraticallyOnALine) {
  const Model model = build_model(deep(100).current(0.0, {0.5, 0.2, 0}).scene);
  const Assembler assembler(model);
  State state = static_start(model, StaticStart::straight);
  const auto linear = make_linear_solver(LinearSolverKind::chain);
  StaticSystem system(assembler, *linear, 1e-14, 1e-3, state);
  NewtonOptions options;
  options.length = 5000.0;
  options.floor = 0.25 * 11.885 * 5000.0;
  const NewtonReport report = newton(system, options);
  ASSERT_TRUE(report.converged());
  // Once R is under the line tension (56 kN) R' <= C R^2, C of the order of one over the tension: 1e-5 /N is asked. A
  // linear tail would need C = ratio/R, beyond it from R = 1e4 N down. Measured while R' is far above rounding.
  std::size_t k = report.residuals.size() - 1;
  while (k > 0 && report.residuals[k - 1] < 5.6e4) --k;  // the tail begins after the last larger residual
  int measured = 0;
  for (++k; k < report.residuals.size() && report.residuals[k] > 1e3 * system.roundoff(); ++k, ++measured)
    EXPECT_LT(report.residuals[k] / (report.residuals[k - 1] * report.residuals[k - 1]), 1e-5);
  EXPECT_GE(measured, 2);
}

TEST(Statics, AllLinearSolversGiveTheSameAnswerInACurrent) {
  const Model model = build_model(deep(200).current(0.0, {0.3, 0.6, 0}).scene);
  State expected;
  ASSERT_TRUE(solve(model, expected).converged);
  for (const LinearSolverKind kind : all_linear_solvers()) {
    State state;
    const StaticReport report = solve(model, state, StaticStart::catenary, kind);
    EXPECT_TRUE(report.converged) << name_of(kind);
    EXPECT_EQ(report.modified_newton, kind == LinearSolverKind::cholmod) << name_of(kind);
    // What is left at every one of n nodes, at most the tolerance 1e-10 F_ref, adds up for a modified Newton (its last
    // increments all point the same way): n f L / (8 H).
    const double f = std::max(1e-10 * report.reference_force, report.roundoff_floor);
    EXPECT_LT(largest_distance(model, state, expected), 200.0 * f * 5000.0 / (8.0 * 13161.0)) << name_of(kind);
  }
}

TEST(Statics, MidspanClumpWithBendingGivesTheRightTensionOnBothSidesOnEveryMesh) {
  // Level span of 100 m, a line of 110 m and 15 kN in its middle. By symmetry each side of the clump carries half of it:
  // V = 7.5 kN up, less nothing (weight of the line beside the node is not yet passed), and H is the same on both sides.
  for (const int elements : {4, 10, 50, 200}) {
    const Scene scene = SceneBuilder()
                            .dry()
                            .type(line_type("beam", 4.0e7, 11.885, 120.0))
                            .fixed("a", {0, 0, 0})
                            .fixed("b", {100, 0, 0})
                            .line("a", "b")
                            .section("beam", 110.0, elements)
                            .load(55.0, weight(15000.0))
                            .scene;
    const StaticSolution s(scene);
    const int middle = elements / 2;
    const Vec3 F = s.line.force_from;  // internal force at s = 0: T(0)
    const double V = 7500.0, H = std::hypot(F.x(), F.y());
    // The beam turns at the clump, so that the tangent is level there: tension is H, and V is shear. The tangent's exact
    // direction at the node decides; both sides share it.
    const Vec3 t = s.slope(middle).normalized();
    const double left = std::abs(H * std::hypot(t.x(), t.y()) - V * t.z()), right = std::abs(H * std::hypot(t.x(), t.y()) + V * t.z());
    const double noise = 4.0 * s.report.roundoff_floor;
    EXPECT_NEAR(std::abs(F.z()), V + 0.5 * 11.885 * 110.0, noise) << elements;
    EXPECT_NEAR(s.line.tension_left[middle], left, noise) << elements;
    EXPECT_NEAR(s.line.tension_right[middle], right, noise) << elements;
    EXPECT_EQ(s.model->joints.size(), 1u);
    EXPECT_EQ(s.model->joints[0].jump, Jump::scaled);
  }
}

TEST(Statics, ClumpOnAVerticalBeamHasItsWeightAsTheJumpOfTensionOnEveryMesh) {
  for (const int elements : {2, 10, 100}) {
    const Scene scene = SceneBuilder()
                            .dry()
                            .type(line_type("beam", 4.0e7, 11.885, 120.0))
                            .fixed("a", {0, 0, 0})
                            .free("b", {0, 0, -100}, weight(2000.0))
                            .line("a", "b")
                            .section("beam", 100.0, elements)
                            .load(50.0, weight(15000.0))
                            .scene;
    const StaticSolution s(scene);
    const int middle = elements / 2;
    const double noise = 4.0 * s.report.roundoff_floor;
    EXPECT_NEAR(s.line.tension_right[middle], 2000.0 + 50.0 * 11.885, noise);
    EXPECT_NEAR(s.line.tension_left[middle], 17000.0 + 50.0 * 11.885, noise);
    EXPECT_NEAR(s.line.tension_from, 17000.0 + 100.0 * 11.885, noise);
  }
}

TEST(Statics, CompressedColumnIsNeverAccepted) {
  // 110 m between points 100 m above each other: straight and compressed satisfies R = 0 exactly.
  for (const double EI : {0.0, 100.0})
    for (const StaticStart start : {StaticStart::straight, StaticStart::catenary}) {
      const Scene scene = SceneBuilder()
                              .dry()
                              .type(line_type("line", 1.0e6, 11.0, EI))
                              .fixed("a", {0, 0, 0})
                              .fixed("b", {0, 0, 100})
                              .line("a", "b")
                              .section("line", 110.0, 44)
                              .scene;
      const Model model = build_model(scene);
      State state;
      const StaticReport report = solve(model, state, start);
      EXPECT_EQ(report.converged, report.stable);
      if (report.converged) {  // off the column: the line hangs out sideways
        double sideways = 0.0;
        for (int i = 0; i < model.lines[0].nodes; ++i)
          sideways = std::max(sideways, std::abs(state.q[model.dof(0, i)]) + std::abs(state.q[model.dof(0, i) + 1]));
        EXPECT_GT(sideways, 0.1);
      } else {
        EXPECT_FALSE(report.failure.what.empty());
        EXPECT_GT(report.negative_pivots, 0);
      }
    }
}

TEST(Statics, BeamBelowItsEulerLoadStaysStraightAndAboveItBuckles) {
  // Pinned column of 10 m, EI = 1000 N m2: P_cr = pi^2 EI / L^2 = 98.7 N. Loaded by pushing the ends together (weightless).
  const double EA = 1.0e5, euler = std::numbers::pi * std::numbers::pi * 1000.0 / 100.0;
  for (const double share : {0.9, 1.1}) {
    const double chord = 10.0 * (1.0 - share * euler / EA);
    // A side load of 0.01 N/m decides the direction; without it the state is undetermined above the Euler load.
    const Scene scene = SceneBuilder()
                            .dry()
                            .type(line_type("column", EA, 1e-2, 1000.0))
                            .fixed("a", {0, 0, 0})
                            .fixed("b", {chord, 0, 0})
                            .line("a", "b")
                            .section("column", 10.0, 40)
                            .scene;
    const StaticSolution s(scene, StaticStart::straight);
    EXPECT_TRUE(s.report.stable);
    const double sag = -s.station(5.0).position.z();
    // Below: the side load's deflection 5 w L^4/(384 EI) = 1.3 mm, enlarged by 1/(1 - P/P_cr) = 10. Above: the shortening
    // beyond the Euler strain goes into bending, a = (2 L/pi) sqrt(0.1 P_cr/EA) = 63 mm (linear theory, a/L = 0.6 %).
    if (share < 1.0)
      EXPECT_LT(sag, 0.02);
    else
      EXPECT_NEAR(std::abs(sag), 20.0 / std::numbers::pi * std::sqrt(0.1 * euler / EA), 0.01);
  }
}

TEST(Statics, BareHangingEndHasNoTensionAndIsNotSingular) {
  const StaticSolution s(SceneBuilder().type(u40()).fixed("a", {0, 0, 0}).free("b", {0, 0, -1000}).line("a", "b").section("U40", 1000.0, 100).scene);
  EXPECT_NEAR(s.line.tension_to, 0.0, 2.0 * s.report.roundoff_floor);
  EXPECT_NEAR(s.line.tension_from, 11885.140165506199, 2.0 * s.report.roundoff_floor);
}

TEST(Statics, SteadyTowHasTheVelocityOfTheShipEverywhere) {
  const StaticSolution s(SceneBuilder()
                             .type(u40())
                             .towed("ship", {0, 0, 0}, {1.5, 0.5, 0})
                             .free("fish", {-500, 0, -500}, weight(3000.0))
                             .line("ship", "fish")
                             .section("U40", 800.0, 40)
                             .scene);
  for (int i = 0; i < s.model->lines[0].nodes; ++i) EXPECT_EQ(Vec3(Eigen::Map<const Vec3>(&s.state.v[s.model->dof(0, i)])), Vec3(1.5, 0.5, 0));
}

TEST(Statics, TowThroughStillWaterEqualsTheOppositeCurrent) {
  const auto build = [](bool tow) {
    SceneBuilder b;
    b.type(u40());
    tow ? b.towed("top", {0, 0, 0}, {0.7, 0, 0}) : b.fixed("top", {0, 0, 0}).current(0.0, {-0.7, 0, 0});
    b.free("fish", {0, 0, -500}, weight(3000.0)).line("top", "fish").section("U40", 800.0, 40);
    return b.scene;
  };
  const StaticSolution tow(build(true)), current(build(false));
  EXPECT_LT(largest_distance(*tow.model, tow.state, current.state), 1e-9);
}

TEST(Statics, LineThatNothingHoldsIsRefused) {
  const Model model =
      build_model(SceneBuilder().type(u40()).free("a", {0, 0, 0}).free("b", {0, 0, -90}).line("a", "b").section("U40", 100.0, 5).scene);
  State state;
  const StaticReport report = solve(model, state);
  EXPECT_FALSE(report.converged);
  EXPECT_NE(report.failure.what.find("nothing holds"), std::string::npos);
  EXPECT_NE(report.failure.cause.find("\"a\""), std::string::npos);
  EXPECT_EQ(report.failure.line, "line");
  EXPECT_FALSE(report.failure.remedy.empty());
}

TEST(Statics, SlackLineWithoutLoadIsRefusedAndATautOneIsSolved) {
  const auto scene = [](double L) {
    return SceneBuilder()
        .dry()
        .type(line_type("thread", 1.0e5, 0.0))
        .fixed("a", {0, 0, 0})
        .fixed("b", {100, 0, 0})
        .line("a", "b")
        .section("thread", L, 10)
        .scene;
  };
  const Model slack = build_model(scene(101.0));
  State state;
  const StaticReport report = solve(slack, state);
  EXPECT_FALSE(report.converged);
  EXPECT_NE(report.failure.what.find("slack"), std::string::npos);
  const StaticSolution taut(scene(99.0));
  EXPECT_NEAR(taut.line.tension_to, 1.0e5 * (100.0 / 99.0 - 1.0), 2.0 * taut.report.roundoff_floor);
}

TEST(Statics, TooFewIterationsAreReportedWithPlaceCauseAndRemedy) {
  const Model model = build_model(deep(100).scene);
  const Assembler assembler(model);
  StaticOptions options;
  options.start = StaticStart::straight;
  options.max_iterations = 3;
  std::vector<std::string> log;
  options.log = [&](const std::string& line) { log.push_back(line); };
  State state;
  const StaticReport report = solve_static(assembler, options, state);
  EXPECT_FALSE(report.converged);
  EXPECT_EQ(report.iterations, 3);
  EXPECT_EQ(report.failure.line, "line");
  EXPECT_NE(report.failure.what.find("residual"), std::string::npos);
  EXPECT_FALSE(report.failure.cause.empty());
  EXPECT_FALSE(report.failure.remedy.empty());
  EXPECT_EQ(log, report.stages);
}

TEST(Statics, GivenStateIsTheStart) {
  const Model model = build_model(deep(200).scene);
  State state;
  ASSERT_TRUE(solve(model, state).converged);
  EXPECT_EQ(solve(model, state, StaticStart::given).iterations, 1);
}

}  // namespace
}  // namespace hawser::test
