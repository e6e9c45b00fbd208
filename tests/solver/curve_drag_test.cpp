// Folds that drag alone makes: it has no potential, and the elastic tangent does not see them.
#include <gtest/gtest.h>

#include <cmath>

#include "assembly/observables.hpp"
#include "solver/curve.hpp"
#include "solver/norms.hpp"
#include "solver/static_perturbation.hpp"
#include "tests/support/scene_builder.hpp"

namespace hawser::test {
namespace {

constexpr double depth = 100.0, slow = 0.4, fast = 2.4;  // m, m/s at the surface and at the bottom

/// A buoy of lift B on a wire without weight and drag in a current that is faster below: where it is blown down, the flow is stronger. At the height
/// h of the buoy over the anchor, with the wire at the angle a to the vertical,
///   h = l cos a,   l = l0 (1 + T/EA),   T = B/cos a,   tan a = k A u(h)^2/B,   k = rho/2,  u(h) = fast - (fast - slow) h/depth,
/// which gives the drag area A for every a. Between its two extrema there are three equilibria, of which the middle one is unstable.
struct BlownBuoy {
  static constexpr double lift = 1.0e4, EA = 1.0e8, l0 = 100.0, rho = 1000.0;

  static double area(double c) {
    const double h = l0 * (1.0 + lift / (c * EA)) * c, u = fast - (fast - slow) * h / depth;
    return std::sqrt(1.0 - c * c) / c * lift / (0.5 * rho * u * u);
  }

  /// The extremum of the area between two cosines; sign 1: greatest.
  static double fold(double low, double high, double sign) {
    const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
    for (int i = 0; i < 100; ++i) {
      const double a = high - golden * (high - low), b = low + golden * (high - low);
      (sign * area(a) > sign * area(b) ? high : low) = sign * area(a) > sign * area(b) ? b : a;
    }
    return area(0.5 * (low + high));
  }

