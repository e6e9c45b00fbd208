// Continuation on small problems whose branches and folds are known exactly.
#include "solver/continuation.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <functional>

#include "solver/linear/dense_spectrum.hpp"

namespace hawser {
namespace {

using Vector = Eigen::Vector2d;
using Matrix = Eigen::Matrix2d;

/// R(x, y, p) in two unknowns with its derivatives.
struct Problem {
  std::function<Vector(const Vector&, double)> residual;
  std::function<Matrix(const Vector&, double)> tangent;
  std::function<Vector(const Vector&, double)> by_p;
};

class SmallBranch : public BranchSystem {
 public:
  explicit SmallBranch(Problem problem) : problem_(std::move(problem)) {}

  bool move_to(double p, std::vector<double>&) override {
    p_ = p;
    return p <= end_of_problem;
  }
  BranchResidual residual(std::span<const double> q) override { return {problem_.residual(at(q), p_).norm(), 1e-13, 1e-15, 1.0}; }
  bool respond(std::span<const double> q, std::size_t spring, BranchResponse& response) override {
    Matrix stiff = problem_.tangent(at(q), p_);
    Vector pull = Vector::Zero();
    if (spring != no_spring) {
      const auto j = static_cast<Eigen::Index>(spring);
      pull[j] = std::copysign(std::max(1.0, std::abs(stiff(j, j))), stiff(j, j));
      stiff(j, j) += pull[j];
    }
    const Eigen::PartialPivLU<Matrix> factors(stiff);
    ++factorizations;
    const auto solved = [&](const Vector& right) {
      const Vector x = factors.solve(right);
      return std::vector<double>{x[0], x[1]};
    };
    response = {solved(-problem_.residual(at(q), p_)), solved(-problem_.by_p(at(q), p_)), solved(pull), {0.0, 0.0}};
    return std::isfinite(response.parameter[0]);
  }
  int negative_pivots(std::span<const double> q) override {
    return static_cast<int>((eigenvalues(problem_.tangent(at(q), p_)).real().array() < 0.0).count());
  }
  double product(std::span<const double> a, std::span<const double> b) const override { return a[0] * b[0] + a[1] * b[1]; }
  std::size_t strongest(std::span<const double> motion) const override { return std::abs(motion[0]) >= std::abs(motion[1]) ? 0 : 1; }

  double end_of_problem = HUGE_VAL;
  int factorizations = 0;

 private:
  static Vector at(std::span<const double> q) { return {q[0], q[1]}; }

