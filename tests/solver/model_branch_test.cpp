// Branches of equilibria of lines past their folds, against closed forms of a truss and of a shallow arch.
#include "solver/model_branch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "assembly/observables.hpp"
#include "solver/curve.hpp"
#include "tests/support/scene_builder.hpp"

namespace hawser::test {
namespace {

/// Two bars of length l between supports 2b apart, with a force F up on their joint. At the height h of the joint, d = sqrt(b^2 + h^2),
///   F(h) = 2 EA (h/l - h/d),     dF/dh = 0 where d^3 = b^2 l.
struct Truss {
  static constexpr double EA = 1.0e5, b = 10.0, l = 10.5;

  static double force(double h) { return 2.0 * EA * (h / l - h / std::hypot(b, h)); }
  static double fold_height() { return std::sqrt(std::pow(b * b * l, 2.0 / 3.0) - b * b); }

  static Model model(double F) {
    return build_model(SceneBuilder()
                           .dry()
                           .type(line_type("bar", EA, 0.0))
                           .fixed("a", {-b, 0, 0})
                           .fixed("b", {b, 0, 0})
                           .line("a", "b", ModelChoice::bar)
                           .section("bar", 2.0 * l, 2)
                           .load(l, hawser::test::force({0, 0, F}))
                           .scene);
  }
  static double height(const std::vector<double>& q) { return q[5]; }
};

TEST(ModelBranch, ASnappingTrussFoldsWhereItsClosedFormDoes) {
  ModelBranch branch([](double F) { return Truss::model(F); }, Truss::model(0.0), 1.0, {});
  const double top = 4.0, F0 = Truss::force(top);  // pulled up, in tension
  ContinuationOptions options;
  for (int i = -4; i <= 4; ++i) options.stops.push_back(0.25 * i * F0);
  options.target = -F0;
  options.first_step = 0.05 * F0;
  const ContinuationReport report = follow_branch(branch, F0, {-Truss::b, 0, 0, 0, 0, top, Truss::b, 0, 0}, options);
  ASSERT_EQ(report.end, ContinuationEnd::reached);
  ASSERT_EQ(report.folds, 2);
  const double slack = std::sqrt(Truss::l * Truss::l - Truss::b * Truss::b), hf = Truss::fold_height();
  const double precision = 1e-9 * 2.0 * Truss::EA * hf / Truss::l;  // residuals end below 1e-10 of the reaction
  double sign = -1.0;
  for (const BranchPoint& point : report.points) {
    const double h = Truss::height(point.q);
    EXPECT_NEAR(point.p, Truss::force(h), precision);
    if (point.kind == BranchPoint::Kind::fold) {
      EXPECT_NEAR(point.p, Truss::force(-sign * hf), precision);
      sign = -sign;
    } else if (std::abs(std::abs(h) - slack) > 1e-6) {
      // In compression the joint turns about the axis of the supports; between the folds it also falls through.
      EXPECT_EQ(point.negative_pivots, std::abs(h) > slack ? 0 : std::abs(h) > hf ? 1 : 2) << h;
    }
  }
}

/// A pipe lies as an arch on a level frictionless bed, clamped at angles +-alpha to the chord, and is pushed through by a force Q across it at
/// mid length. Its own weight keeps it down, so it can only move on the bed. Shallow theory, deflection w over the half length a = L/2, k^2 = P/EI:
///   w' = A k cos kx - B k sin kx + C,   C = -Q/2P,  A = (alpha - C)/k,  B = (A k cos ka + C)/(k sin ka),
///   int_0^L w'^2/2 = alpha^2 L/6 - P L/EA        (unstressed without Q: the chord is that of the circle through both clamps),
/// quadratic in Q for given k; a fold is an extremum of Q(k). It errs by the order of alpha^2.
struct Arch {
  static constexpr double L = 10.0, EI = 100.0, weight = 10.0, bed = 1.0e3, depth = 20.0;
  double alpha;

  double EA() const { return 60.0 * EI / std::pow(0.25 * alpha * L, 2); }

  Model model(double Q, int elements = 32) const {
    const double chord = L * std::sin(alpha) / alpha, z = -depth - weight / bed;
    SceneBuilder builder;
    builder.dry().type(line_type("pipe", EA(), weight, EI)).fixed("a", {0, 0, z}).fixed("b", {chord, 0, z}).line("a", "b");
    builder.section("pipe", L, elements).clamp_from({std::cos(alpha), std::sin(alpha), 0}).clamp_to({std::cos(alpha), -std::sin(alpha), 0});
    builder.load(0.5 * L, force({0, Q, 0}));
    builder.scene.environment.depth = depth;
    builder.scene.environment.seabed.stiffness = bed;
    return build_model(builder.scene);
  }

