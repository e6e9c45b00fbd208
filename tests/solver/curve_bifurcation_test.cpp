// Branches that lose their stability without a fold: columns whose critical loads are known.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "solver/curve.hpp"
#include "tests/support/scene_builder.hpp"

namespace hawser::test {
namespace {

constexpr double L = 10.0;

/// What a curve says of a value or of a place between two of them.
struct Row {
  double p;
  bool bifurcation, fold, stable;
  int negative_pivots, branch;  // branch 0: passed on the way
  double sideways;              // m, the largest of a node
};

std::vector<Row> curve_of(const ModelAt& model_at, const std::vector<double>& values) {
  StaticCurve curve({model_at, values});
  std::vector<Row> rows;
  for (const double p : values) {
    const Model model = *model_at(p);
    const auto sideways = [&](const State& state) {
      double largest = 0.0;
      for (int i = 0; i < model.lines[0].nodes; ++i) largest = std::max(largest, Eigen::Map<const Eigen::Vector2d>(&state.q[model.dof(0, i)]).norm());
      return largest;
    };
    State state = model.make_state();
    StaticOptions options;
    options.start = StaticStart::straight;
    const CurveReport report = curve.next(Assembler(model), p, options, state);
    EXPECT_TRUE(report.statics.converged) << p;
    for (const PassedPoint& point : report.passed)
      rows.push_back({point.p, point.bifurcation, point.fold, point.stable, point.negative_pivots, 0, sideways(point.state)});
    rows.push_back({p, false, false, report.statics.stable, report.statics.negative_pivots, report.branch, sideways(state)});
  }
  return rows;
}

/// A column of weight w per length stands on its clamped foot until w L^3/EI = 9/4 j^2, j the first zero of the Bessel function J of order -1/3
/// (Greenhill):
///   sum over k of (-1)^k (j/2)^2k / (k! Gamma(k + 2/3)) = 0.
struct StandingColumn {
  static constexpr double EI = 100.0, EA = 3.0e6;

  static double critical_weight() {
    const auto series = [](double x) {
      double sum = 0.0, term = 1.0 / std::tgamma(2.0 / 3.0);
      for (int k = 0; k < 30; ++k) {
        sum += term;
        term *= -0.25 * x * x / ((k + 1.0) * (k + 2.0 / 3.0));
      }
      return sum;
    };
    double low = 1.5, high = 2.5;
    for (int i = 0; i < 100; ++i) (series(0.5 * (low + high)) > 0.0 ? low : high) = 0.5 * (low + high);
    return 2.25 * low * low * EI / std::pow(L, 3);
  }

  static Model model(double w, int elements) {
    SceneBuilder b;
    b.dry().type(line_type("pipe", EA, w, EI)).fixed("foot", {0, 0, 0}).free("top", {0, 0, L}).line("foot", "top");
    b.section("pipe", L, elements).clamp_from({0, 0, 1});
    return build_model(b.scene);
  }
};

TEST(CurveBifurcation, AStandingColumnFallsAtGreenhillsWeight) {
  const double critical = StandingColumn::critical_weight();
  double error[2];
  for (const int elements : {8, 16}) {
    std::vector<double> values;
    for (int i = 0; i < 6; ++i) values.push_back(critical * (0.42 + 0.2 * i));
    const std::vector<Row> rows = curve_of([&](double w) { return std::optional<Model>(StandingColumn::model(w, elements)); }, values);
    ASSERT_EQ(rows.size(), 8u);  // the bifurcation, and the column that stands where it may not
    for (const Row& row : rows) {
      EXPECT_FALSE(row.fold);
      const bool stands = row.p < 0.99 * critical;
      if (row.bifurcation) {
        EXPECT_FALSE(row.stable);
        EXPECT_LT(row.sideways, 1e-6 * L);
        error[elements == 8 ? 0 : 1] = row.p / critical - 1.0;
      } else if (row.branch == 0) {
        EXPECT_FALSE(row.stable);
        EXPECT_EQ(row.negative_pivots, 2);  // to any side
        EXPECT_LT(row.sideways, 1e-6 * L);
      } else {
        EXPECT_TRUE(row.stable) << row.p;
        EXPECT_EQ(row.negative_pivots, 0);
        EXPECT_EQ(row.branch, stands ? 1 : 2) << row.p;
        EXPECT_EQ(row.sideways > 0.01 * L, !stands) << row.p;
      }
    }
    EXPECT_TRUE(rows[3].bifurcation);  // after 0.42, 0.62 and 0.82
    EXPECT_EQ(rows[4].branch, 0);
    EXPECT_EQ(rows[4].p, rows[5].p);
  }
  // The strain w L/EA of 2.6e-6 a few times over, and the mesh: sixteen times less at every halving.
  EXPECT_LT(std::abs(error[0]), 5e-5);
  EXPECT_LT(std::abs(error[1]), 1e-5);
}

/// A pinned strut pushed together by d: P = EA d/L, and with curvature per unstretched length its linear equation is EI theta'' + P (1 - P/EA) theta
/// = 0, which has a solution where P (1 - P/EA) = pi^2 EI/L^2. A clamped one carries four times the load.
struct Strut {
  static constexpr double EI = 1000.0, EA = 1.0e6;
  bool clamped;

