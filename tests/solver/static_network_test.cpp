// Statics of lines that meet at free points: against one line, closed forms, symmetry.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <numbers>
#include <random>

#include "solver/bordered_solver.hpp"
#include "solver/end_stiffness.hpp"
#include "solver/static_failure.hpp"
#include "solver/static_system.hpp"
#include "tests/support/network_scenes.hpp"
#include "tests/support/static_solution.hpp"

namespace hawser::test {
namespace {

struct InSeries {
  const char* name;
  double EI;
  double x;        // m, of the top end
  double depth;    // m, of a bed; 0: none
  double current;  // m/s
  double clump;    // N; 0: nothing at the meeting point
  double tolerance;
};

/// One line of 500 m in 50 elements, or two of 300 and 200 m with the same nodes.
Scene series(const InSeries& c, bool two) {
  LineType type = u40();
  type.EI = c.EI;
  SceneBuilder b;
  if (c.current != 0.0) b.current(0.0, {c.current, 0.5 * c.current, 0}).current(-300.0, {0, 0.2 * c.current, 0});
  b.type(type).fixed("bottom", {0, 0, c.depth > 0.0 ? -c.depth : -300.0}).fixed("top", {c.x, 0, 0});
  if (c.depth > 0.0) b.scene.environment.depth = c.depth;
  if (!two) {
    b.line("bottom", "top").section("U40", 500.0, 50);
    if (c.clump != 0.0) b.load(300.0, weight(c.clump));
    return b.scene;
  }
  b.free("knot", {100, 10, -200}, weight(c.clump));
  b.line("bottom", "knot").section("U40", 300.0, 30);
  b.line("knot", "top").section("U40", 200.0, 20);
  return b.scene;
}

class Series : public ::testing::TestWithParam<InSeries> {};

TEST_P(Series, OfTwoLinesHasTheTensionsOfOneLine) {
  const StaticSolution one(series(GetParam(), false)), two(series(GetParam(), true));
  const LineResult upper = observe_line(*two.model, two.state, 1);
  const double scale = one.line.tension_to;
  EXPECT_NEAR(two.line.tension_from, one.line.tension_from, GetParam().tolerance * scale);
  EXPECT_NEAR(upper.tension_to, one.line.tension_to, GetParam().tolerance * scale);
  EXPECT_NEAR(two.line.tension_left.back(), one.line.tension_left[30], GetParam().tolerance * scale);
  EXPECT_NEAR(upper.tension_right.front(), one.line.tension_right[30], GetParam().tolerance * scale);
  EXPECT_LT((position(two, "knot") - one.station(300.0).position).norm(), 500.0 * GetParam().tolerance);
  const PointResult knot = point_of(two, "knot");
  EXPECT_LT((knot.force + knot.bed + Vec3(0, 0, -GetParam().clump)).norm(), 1e-9 * scale);
}

// With a body there (EI = 0) the one line has a slope jump at that node: the same discrete problem, equal to the tolerance of Newton. Without one
// it shares its slope where the two have one each: equal to the error of the mesh, 1e-9 (README.md of solver) and in a current what it is there.
INSTANTIATE_TEST_SUITE_P(Cases, Series,
                         ::testing::Values(InSeries{"StillWater", 0, 320, 0, 0, 0, 1e-9}, InSeries{"Clump", 0, 320, 0, 0, 3000, 1e-9},
                                           InSeries{"ClumpInACurrent", 0, 320, 0, 1.0, 3000, 1e-9}, InSeries{"Buoy", 0, 320, 0, 0.5, -4000, 1e-9},
                                           InSeries{"ClumpOverABed", 0, 320, 200, 0, 2000, 1e-9},
                                           InSeries{"MeetingOnTheBed", 0, 400, 150, 0, 0.5, 1e-9}),
                         [](const auto& test) { return test.param.name; });

TEST(LinesThatShareNothing, AreSolvedAsEachIsAlone) {
  const auto scene = [](bool first, bool second) {
    SceneBuilder b;
    b.type(u40())
        .current(0.0, {0.4, 0.1, 0})
        .fixed("a", {0, 0, 0})
        .fixed("b", {60, 0, -300})
        .fixed("c", {0, 40, 0})
        .free("d", {0, 40, -200}, weight(900.0));
    if (first) b.line("a", "b").section("U40", 400.0, 150).load(120.0, weight(700.0));
    if (second) b.line("c", "d").section("U40", 200.0, 90);
    return b.scene;
  };
  const StaticSolution both(scene(true, true)), first(scene(true, false)), second(scene(false, true));
  const LineResult other = observe_line(*both.model, both.state, 1);
  EXPECT_NEAR(both.line.tension_from, first.line.tension_from, 1e-9 * first.line.tension_from);
  EXPECT_NEAR(both.line.tension_to, first.line.tension_to, 1e-9 * first.line.tension_from);
  EXPECT_NEAR(other.tension_from, second.line.tension_from, 1e-9 * second.line.tension_from);
  EXPECT_LT((position(both, "d") - position(second, "d")).norm(), 1e-8 * 200.0);
}

/// Elastic catenary with the force (H, V) at its top end: horizontal and vertical span.
Eigen::Vector2d span(double H, double V, double w, double L, double EA) {
  const double below = V - w * L, top = std::hypot(H, V), bottom = std::hypot(H, below);
  return {H / w * (std::asinh(V / H) - std::asinh(below / H)) + H * L / EA, (top - bottom) / w + (V * V - below * below) / (2.0 * w * EA)};
}

Vec3 around(double radius, double degrees, double z) {
  const double a = degrees * std::numbers::pi / 180.0;
  return {radius * std::cos(a), radius * std::sin(a), z};
}

TEST(ThreeLegs, HoldAWeightAsThreeCatenaries) {
  const double w = 12.2, L = 200.0, EA = 4.0e7, W = 6000.0, H = 2500.0;
  // The end force at the anchors is H and W/3 + w L upward.
  const Eigen::Vector2d reach = span(H, W / 3.0 + w * L, w, L, EA);
  SceneBuilder b;
  b.type(line_type("rope", EA, w)).free("knot", {10, -5, -80}, weight(W));
  for (const double at : {30.0, 150.0, 270.0}) {
    const std::string name = "a" + std::to_string(static_cast<int>(at));
    b.fixed(name, around(reach[0], at, 0.0)).line(name, "knot").section("rope", L, 100);
  }
  const StaticSolution s(b.scene);
  EXPECT_LT((position(s, "knot") - Vec3(0, 0, -reach[1])).norm(), 1e-8 * L);  // 100 elements: 1e-9 of the tension
  for (int line = 0; line < 3; ++line) {
    const LineResult r = observe_line(*s.model, s.state, line);
    EXPECT_NEAR(r.tension_from, std::hypot(H, W / 3.0 + w * L), 1e-9 * W);
    EXPECT_NEAR(r.tension_to, std::hypot(H, W / 3.0), 1e-8 * W);
    EXPECT_NEAR(r.force_to.z(), W / 3.0, 1e-9 * W);
  }
  EXPECT_LE(s.report.iterations, 3);
}

TEST(ThreeLegs, AnswerAnyLoadAsThreeSprings) {
  const double EA = 1.0e6, L = 10.0;
  const std::vector<Vec3> anchors{{10, 0, 2}, {-6, 8, 1}, {-5, -9, 3}};
  for (const Vec3& load : {Vec3(3000, 0, 0), Vec3(-2000, 4000, 100), Vec3(500, -700, -6000), Vec3(0, 0, 5000)}) {
    SceneBuilder b;
    b.dry().type(line_type("wire", EA, 0.0)).free("knot", {0.5, -0.3, 0.4}, test::force(load));
    for (std::size_t i = 0; i < 3; ++i) b.fixed("a" + std::to_string(i), anchors[i]).line("a" + std::to_string(i), "knot").section("wire", L, 4);
    // Newton on three springs EA/L from the same place.
    Vec3 r(0.5, -0.3, 0.4);
    for (int k = 0; k < 60; ++k) {
      Vec3 f = load;
      Mat3 K = Mat3::Zero();
      for (const Vec3& a : anchors) {
        const Vec3 d = a - r, t = d.normalized();
        const double T = EA * (d.norm() / L - 1.0);
        f += T * t;
        K += EA / L * t * t.transpose() + std::max(T, 0.0) / d.norm() * (Mat3::Identity() - t * t.transpose());
      }
      r += K.ldlt().solve(f) * std::min(1.0, 20.0 / (k + 1.0));
    }
    bool taut = true;
    for (const Vec3& a : anchors) taut = taut && (a - r).norm() > L;
    if (!taut) continue;  // a slack weightless leg has no one shape
    const StaticSolution s(b.scene);
    EXPECT_LT((position(s, "knot") - r).norm(), 1e-9 * L) << load.transpose();
    EXPECT_LT((force(s, "knot") + load).norm(), 1e-9 * load.norm());
  }
}

TEST(TwoLinesBetweenTheSamePoints, ShareTheLoad) {
  const auto scene = [](int lines) {
    LineType type = line_type("rope", 4.0e7 * 2 / lines, 12.0 * 2 / lines);
    SceneBuilder b;
    b.type(type).fixed("a", {0, 0, 0}).fixed("b", {300, 0, -50}).free("knot", {120, 0, -100}, weight(5000.0));
    for (int i = 0; i < lines; ++i) b.line("a", "knot").section("rope", 200.0, 40);
    b.line("knot", "b").section("rope", 220.0, 40);
    b.scene.line_types.push_back(line_type("other", 4.0e7, 12.0));
    b.scene.lines.back().sections[0].type = "other";
    return b.scene;
  };
  const StaticSolution one(scene(1)), two(scene(2));
  EXPECT_LT((position(two, "knot") - position(one, "knot")).norm(), 1e-9 * 200.0);
  EXPECT_NEAR(2.0 * two.line.tension_from, one.line.tension_from, 1e-9 * one.line.tension_from);
  EXPECT_NEAR(observe_line(*two.model, two.state, 1).tension_to, two.line.tension_to, 1e-9 * one.line.tension_from);
}

TEST(Ring, HangsFromItsPointWithItsWeight) {
  LineType soft = line_type("rope", 1.0e6, 20.0, 50.0);
  SceneBuilder b;
  b.type(line_type("wire", 4.0e7, 12.0)).type(soft);
  b.fixed("a", {-20, 0, 0}).fixed("b", {20, 0, 0}).free("knot", {0, 0, -10}, weight(100.0));
  b.line("a", "knot").section("wire", 25.0, 20).line("b", "knot").section("wire", 25.0, 20);
  b.line("knot", "knot").section("rope", 6.0, 24);
  const StaticSolution s(b.scene);
  const LineResult ring = observe_line(*s.model, s.state, 2);
  EXPECT_NEAR((ring.force_from + ring.force_to).z(), -120.0, 1e-6);
  EXPECT_NEAR(position(s, "knot").x(), 0.0, 1e-6);
  const std::vector<Station> nodes = observe_nodes(*s.model, s.state, 2);
  EXPECT_LT(nodes[12].position.z(), nodes[0].position.z() - 1.0);
}

TEST(YBridle, TowsABodyAsTensionAndGeometrySay) {
  // Weightless lines without drag, a body with k |v| v = 1/2 rho Cd A v^2 and a weight: tail and legs are straight.
  const double EA = 5.0e6, speed = 2.0, W = 4000.0, drag = 0.5 * 1025.0 * 1.5 * speed * speed, spread = 6.0, leg = 20.0, tail = 50.0;
  BodySpec fish = weight(W);
  fish.drag_area = 1.5;
  LineType wire = line_type("wire", EA, 0.0);
  SceneBuilder b;
  b.type(wire).towed("port", {0, spread, 0}, {speed, 0, 0}).towed("starboard", {0, -spread, 0}, {speed, 0, 0});
  b.free("knot", {-10, 1, -10}).free("fish", {-40, 0, -40}, fish);
  b.line("port", "knot").section("wire", leg, 6).line("starboard", "knot").section("wire", leg, 6).line("knot", "fish").section("wire", tail, 8);
  const StaticSolution s(b.scene);
  const Vec3 pull(-drag, 0, -W), knot = position(s, "knot"), end = position(s, "fish");
  const double T = pull.norm();
  EXPECT_LT((end - knot - tail * (1.0 + T / EA) * pull / T).norm(), 1e-8 * tail);
  // Of the legs: 2 T_leg a/c = T, T_leg = EA (c/leg - 1), c^2 = a^2 + spread^2.
  double a = std::sqrt(leg * leg - spread * spread);
  for (int k = 0; k < 50; ++k) {
    const double c = leg * (1.0 + 0.5 * T * std::hypot(a, spread) / a / EA);
    a = std::sqrt(c * c - spread * spread);
  }
  EXPECT_LT((knot - a * pull / T).norm(), 1e-8 * leg);
  EXPECT_LT((force(s, "port") + force(s, "starboard") - pull).norm(), 1e-9 * T);
}

/// A buoy held by three legs of chain on a bed at -100 m; anchors at radius 400.
Scene moored_buoy(const Vec3& pull, int elements) {
  SceneBuilder b;
  BodySpec buoy = test::force(pull);
  buoy.wet_weight = -3.0e5;
  b.type(line_type("chain", 5.0e8, 1000.0)).free("buoy", {0, 0, -5}, buoy);
  b.scene.environment.depth = 100.0;
  b.scene.environment.seabed.stiffness = 1.0e5;
  for (const double at : {0.0, 120.0, 240.0}) {
    const std::string name = "a" + std::to_string(static_cast<int>(at));
    b.fixed(name, around(400.0, at, -100.0)).line(name, "buoy").section("chain", 420.0, elements);
  }
  return b.scene;
}

TEST(MooredBuoy, FloatsWhereEachLegOnItsOwnCarriesAThirdOfIt) {
  const StaticSolution s(moored_buoy(Vec3::Zero(), 84));
  const Vec3 buoy = position(s, "buoy");
  EXPECT_LT(buoy.head<2>().norm(), 1e-6);
  SceneBuilder b;
  b.type(line_type("chain", 5.0e8, 1000.0)).fixed("anchor", around(400.0, 0.0, -100.0)).fixed("top", buoy);
  b.scene.environment = moored_buoy(Vec3::Zero(), 84).environment;
  b.line("anchor", "top").section("chain", 420.0, 84);
  const StaticSolution leg(b.scene);
  EXPECT_NEAR(-leg.line.force_to.z(), 1.0e5, 1e-6 * 1.0e5);
  EXPECT_NEAR(s.line.tension_to, leg.line.tension_to, 1e-6 * leg.line.tension_to);
  EXPECT_NEAR(s.line.tension_from, leg.line.tension_from, 1e-6 * leg.line.tension_to);
}

TEST(MooredBuoy, GivesWayToEveryPullAndBalancesIt) {
  for (const double at : {0.0, 45.0, 100.0, 180.0, 260.0}) {
    const Vec3 pull = around(1.5e5, at, -2.0e4);
    const StaticSolution s(moored_buoy(pull, 84));
    EXPECT_LT((force(s, "buoy") + pull + Vec3(0, 0, 3.0e5)).norm(), 1e-7 * 3.0e5) << at;
    EXPECT_GT(position(s, "buoy").dot(pull), 0.0);
  }
}

TEST(Network, EndStiffnessIsTheDerivativeOfTheEndForcesWithTheHubsFree) {
  const auto scene = [](const Vec3& at) {
    Scene moved = small_network(4, ModelChoice::cable);
    moved.points[1].position = at;
    return moved;
  };
  const Vec3 at(12, 1, 0);
  const StaticSolution s(scene(at), StaticStart::catenary, 1e-12);
  const std::vector<EndStiffness> ends = end_stiffness(*s.model, s.state);
  ASSERT_EQ(ends.size(), 3u);
  const Mat3 K = ends[1].value;  // line 1 from the hub to b
  const double h = 1e-4;
  for (int axis = 0; axis < 3; ++axis) {
    const auto held = [&](double step) {
      const StaticSolution moved(scene(at + step * Vec3::Unit(axis)), StaticStart::catenary, 1e-12);
      return Vec3(-force(moved, "b"));
    };
    EXPECT_LT((K.col(axis) - (held(h) - held(-h)) / (2.0 * h)).norm(), 1e-5 * K.norm()) << axis;
  }
}

/// Hubs hung between anchors around them and to one another; no two anchors of a hub are near each other in plan.
Scene random_network(std::mt19937& draw) {
  const auto in = [&](double a, double b) { return std::uniform_real_distribution<>(a, b)(draw); };
  const double R = std::exp(in(std::log(20.0), std::log(2000.0)));
  LineType type = line_type("rope", std::exp(in(std::log(1e5), std::log(1e10))), in(1.0, 40.0));
  SceneBuilder b;
  b.type(type);
  const int hubs = 1 + static_cast<int>(in(0.0, 5.0));
  std::vector<Vec3> at;
  for (int i = 0; i < hubs; ++i) {
    at.push_back(Vec3(in(-0.3, 0.3), in(-0.3, 0.3), in(-0.6, -0.3)) * R);
    b.free("h" + std::to_string(i), at[i], weight(in(0.0, 1.0) < 0.5 ? 0.0 : in(0.0, 2.0) * R * *type.wet_weight));
  }
  const auto join = [&](const std::string& from, const std::string& to, double distance) {
    b.line(from, to).section("rope", distance * in(0.98, 1.25), 10 + static_cast<int>(in(0.0, 20.0)));
  };
  for (int i = 0; i < hubs; ++i) {
    const double turn = in(0.0, 360.0);
    for (int k = 0; k < 2 + i % 2; ++k) {
      const std::string name = "a" + std::to_string(i) + std::to_string(k);
      const Vec3 anchor = around(R, turn + 120.0 * k + in(-20.0, 20.0), in(-0.2, 0.2) * R);
      b.fixed(name, anchor);
      join(name, "h" + std::to_string(i), (anchor - at[i]).norm());
    }
    if (i > 0) join("h" + std::to_string(i), "h" + std::to_string(i - 1), (at[i] - at[i - 1]).norm());
  }
  return b.scene;
}

TEST(Network, OfRandomLinesBalancesItsLoads) {
  std::mt19937 draw(7);
  int factorizations = 0;
  const int scenes = 100;
  for (int k = 0; k < scenes; ++k) {
    const Scene scene = random_network(draw);
    const StaticSolution s(scene);
    factorizations += s.report.iterations;
    Vec3 held = Vec3::Zero();
    double load = 0.0;
    // What Newton leaves at a node: its tolerance, or a few times what rounding of stiff lines does.
    const double left = 1e-10 * s.report.reference_force + 4.0 * s.report.roundoff_floor;
    for (const PointSpec& point : scene.points) {
      if (point.free)
        EXPECT_LT((force(s, point.name) - Vec3(0, 0, *point.body.wet_weight)).norm(), 2.0 * left) << k;
      else
        held += force(s, point.name);
      if (point.free) load += *point.body.wet_weight;
    }
    for (const Line& line : s.model->lines) load += line.length * *scene.line_types[0].wet_weight;
    EXPECT_LT((held - Vec3(0, 0, -load)).norm(), s.model->total_nodes() * left) << k;
  }
  RecordProperty("mean factorizations", factorizations / scenes);
  EXPECT_LT(factorizations, 10 * scenes);
}

TEST(Network, IsTheSameForEveryLinearSolver) {
  const Model model = build_model(small_network(4, ModelChoice::beam));
  const Assembler assembler(model);
  std::vector<State> states;
  for (const LinearSolverKind kind : all_linear_solvers()) {
    StaticOptions options;
    options.linear_solver = kind;
    const StaticReport report = solve_static(assembler, options, states.emplace_back());
    EXPECT_TRUE(report.converged) << name_of(kind) << ": " << report.failure.what << report.failure.cause;
    for (std::size_t i = 0; i < model.unknowns; ++i) EXPECT_NEAR(states.back().q[i], states.front().q[i], 1e-6) << name_of(kind);
  }
}

TEST(Network, CountsTheNegativePivotsOfItsHubs) {
  // Two struts in line, each far below its Euler load, hinged together: two directions in which the hinge gives way.
  const auto pivots = [](bool free) {
    SceneBuilder b;
    b.dry().type(line_type("strut", 1.0e6, 1.0, 1.0e5)).fixed("a", {0, 0, 0}).fixed("b", {19.98, 0, 0});
    if (free)
      b.free("hinge", {9.99, 0, 0});
    else
      b.fixed("hinge", {9.99, 0, 0});
    b.line("a", "hinge").section("strut", 10.0, 8).line("hinge", "b").section("strut", 10.0, 8);
    const Model model = build_model(b.scene);
    return negative_pivots_of_elastic_tangent(model, static_start(model, StaticStart::straight));
  };
  EXPECT_EQ(pivots(true), 2);
  EXPECT_EQ(pivots(false), 0);
}

TEST(Network, ThatNothingHoldsIsRefused) {
  SceneBuilder b;
  b.type(u40()).free("a", {0, 0, 0}).free("b", {10, 0, 0}).free("c", {20, 0, 0}).fixed("held", {0, 50, 0}).fixed("other", {20, 50, 0});
  b.line("held", "other").section("U40", 25.0, 4).line("a", "b").section("U40", 10.0, 4).line("b", "c").section("U40", 10.0, 4);
  const Model model = build_model(b.scene);
  State state;
  const StaticReport report = solve_static(Assembler(model), {}, state);
  EXPECT_FALSE(report.converged);
  EXPECT_NE(report.failure.what.find("nothing holds"), std::string::npos);
  EXPECT_NE(report.failure.cause.find("\"b\""), std::string::npos);
}

TEST(Network, NamesThePointOfAnUnknown) {
  const Model model = build_model(small_network(4, ModelChoice::cable));
  for (const Hub& hub : model.hubs)
    for (const Support& end : hub.ends)
      for (std::size_t k = 0; k < 6; ++k)
        EXPECT_EQ(meeting_point(model, model.dof(end.line, end.node) + k), k < 3 ? model.points[hub.point].name : "");
  EXPECT_EQ(meeting_point(model, model.dof(0, 2)), "");
}

TEST(BorderedSolver, SaysWhichPointNothingHolds) {
  SceneBuilder b;
  b.dry().type(line_type("wire", 1.0e6, 0.0)).fixed("a", {0, 0, 0}).fixed("b", {20, 0, 0}).free("knot", {10, 0, 0});
  b.line("a", "knot", ModelChoice::bar).section("wire", 10.0, 2).line("knot", "b", ModelChoice::bar).section("wire", 10.0, 2);
  const Model model = build_model(b.scene);
  const Assembler assembler(model);
  Tangent tangent = assembler.make_tangent();
  std::vector<double> r(model.unknowns);
  State state = static_start(model, StaticStart::straight);
  for (int line = 0; line < 2; ++line) state.q[model.dof(line, 1) + 1] = 1e-3;  // the chains themselves hold, barely
  assembler.tangent(state, {1.0, 0.0, 0.0}, {1e-3, false, false}, r, tangent);
  const auto chains = make_linear_solver(LinearSolverKind::chain);
  BorderedSolver solver(*chains);
  solver.analyze(tangent);
  EXPECT_EQ(solver.factorize(tangent).status, FactorStatus::ok);
  for (BorderEnd& end : tangent.border.ends) end.row.setZero();  // no force answers
  const FactorReport report = solver.factorize(tangent);
  EXPECT_EQ(report.status, FactorStatus::singular);
  EXPECT_EQ(report.failed_unknown, model.dof(0, 2));
  EXPECT_NE(report.message.find("nothing holds"), std::string::npos);
}

}  // namespace
}  // namespace hawser::test