  /// The two Q at k, the lower one first; not a number where there are none.
  std::array<double, 2> forces(double k) const {
    const double a = 0.5 * L, P = EI * k * k;
    const auto slope = [&](double Q, double clamp, double x) {
      const double C = -Q / (2.0 * P), A = (clamp - C) / k, B = (A * k * std::cos(k * a) + C) / (k * std::sin(k * a));
      return A * k * std::cos(k * x) - B * k * std::sin(k * x) + C;
    };
    double q0 = 0.0, q1 = 0.0, q2 = 0.0;  // of q2 Q^2 + q1 Q + q0 = 0, by Simpson's rule over half of the arch
    constexpr int n = 200;
    for (int i = 0; i <= n; ++i) {
      const double weight_i = (i == 0 || i == n ? 1.0 : i % 2 == 1 ? 4.0 : 2.0) * a / (3.0 * n), x = a * i / n;
      const double of_clamp = slope(0.0, alpha, x), of_force = slope(1.0, 0.0, x);
      q0 += weight_i * of_clamp * of_clamp;
      q1 += 2.0 * weight_i * of_clamp * of_force;
      q2 += weight_i * of_force * of_force;
    }
    q0 -= alpha * alpha * L / 6.0 - P * L / EA();
    const double root = std::sqrt(q1 * q1 - 4.0 * q2 * q0);
    return {(-q1 - root) / (2.0 * q2), (-q1 + root) / (2.0 * q2)};
  }