  double critical_push() const {
    const double euler = (clamped ? 4.0 : 1.0) * std::pow(std::numbers::pi / L, 2) * EI;
    return 0.5 * (1.0 - std::sqrt(1.0 - 4.0 * euler / EA)) * L;
  }

  Model model(double push) const {
    SceneBuilder b;
    b.dry().type(line_type("rod", EA, 1.0e-3, EI)).fixed("foot", {0, 0, 0}).fixed("top", {0, 0, L - push}).line("foot", "top");
    b.section("rod", L, 16);
    if (clamped) b.clamp_from({0, 0, 1}).clamp_to({0, 0, 1});
    return build_model(b.scene);
  }
};

class PushedStrut : public ::testing::TestWithParam<bool> {};

TEST_P(PushedStrut, BucklesAtItsEulerLoadWhateverTheSpacingOfTheValues) {
  const Strut strut{GetParam()};
  const double critical = strut.critical_push();
  for (const int n : {3, 4, 9}) {
    std::vector<double> values;
    for (int i = 0; i < n; ++i) values.push_back(critical * (0.3 + 1.25 * i / (n - 1.0)));
    double found = 0.0;
    for (const Row& row : curve_of([&](double push) { return std::optional<Model>(strut.model(push)); }, values)) {
      if (row.bifurcation) found = row.p;
      if (row.branch == 0) {
        EXPECT_FALSE(row.stable);
        continue;
      }
      EXPECT_TRUE(row.stable) << row.p / critical;
      EXPECT_EQ(row.branch, row.p < critical ? 1 : 2) << row.p / critical;
      EXPECT_EQ(row.sideways > 1e-4 * L, row.p > critical) << row.p / critical;
    }
    // 16 elements: (pi/16)^4/720 = 2e-6 for one half wave; twice as long waves, sixteen times that.
    EXPECT_NEAR(found / critical, 1.0, strut.clamped ? 3.2e-5 : 2e-6) << n;
  }
}

TEST_P(PushedStrut, StraightensAgainWhereItBuckled) {
  const Strut strut{GetParam()};
  const double critical = strut.critical_push();
  std::vector<double> values;
  for (int i = 0; i < 7; ++i) values.push_back(critical * (1.5 - 0.16 * i));
  for (const Row& row : curve_of([&](double push) { return std::optional<Model>(strut.model(push)); }, values)) {
    EXPECT_TRUE(row.stable) << row.p / critical;
    EXPECT_EQ(row.branch, row.p > critical ? 1 : 2) << row.p / critical;
    EXPECT_EQ(row.sideways > 1e-4 * L, row.p > critical) << row.p / critical;
  }
}

INSTANTIATE_TEST_SUITE_P(Ends, PushedStrut, ::testing::Bool(), [](const auto& test) { return test.param ? "clamped" : "pinned"; });

TEST(CurveBifurcation, WhatStaticsTakesForNeutralIsNotMarkedStable) {
  // A thousandth above Greenhill's weight the column gives way by less than a hundredth of a pendulum's stiffness.
  const double critical = StandingColumn::critical_weight();
  const ModelAt model_at = [](double w) { return std::optional<Model>(StandingColumn::model(w, 16)); };
  {
    const Model model = *model_at(1.001 * critical);
    State state = model.make_state();
    StaticOptions options;
    options.start = StaticStart::straight;
    ASSERT_TRUE(solve_static(Assembler(model), options, state).stable);
  }
  const std::vector<Row> rows = curve_of(model_at, {0.95 * critical, 0.98 * critical, 1.001 * critical, 1.04 * critical});
  ASSERT_EQ(rows.size(), 6u);
  EXPECT_TRUE(rows[0].stable && rows[1].stable);
  EXPECT_TRUE(rows[2].bifurcation);
  EXPECT_NEAR(rows[2].p / critical, 1.0, 1e-5);  // as above
  EXPECT_EQ(rows[3].p, rows[4].p);
  EXPECT_FALSE(rows[3].stable);  // upright at 1.001
  EXPECT_EQ(rows[3].negative_pivots, 2);
  for (const Row& row : {rows[4], rows[5]}) {
    EXPECT_TRUE(row.stable) << row.p;
    EXPECT_EQ(row.branch, 2) << row.p;
    EXPECT_GT(row.sideways, 0.01 * L) << row.p;
  }
}

}  // namespace
}  // namespace hawser::test