  Problem problem_;
  double p_ = 0.0;
};

/// p = x^3 - 3x with y = x^2: folds at x = -1 (p = 2) and x = 1 (p = -2); the tangent is singular there.
Problem cubic() {
  return {[](const Vector& q, double p) { return Vector(q[0] * q[0] * q[0] - 3.0 * q[0] - p, q[1] - q[0] * q[0]); },
          [](const Vector& q, double) {
            return Matrix{{3.0 * q[0] * q[0] - 3.0, 0.0}, {-2.0 * q[0], 1.0}};
          },
          [](const Vector&, double) { return Vector(-1.0, 0.0); }};
}

ContinuationOptions from_minus_to_plus_three() {
  ContinuationOptions options;
  options.stops = {-3.0, -1.0, 0.0, 1.0, 2.5, 3.0};
  options.target = 2.5;
  options.first_step = 0.25;
  return options;
}

std::vector<BranchPoint> of_kind(const ContinuationReport& report, BranchPoint::Kind kind) {
  std::vector<BranchPoint> points;
  for (const BranchPoint& point : report.points)
    if (point.kind == kind) points.push_back(point);
  return points;
}

// Residuals end below 1e-13, and p is then exact to that; x of a fold, where p ~ 3 (x - 1)^2, to the rate asked for: 1e-7 of the first one, p'/6 at
// most.
constexpr double exact = 1e-12, place_of_fold = 1e-6;

TEST(Continuation, PassesBothFoldsOfACubicAndReachesItsTarget) {
  SmallBranch branch(cubic());
  const ContinuationReport report = follow_branch(branch, -3.0, {-2.1038034027355366, 4.4259887573616}, from_minus_to_plus_three());
  ASSERT_EQ(report.end, ContinuationEnd::reached);
  const std::vector<BranchPoint> folds = of_kind(report, BranchPoint::Kind::fold);
  ASSERT_EQ(folds.size(), 2u);
  EXPECT_EQ(report.folds, 2);
  EXPECT_NEAR(folds[0].p, 2.0, exact);
  EXPECT_NEAR(folds[0].q[0], -1.0, place_of_fold);
  EXPECT_NEAR(folds[1].p, -2.0, exact);
  EXPECT_NEAR(folds[1].q[0], 1.0, place_of_fold);
  EXPECT_EQ(branch.factorizations, report.factorizations);
  int counted = 0;
  for (const BranchPoint& point : report.points) counted += point.factorizations;
  EXPECT_EQ(counted, report.factorizations);
}

TEST(Continuation, StopsLieOnEveryPartOfTheBranchInTheirOrder) {
  SmallBranch branch(cubic());
  const ContinuationReport report = follow_branch(branch, -3.0, {-2.1038034027355366, 4.4259887573616}, from_minus_to_plus_three());
  const std::vector<BranchPoint> stops = of_kind(report, BranchPoint::Kind::stop);
  const std::vector<double> expected{-1.0, 0.0, 1.0, 1.0, 0.0, -1.0, -1.0, 0.0, 1.0, 2.5};
  ASSERT_EQ(stops.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(stops[i].p, expected[i]) << i;
    const double x = stops[i].q[0];
    EXPECT_NEAR(x * x * x - 3.0 * x, expected[i], exact) << i;
    if (i > 0) {
      EXPECT_GT(x, stops[i - 1].q[0]) << i;
    }
  }
}

TEST(Continuation, EveryPointSaysHowManyDirectionsAreUnstable) {
  SmallBranch branch(cubic());
  const ContinuationReport report = follow_branch(branch, -3.0, {-2.1038034027355366, 4.4259887573616}, from_minus_to_plus_three());
  ASSERT_GT(of_kind(report, BranchPoint::Kind::step).size(), 5u);
  for (const BranchPoint& point : report.points) {
    if (point.kind == BranchPoint::Kind::fold) continue;
    EXPECT_EQ(point.negative_pivots, std::abs(point.q[0]) < 1.0 ? 1 : 0) << point.q[0];
    EXPECT_EQ(std::signbit(point.p_rate), std::abs(point.q[0]) < 1.0) << point.q[0];
  }
}

TEST(Continuation, TheCorrectorConvergesAtAFoldAsFastAsElsewhere) {
  // The circle x^2 + p^2 = 1 is followed from p = 0 to its fold at p = 1; corrections there are as few as on the way.
  SmallBranch branch({[](const Vector& q, double p) { return Vector(q[0] * q[0] + p * p - 1.0, q[1] - p); },
                      [](const Vector& q, double) {
                        return Matrix{{2.0 * q[0], 0.0}, {0.0, 1.0}};
                      },
                      [](const Vector&, double p) { return Vector(2.0 * p, -1.0); }});
  ContinuationOptions options;
  options.stops = {-0.5, 2.0};
  options.target = 2.0;
  options.first_step = 0.1;
  const ContinuationReport report = follow_branch(branch, 0.0, {1.0, 0.0}, options);
  EXPECT_EQ(report.end, ContinuationEnd::left_range);
  const std::vector<BranchPoint> folds = of_kind(report, BranchPoint::Kind::fold);
  ASSERT_EQ(folds.size(), 1u);
  EXPECT_NEAR(folds[0].p, 1.0, exact);
  EXPECT_NEAR(folds[0].q[0], 0.0, place_of_fold);
  // Hermite interpolation gains two orders a point, and a point takes three corrections and a tangent.
  EXPECT_LE(folds[0].factorizations, 4 * 6);
}

TEST(Continuation, FindsWhereABranchLosesAndRegainsStabilityWithoutFold) {
  // x = p, y = 0, whose stiffness along y is (p - 1/3)(p - 4/3): pitchforks at 1/3 and 4/3.
  const auto stiffness = [](double p) { return (p - 1.0 / 3.0) * (p - 4.0 / 3.0); };
  const Problem pitchforks{[=](const Vector& q, double p) { return Vector(q[0] - p, stiffness(p) * q[1] + std::pow(q[1], 3)); },
                           [=](const Vector& q, double p) {
                             return Matrix{{1.0, 0.0}, {0.0, stiffness(p) + 3.0 * q[1] * q[1]}};
                           },
                           [](const Vector& q, double p) { return Vector(-1.0, (2.0 * p - 5.0 / 3.0) * q[1]); }};
  SmallBranch branch(pitchforks);
  ContinuationOptions options;
  options.stops = {0.0, 1.0, 2.0};
  options.target = 2.0;
  options.first_step = 0.25;
  const ContinuationReport report = follow_branch(branch, 0.0, {0.0, 0.0}, options);
  ASSERT_EQ(report.end, ContinuationEnd::reached);
  EXPECT_EQ(report.folds, 0);
  ASSERT_EQ(report.bifurcations, 2);
  const std::vector<BranchPoint> found = of_kind(report, BranchPoint::Kind::bifurcation), stops = of_kind(report, BranchPoint::Kind::stop);
  EXPECT_NEAR(found[0].p, 1.0 / 3.0, 2e-7);  // to 1e-7 of a step, which is not longer than the way
  EXPECT_NEAR(found[1].p, 4.0 / 3.0, 2e-7);
  ASSERT_EQ(stops.size(), 2u);
  EXPECT_EQ(stops[0].negative_pivots, 1);
  EXPECT_EQ(stops[1].negative_pivots, 0);
  // The branch that crosses: y^2 = -(p - 1/3)(p - 4/3).
  int factorizations = 0;
  const std::optional<BranchPoint> other = cross_branch(branch, found[0], std::vector<double>{0.0, -3.0}, 0.2, factorizations);
  ASSERT_TRUE(other.has_value());
  EXPECT_NEAR(other->q[1], -0.2, exact);
  EXPECT_NEAR(other->p, (5.0 - std::sqrt(9.0 - 36.0 * 0.04)) / 6.0, 1e-11);  // residuals end below 1e-13, times 1/(0.2 * 0.92)
  EXPECT_GT(factorizations, 0);
  options.folds_change_stability = false;  // what the pivots say is not what decides
  EXPECT_EQ(follow_branch(branch, 0.0, {0.0, 0.0}, options).bifurcations, 0);
}

TEST(Continuation, SaysThatABranchCannotBeFollowedWhereTheProblemEnds) {
  SmallBranch branch(cubic());
  branch.end_of_problem = 0.5;
  const ContinuationReport report = follow_branch(branch, -3.0, {-2.1038034027355366, 4.4259887573616}, from_minus_to_plus_three());
  EXPECT_EQ(report.end, ContinuationEnd::stuck);
  EXPECT_EQ(report.folds, 0);
  ASSERT_FALSE(report.points.empty());
  EXPECT_LE(report.points.back().p, 0.5);
  EXPECT_GT(report.points.back().p, 0.4);
}

TEST(Continuation, ABranchWithoutFoldIsFollowedToItsTarget) {
  SmallBranch branch({[](const Vector& q, double p) { return Vector(q[0] + q[0] * q[0] * q[0] - p, q[1]); },
                      [](const Vector& q, double) {
                        return Matrix{{1.0 + 3.0 * q[0] * q[0], 0.0}, {0.0, 1.0}};
                      },
                      [](const Vector&, double) { return Vector(-1.0, 0.0); }});
  ContinuationOptions options;
  options.stops = {0.0, 10.0};
  options.target = 10.0;
  const ContinuationReport report = follow_branch(branch, 0.0, {0.0, 0.0}, options);
  ASSERT_EQ(report.end, ContinuationEnd::reached);
  EXPECT_EQ(report.folds, 0);
  EXPECT_NEAR(report.points.back().q[0], 2.0, exact);
  // Downwards as well.
  options.target = 0.0;
  const ContinuationReport back = follow_branch(branch, 10.0, {2.0, 0.0}, options);
  ASSERT_EQ(back.end, ContinuationEnd::reached);
  EXPECT_NEAR(back.points.back().q[0], 0.0, exact);
}

}  // namespace
}  // namespace hawser