  /// Extremum over k between 2.1 and 2.4 pi/L of the lower (0: least) or the upper (1: greatest) force.
  double fold(int which) const {
    double extreme = which == 0 ? HUGE_VAL : -HUGE_VAL;
    for (double k = 2.1; k < 2.41; k += 1e-4) {
      const double Q = forces(k * std::numbers::pi / L)[static_cast<std::size_t>(which)];
      if (std::isfinite(Q)) extreme = which == 0 ? std::min(extreme, Q) : std::max(extreme, Q);
    }
    return extreme;
  }
};

struct Snap {
  std::vector<PassedPoint> passed;
  std::vector<CurveReport> reports;
};

/// The arch is pushed through by forces Q/n, 2Q/n to Q: the values 0 to n - 1.
Snap push_through(const Arch& arch, double Q, int n) {
  CurveWay way{[&](double i) { return std::optional<Model>(arch.model(Q * (i + 1.0) / n)); }, {}};
  for (int i = 0; i < n; ++i) way.values.push_back(i);
  StaticCurve curve(way);
  Snap snap;
  for (int i = 0; i < n; ++i) {
    const Model model = *way.model_at(i);
    State state = model.make_state();
    snap.reports.push_back(curve.next(Assembler(model), i, {}, state));
    const CurveReport& report = snap.reports.back();
    snap.passed.insert(snap.passed.end(), report.passed.begin(), report.passed.end());
  }
  return snap;
}

TEST(ModelBranch, AnArchOnTheBedSnapsAtTheForcesOfShallowTheory) {
  std::array<double, 2> error{};
  for (const double alpha : {0.08, 0.04}) {
    const Arch arch{alpha};
    const double down = arch.fold(0), back = arch.fold(1), Q = 1.5 * down;
    ASSERT_LT(down, back);
    const int n = 12;
    const Snap snap = push_through(arch, Q, n);
    std::vector<double> folds;
    for (const PassedPoint& point : snap.passed)
      if (point.fold) folds.push_back(Q * (point.p + 1.0) / n);
    ASSERT_EQ(folds.size(), 2u);
    const double worst = std::max(std::abs(folds[0] / down - 1.0), std::abs(folds[1] / back - 1.0));
    EXPECT_LT(worst, 2.0 * alpha * alpha) << folds[0] << " " << down << " " << folds[1] << " " << back;
    error[alpha == 0.08 ? 0 : 1] = worst;
  }
  EXPECT_NEAR(error[0] / error[1], 4.0, 1.0);  // second order in alpha
}

TEST(StaticCurve, PassesFoldsOnOneBranchAndMarksTheUnstablePart) {
  const Arch arch{0.05};
  const double Q = 1.5 * arch.fold(0);
  const int n = 12;
  const Snap snap = push_through(arch, Q, n);
  for (const CurveReport& report : snap.reports) {
    EXPECT_TRUE(report.statics.converged);
    EXPECT_TRUE(report.statics.stable);
    EXPECT_EQ(report.branch, 1);
  }
  // At values between the two folds there are three equilibria: before the snap, the unstable one, and after it.
  int seen = 0, between = 0;
  for (const PassedPoint& point : snap.passed) {
    if (point.fold) {
      EXPECT_FALSE(point.stable);
      ++seen;
      continue;
    }
    EXPECT_EQ(point.stable, seen == 2) << point.p;
    EXPECT_EQ(point.negative_pivots, seen == 2 ? 0 : 1) << point.p;
    EXPECT_EQ(point.p, std::round(point.p));
    EXPECT_LT(point.residual, 1e-8);
    if (!point.stable) ++between;
  }
  EXPECT_EQ(seen, 2);
  EXPECT_GE(between, 1);
}

TEST(StaticCurve, FindsTheSameFoldsWhateverTheSpacingOfItsValues) {
  const Arch arch{0.05};
  const double Q = 1.5 * arch.fold(0);
  std::vector<double> first;
  for (const int n : {3, 4, 7, 13, 30}) {
    const Snap snap = push_through(arch, Q, n);
    std::vector<double> folds;
    for (const PassedPoint& point : snap.passed)
      if (point.fold) folds.push_back(Q * (point.p + 1.0) / n);
    ASSERT_EQ(folds.size(), 2u) << n;
    if (first.empty()) first = folds;
    // Residuals end below 1e-10 of the reaction of 50 N, and p is as exact as they are; ten times that.
    for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(folds[i], first[i], 5e-8) << n;
  }
}

TEST(StaticCurve, ABranchThatLeavesTheRangeEndsAndAnotherOneGoesOn) {
  // Between -1.9/2.2 and -2.5/2.2 of the snapping force only the first fold lies; the second one is out of the range.
  const Arch arch{0.05};
  const double Q = arch.fold(0);
  CurveWay way{[&](double share) { return std::optional<Model>(arch.model(share * Q)); }, {0.86, 0.9, 0.95, 1.05, 1.1}};
  StaticCurve curve(way);
  std::vector<int> branches;
  std::vector<PassedPoint> passed;
  for (const double share : way.values) {
    const Model model = arch.model(share * Q);
    State state = model.make_state();
    const CurveReport report = curve.next(Assembler(model), share, {}, state);
    EXPECT_TRUE(report.statics.stable) << share;
    branches.push_back(report.branch);
    passed.insert(passed.end(), report.passed.begin(), report.passed.end());
  }
  EXPECT_EQ(branches, (std::vector<int>{1, 1, 1, 2, 2}));
  ASSERT_EQ(passed.size(), 4u);  // the fold, and the unstable states at 0.95, 0.9 and 0.86
  EXPECT_TRUE(passed[0].fold);
  for (std::size_t i = 1; i < 4; ++i) {
    EXPECT_EQ(passed[i].p, way.values[3 - i]);
    EXPECT_FALSE(passed[i].stable);
  }
}

TEST(StaticCurve, ABranchThatEndsIsFollowedOnlyOnce) {
  // Without weight the slack thread has no shape of its own: its branch ends there.
  const auto thread = [](double weight) {
    SceneBuilder b;
    b.dry().type(line_type("thread", 1.0e6, weight)).fixed("a", {0, 0, 0}).fixed("b", {90, 0, 0}).line("a", "b").section("thread", 100.0, 20);
    return build_model(b.scene);
  };
  int asked = 0;
  const auto model_at = [&](double p) {
    ++asked;
    return p < 1.0 ? std::optional<Model>(thread(10.0 * (1.0 - p))) : std::nullopt;
  };
  StaticCurve curve({model_at, {0.0, 1.0, 2.0, 3.0}});
  State state;
  const Model hanging = thread(10.0), shapeless = thread(0.0);
  EXPECT_TRUE(curve.next(Assembler(hanging), 0.0, {}, state).statics.converged);
  const CurveReport failed = curve.next(Assembler(shapeless), 1.0, {}, state);
  EXPECT_FALSE(failed.statics.converged);
  EXPECT_EQ(failed.branch, 0);
  EXPECT_TRUE(failed.passed.empty());
  EXPECT_GT(asked, 0);
  asked = 0;
  EXPECT_FALSE(curve.next(Assembler(shapeless), 2.0, {}, state).statics.converged);
  EXPECT_EQ(asked, 0);
}

TEST(StaticCurve, WithoutTheMeansToFollowABranchItJumps) {
  const Arch arch{0.05};
  StaticCurve curve;
  State state;
  for (const double share : {0.0, 0.5, 1.5}) {
    const Model model = arch.model(share * arch.fold(0));
    const CurveReport report = curve.next(Assembler(model), share, {}, state);
    EXPECT_TRUE(report.statics.converged);
    EXPECT_TRUE(report.passed.empty());
  }
  EXPECT_LT(state.q[6 * 16 + 1], 0.0);  // through
}

}  // namespace
}  // namespace hawser::test
