// The error estimate of a static answer against errors that are known.
#include <algorithm>
#include <cmath>
#include <utility>

#include "solver/static_start_catenary.hpp"
#include "tests/support/deep_span.hpp"
#include "tests/support/reference_case.hpp"
#include "tests/support/static_solution.hpp"

namespace hawser::test {
namespace {

double estimate_of(const Scene& scene, const StaticSolution& s) {
  return estimate_static_error(scene, {}, *s.model, s.state, s.report.residual_force)[0];
}

/// Of the end tensions, relative to the greater one.
double error_of(const LineResult& line, double tension_from, double tension_to) {
  return std::max(std::abs(line.tension_from - tension_from), std::abs(line.tension_to - tension_to)) / std::max(tension_from, tension_to);
}

/// A span in still water whose end forces are known in closed form (static_start_catenary.hpp).
struct Span {
  double EA, w, L;
  Vec3 chord;
  int elements;

  Scene scene() const {
    SceneBuilder builder;
    builder.dry().type(line_type("cable", EA, w)).fixed("from", {0, 0, -100}).fixed("to", Vec3(0, 0, -100) + chord).line("from", "to");
    return builder.section("cable", L, elements).scene;
  }
  double error(const LineResult& line) const {
    const Vec3 load(0, 0, -w), from = solve_end_force({{L, EA, load}}, chord).force;
    return error_of(line, from.norm(), (from - load * L).norm());
  }
};

/// The deep span of scene S1: estimated and true error.
std::pair<double, double> estimate_and_error(ModelChoice choice, int elements) {
  const ReferenceCase reference("static_catenary_deep5000_sceneS1");
  Scene scene = deep(elements).scene;
  scene.lines[0].model = choice;
  const StaticSolution s(scene);
  return {estimate_of(scene, s), error_of(s.line, reference.value("T_end_s0"), reference.value("T_end_sL0"))};
}

TEST(StaticError, TheEstimateIsTheErrorWithinAFactorOfThreeOnASmoothLine) {
  for (const auto& [choice, elements] : {std::pair{ModelChoice::cable, 40}, std::pair{ModelChoice::bar, 40}, std::pair{ModelChoice::bar, 20}}) {
    const auto [estimate, error] = estimate_and_error(choice, elements);
    EXPECT_LT(estimate, 3.0 * error);
    EXPECT_GT(estimate, error / 3.0);
  }
}

// A quarter of 20 elements shows less than the order of the cable; the estimate is 4.3 times the error.
TEST(StaticError, WhereAQuarterOfTheMeshIsTooCoarseForTheOrderTheEstimateErrsOnTheSafeSide) {
  const auto [estimate, error] = estimate_and_error(ModelChoice::cable, 20);
  EXPECT_GT(estimate, error);
  EXPECT_LT(estimate, 5.0 * error);
}

TEST(StaticError, OneElementCannotBeHalvedAndHasNoEstimate) {
  const Scene scene = deep(1).scene;
  EXPECT_TRUE(std::isnan(estimate_of(scene, StaticSolution(scene))));
}

// An element of 0.1 m keeps its strain to 1e-13, which is a part of 1e-5 of its tension here; the mesh alone would promise 3e-7.
TEST(StaticError, WhatRoundingLeavesOfAStiffShortLineIsInTheEstimate) {
  for (const Span& span : {Span{2.58e10, 15.0, 43.904, {24.545, 0, 4.824}, 400}, Span{6.92e9, 1.04, 12.33, {9.0, 0, 4.0}, 100},
                           Span{1.39e9, 61.5, 13.0494, {2.0, 0, -11.0}, 100}}) {
    const StaticSolution s(span.scene());
    EXPECT_LT(span.error(s.line), 1.5 * estimate_of(span.scene(), s)) << span.L;
    EXPECT_LT(estimate_of(span.scene(), s), 1e-3) << span.L;
  }
}

// The lowest bend of these lines is shorter than an element: halving the mesh does not divide the error by 16.
TEST(StaticError, OnElementsLongerThanTheSharpestBendTheEstimateIsOfTheSizeOfTheError) {
  const Span span{1.05e6, 4.7, 160.1, {20.0, 0, 30.0}, 20};
  for (const int elements : {5, 10, 20, 40, 80}) {
    Span meshed = span;
    meshed.elements = elements;
    const StaticSolution s(meshed.scene());
    EXPECT_LT(meshed.error(s.line), 2.0 * estimate_of(meshed.scene(), s)) << elements;
  }
}

// A chain that lies on the bed for the most part. Its touchdown moves through the elements as they are halved: errors fall by about 4 each
// time, not by 16, and scatter from mesh to mesh (5e-6 on 100 elements, 4e-5 on 80). Three times the estimate is the worst of these meshes.
TEST(StaticError, WithATouchdownTheErrorIsLessThanFourTimesTheEstimate) {
  const auto chain = [](int elements) {
    SceneBuilder builder;
    builder.dry().type(line_type("chain", 4.93e8, 1090.0)).fixed("anchor", {420, 0, -120}).fixed("top", {0, 0, -40}).line("anchor", "top");
    builder.scene.environment.depth = 120.0;
    builder.scene.environment.seabed.stiffness = 80e3;
    return builder.section("chain", 450.0, elements).scene;
  };
  const LineResult exact = StaticSolution(chain(1440)).line;
  for (const int elements : {40, 50, 60, 80, 100, 120, 160}) {
    const StaticSolution s(chain(elements));
    const double error = error_of(s.line, exact.tension_from, exact.tension_to);
    EXPECT_LT(error, 4.0 * estimate_of(chain(elements), s)) << elements;
  }
}

}  // namespace
}  // namespace hawser::test