  static Model model(double area) {
    LineType wire = line_type("wire", EA, 0.0);
    wire.diameter = wire.mass = 0.0;
    BodySpec buoy = weight(-lift);
    buoy.drag_area = area;
    SceneBuilder b;
    b.scene.environment.water_density = rho;
    b.type(wire).current(0.0, {slow, 0, 0}).current(-depth, {fast, 0, 0}).fixed("anchor", {0, 0, -depth}).free("buoy", {10, 0, 0}, buoy);
    b.line("anchor", "buoy").section("wire", l0, 1);
    return build_model(b.scene);
  }
};

/// The same with a cable that weighs and drags, of several elements.
Model blown_cable(double area) {
  LineType cable = u40();
  cable.diameter = 0.02;
  cable.mass = 1.0;
  BodySpec buoy = weight(-1.0e4);
  buoy.drag_area = area;
  SceneBuilder b;
  b.type(cable).current(0.0, {slow, 0, 0}).current(-depth, {fast, 0, 0}).fixed("anchor", {0, 0, -depth}).free("buoy", {10, 0, 0}, buoy);
  b.line("anchor", "buoy").section("U40", 100.0, 12);
  return build_model(b.scene);
}

/// A pipe lies as an arch on the frictionless bed, clamped at angles of 0.05 to its chord, and a current pushes it through.
Model arch_in_current(double speed) {
  constexpr double L = 10.0, angle = 0.05;
  LineType pipe = line_type("pipe", 3.84e5, 10.0, 100.0);
  pipe.diameter = 0.05;
  pipe.drag_normal = 1.2;
  SceneBuilder b;
  b.type(pipe).current(0.0, {0, -speed, 0}).fixed("a", {0, 0, -20.01}).fixed("b", {L * std::sin(angle) / angle, 0, -20.01}).line("a", "b");
  b.section("pipe", L, 16).clamp_from({std::cos(angle), std::sin(angle), 0}).clamp_to({std::cos(angle), -std::sin(angle), 0});
  b.scene.environment.depth = 20.0;
  b.scene.environment.seabed.stiffness = 1.0e3;
  return build_model(b.scene);
}

struct Passing {
  std::vector<PassedPoint> passed;
  std::vector<CurveReport> reports;
  std::vector<double> folds;
};

Passing pass(const ModelAt& model_at, const std::vector<double>& values) {
  StaticCurve curve({model_at, values});
  Passing passing;
  for (const double p : values) {
    const Model model = *model_at(p);
    State state = model.make_state();
    passing.reports.push_back(curve.next(Assembler(model), p, {}, state));
    for (const PassedPoint& point : passing.reports.back().passed) {
      passing.passed.push_back(point);
      if (point.fold) passing.folds.push_back(point.p);
    }
  }
  return passing;
}

std::vector<double> even(double from, double to, int n) {
  std::vector<double> values;
  for (int i = 0; i < n; ++i) values.push_back(from + (to - from) * i / (n - 1.0));
  return values;
}

/// Every value is stable and on one branch, and so are the parts before the first and behind the second fold; the part between is not, where the
/// elastic tangent has so many negative pivots.
void expect_snap(const Passing& passing, int elastic_pivots) {
  for (const CurveReport& report : passing.reports) {
    EXPECT_TRUE(report.statics.converged && report.statics.stable);
    EXPECT_EQ(report.branch, 1);
  }
  int folds = 0, between = 0, behind = 0;
  for (const PassedPoint& point : passing.passed) {
    EXPECT_FALSE(point.bifurcation);
    folds += point.fold;
    if (point.fold) continue;
    EXPECT_EQ(point.negative_pivots, folds == 1 ? elastic_pivots : 0) << point.p;
    EXPECT_EQ(point.stable, folds == 2) << point.p;
    ++(folds == 1 ? between : behind);
  }
  EXPECT_EQ(folds, 2);
  EXPECT_GT(between, 1);
  EXPECT_GT(behind, 0);
}

TEST(CurveDrag, ABuoyIsBlownDownAndComesUpWhereItsClosedFormFolds) {
  const double up = BlownBuoy::fold(0.72, 1.0, 1.0), down = BlownBuoy::fold(0.2, 0.7, -1.0);
  ASSERT_LT(1.2 * down, up);
  const ModelAt model_at = [](double area) { return std::optional<Model>(BlownBuoy::model(area)); };
  for (const auto& values : {even(0.8 * down, 1.15 * up, 9), even(1.15 * up, 0.8 * down, 6)}) {
    const Passing passing = pass(model_at, values);
    expect_snap(passing, 0);
    ASSERT_EQ(passing.folds.size(), 2u);
    const bool rising = values.back() > values.front();
    // Residuals end below 1e-10 of the reaction of 1e4 to 5e4 N, and the area is as exact as they are.
    EXPECT_NEAR(passing.folds[0] / (rising ? up : down), 1.0, 1e-8);
    EXPECT_NEAR(passing.folds[1] / (rising ? down : up), 1.0, 1e-8);
  }
}

/// Statics alone, from the equilibrium before and by halves where that does not lead to a near one: the last p before the line jumps. `near` [m]:
/// how far a node may move in a step.
double brute_force_fold(const ModelAt& model_at, double p, double end, double near) {
  State state = model_at(p)->make_state();
  EXPECT_TRUE(solve_static(Assembler(*model_at(p)), {}, state).converged);
  for (double step = 0.02 * (end - p); std::abs(step) > 1e-6 * std::abs(p);) {
    const Model model = *model_at(p + step);
    State next = state;
    StaticOptions options;
    options.start = StaticStart::given;
    options.max_iterations = 15;
    const double moved = solve_static(Assembler(model), options, next).converged ? distance(model, next, state) * longest_line(model) : 0.0;
    if (moved > 0.0 && moved < near) {
      p += step;
      state = std::move(next);
    } else {
      step *= 0.5;
    }
  }
  return p;
}

// Brute force steps to 1e-6 of where it ends; next to a fold it loses the branch where a step of Newton leads off, which is nearer than 1e-4.
constexpr double brute_force = 1e-4;

void expect_snap_as_statics(const ModelAt& model_at, double low, double high, double near, int elastic_pivots) {
  const Passing passing = pass(model_at, even(low, high, 15));
  expect_snap(passing, elastic_pivots);
  ASSERT_EQ(passing.folds.size(), 2u);
  EXPECT_NEAR(brute_force_fold(model_at, low, high, near) / passing.folds[0], 1.0, brute_force);
  EXPECT_NEAR(brute_force_fold(model_at, high, low, near) / passing.folds[1], 1.0, brute_force);
}

TEST(CurveDrag, ACableWithABuoySnapsWhereStaticsFromBothSidesDoes) {
  expect_snap_as_statics([](double area) { return std::optional<Model>(blown_cable(area)); }, 6.0, 34.0, 5.0, 0);
}

TEST(CurveDrag, ACurrentPushesAnArchThroughWhereStaticsFromBothSidesDoes) {
  expect_snap_as_statics([](double speed) { return std::optional<Model>(arch_in_current(speed)); }, 0.04, 0.18, 0.03, 1);
}

}  // namespace
}  // namespace hawser::test
