// Orders of convergence in the element length l, measured against solutions that do not come from this solver.
// Asked: positions 4 for cable and beam, 2 for bar; end force at least 4 for cable and beam, 2 for bar (theory 3.4).
//
// The order is log2 of the ratio of errors at n and 2n. Errors are measured where they are at least 100 times what rounding
// leaves, so that rounding moves an order by less than log2(1.02) = 0.03; the next term of the error makes the rest of the
// allowance of 0.25.
#include <gtest/gtest.h>

#include <cmath>

#include "solver/static_start_catenary.hpp"
#include "tests/support/reference_case.hpp"
#include "tests/support/scene_builder.hpp"
#include "tests/support/static_solution.hpp"

namespace hawser::test {
namespace {

struct Errors {
  double position, force;
};

/// A catenary of U40 over 300 m with a sag of about a third: bends well within 20 elements.
Errors catenary_errors(ModelChoice family, int n) {
  const double L = 400.0, EA = 4.0e6, w = 11.885;
  const Vec3 from(0, 0, 0), to(300, 0, 40);
  const StaticSolution s(
      SceneBuilder().dry().type(line_type("line", EA, w)).fixed("a", from).fixed("b", to).line("a", "b", family).section("line", L, n).scene);
  const CatenarySegment segment{L, EA, {0, 0, -w}, Vec3::Zero()};
  const Vec3 F = solve_end_force({segment}, to - from).force;
  Errors e{0.0, (s.line.force_from - F).norm()};
  for (int i = 0; i <= 10; ++i) {
    const double at = 0.1 * i * L;
    e.position = std::max(e.position, (s.station(at).position - from - catenary_span(segment, F, at)).norm());
  }
  return e;
}

TEST(StaticOrders, CableConvergesWithOrderFourInPositionAndAtLeastFourInEndForce) {
  for (const int n : {20, 40}) {
    const Errors coarse = catenary_errors(ModelChoice::cable, n), fine = catenary_errors(ModelChoice::cable, 2 * n);
    EXPECT_NEAR(std::log2(coarse.position / fine.position), 4.0, 0.25) << n;
    EXPECT_GT(std::log2(coarse.force / fine.force), 3.75) << n;
  }
}

TEST(StaticOrders, BarConvergesWithOrderTwo) {
  for (const int n : {20, 40, 80}) {
    const Errors coarse = catenary_errors(ModelChoice::bar, n), fine = catenary_errors(ModelChoice::bar, 2 * n);
    EXPECT_NEAR(std::log2(coarse.position / fine.position), 2.0, 0.25) << n;
    EXPECT_NEAR(std::log2(coarse.force / fine.force), 2.0, 0.25) << n;
  }
}

/// Cantilever under a tip force, extensible: tip position and clamp moment (the end force is the load and exact).
Errors cantilever_errors(int n) {
  const ReferenceCase reference("static_elastica_extensible_tipforce");
  const std::vector<double> row = reference.value<Table>("table")[7];  // P = 5, EA = 1e4
  SceneBuilder b;
  b.dry().type(line_type("beam", row[1], 0.0, 1.0)).fixed("clamp", {0, 0, 0}).free("tip", {1, 0, 0}, force({0, 0, -row[0]}));
  b.line("clamp", "tip", ModelChoice::beam).section("beam", 1.0, n).clamp_from({1, 0, 0});
  const StaticSolution s(b.scene, StaticStart::straight);
  return {(s.station(1.0).position - Vec3(row[3], 0, -row[4])).norm(), std::abs(s.line.moment_from.norm() - row[0] * row[3])};
}

TEST(StaticOrders, BeamConvergesWithOrderFourInPosition) {
  for (const int n : {8, 16}) {
    const Errors coarse = cantilever_errors(n), fine = cantilever_errors(2 * n);
    EXPECT_NEAR(std::log2(coarse.position / fine.position), 4.0, 0.25) << n;
    EXPECT_GT(std::log2(coarse.force / fine.force), 3.75) << n;  // clamp moment: the moment of the load about the clamp
  }
}

/// Clamped stiff catenary: the end force against its own limit, since the reference is inextensible.
double stiff_end_force(int n) {
  SceneBuilder b;
  b.dry().type(line_type("beam", 1.0e6, 50.0, 5.0e4)).fixed("a", {0, 0, 0}).fixed("b", {50, 0, 10}).line("a", "b", ModelChoice::beam);
  b.section("beam", 60.0, n).clamp_from({1, 0, 0}).clamp_to({1, 0, 0});
  return StaticSolution(b.scene).line.tension_to;
}

TEST(StaticOrders, EndForceOfAClampedBeamConvergesWithAtLeastOrderFour) {
  // Three meshes: |f(2n) - f(n)| / |f(4n) - f(2n)| = 2^order.
  const double f[] = {stiff_end_force(20), stiff_end_force(40), stiff_end_force(80), stiff_end_force(160)};
  for (int i = 0; i < 2; ++i) EXPECT_GT(std::log2(std::abs((f[i + 1] - f[i]) / (f[i + 2] - f[i + 1]))), 3.75) << i;
}

/// Towed cable with drag in a sheared current, a clump on the way: errors against a mesh of 1280 elements.
TEST(StaticOrders, DragAndClumpsKeepOrderFour) {
  const auto solve = [](int n) {
    BodySpec fish = weight(3000.0);
    fish.drag_area = 0.5;
    SceneBuilder b;
    b.type(u40()).current(0.0, {0.2, 0.4, 0}).current(-3000.0, {-0.2, 0.1, 0}).towed("ship", {0, 0, 0}, {1.0, 0, 0});
    b.free("fish", {-500, 0, -800}, fish).line("ship", "fish").section("U40", 1000.0, n).load(500.0, weight(2000.0));
    return StaticSolution(b.scene);
  };
  const StaticSolution exact = solve(1280);
  const auto error = [&](int n) {
    const StaticSolution s = solve(n);
    double position = 0.0;
    for (int i = 1; i <= 10; ++i) position = std::max(position, (s.station(100.0 * i).position - exact.station(100.0 * i).position).norm());
    return Errors{position, std::abs(s.line.tension_from - exact.line.tension_from)};
  };
  const Errors coarse = error(20), fine = error(40);
  EXPECT_NEAR(std::log2(coarse.position / fine.position), 4.0, 0.25);
  EXPECT_GT(std::log2(coarse.force / fine.force), 3.75);
}

}  // namespace
}  // namespace hawser::test
