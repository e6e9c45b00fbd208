// Newton on problems whose solution is known, without any line: the loop alone is tested.
#include "solver/newton.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hawser {
namespace {

/// One unknown x [m] with residual f(x) [N] and derivative df(x), floored at `floor` where it is smaller.
class Scalar : public NewtonSystem {
 public:
  double (*f)(double);
  double (*df)(double);
  double x = 0.0;
  double accept = 1e-14, rounding = 1e-16;
  double noise = 0.0;  // added to the residual: what rounding leaves
  double slope = 0.0;  // of the increment, per metre: for the cap
  bool solvable = true;
  std::vector<double> floors;  // asked for

  Scalar(double (*function)(double), double (*derivative)(double), double start) : f(function), df(derivative), x(start) {}

  double residual() override { return std::abs(f(x)) + noise; }
  double tolerance() override { return accept; }
  double roundoff() override { return rounding; }
  double least_tension() override { return df(x); }
  double work() const override { return d_ * f(x); }
  void carry(bool moving) override {
    if (moving) d_ += carried_;
    carried_ = d_;
  }
  bool solve(double floor) override {
    floors.push_back(floor);
    d_ = -f(x) / std::max(df(x), floor);
    return solvable;
  }
  IncrementSize increment() const override { return {std::abs(d_), slope * std::abs(d_), std::abs(d_)}; }
  void advance(double factor) override { x += factor * d_; }

 private:
  double d_ = 0.0, carried_ = 0.0;
};

double cubic(double x) { return x * x * x + x - 2.0; }
double cubic_slope(double x) { return 3.0 * x * x + 1.0; }

TEST(Newton, FindsTheRootWithAQuadraticTail) {
  Scalar system(cubic, cubic_slope, 1.3);
  NewtonOptions options;
  options.length = 100.0;  // no cap
  const NewtonReport report = newton(system, options);
  ASSERT_EQ(report.status, NewtonStatus::converged);
  EXPECT_NEAR(system.x, 1.0, 1e-15);
  // e' = f''/(2 f') e^2 = 0.75 e^2 and R = 4 e, so R' / R^2 tends to 0.75/4; measured while R is far above rounding.
  int measured = 0;
  for (std::size_t k = 1; k < report.residuals.size(); ++k) {
    const double before = report.residuals[k - 1];
    if (before > 0.1 || before < 1e-5) continue;
    EXPECT_NEAR(report.residuals[k] / (before * before), 0.1875, 0.1875 * before);
    ++measured;
  }
  EXPECT_GE(measured, 2);
}

TEST(Newton, CapsTheStepBySlopeAndByLength) {
  Scalar by_length(cubic, cubic_slope, 11.0);
  NewtonOptions options;
  options.length = 10.0;  // steps of at most 1 m
  options.max_iterations = 1;
  newton(by_length, options);
  EXPECT_DOUBLE_EQ(by_length.x, 10.0);
  Scalar by_slope(cubic, cubic_slope, 11.0);
  by_slope.slope = 1.0;  // steps of at most 0.5
  newton(by_slope, options);
  EXPECT_DOUBLE_EQ(by_slope.x, 10.5);
}

TEST(Newton, LowersTheFloorAfterFullStepsAndDropsItUnderTheLeastTension) {
  Scalar system([](double x) { return x + 0.1 * x * x * x; }, [](double x) { return 1.0 + 0.3 * x * x; }, 0.5);
  NewtonOptions options;
  options.length = 100.0;
  options.floor = 20.0;
  const NewtonReport report = newton(system, options);
  ASSERT_TRUE(report.converged());
  ASSERT_GE(system.floors.size(), 3u);
  EXPECT_DOUBLE_EQ(system.floors[0], 20.0);
  EXPECT_DOUBLE_EQ(system.floors[1], 4.0);
  EXPECT_DOUBLE_EQ(system.floors[2], 0.0);  // 0.8 is under the least tension 1
}

TEST(Newton, KeepsTheFloorWhileStepsAreCapped) {
  Scalar system(cubic, cubic_slope, 40.0);
  NewtonOptions options;
  options.length = 10.0;
  options.floor = 1.0e4;
  options.max_iterations = 1;
  system.slope = 1.0;  // the increment 62 -> 6 is capped
  newton(system, options);
  options.max_iterations = 2;
  newton(system, options);
  EXPECT_DOUBLE_EQ(system.floors.back(), 1.0e4);
}

TEST(Newton, AcceptsAResidualThatRoundingHoldsUpAndSaysSo) {
  Scalar system(cubic, cubic_slope, 1.2);
  system.rounding = 1e-12;
  system.noise = 5e-12;  // above tolerance and floor, below 20 floors
  NewtonOptions options;
  options.length = 100.0;
  EXPECT_EQ(newton(system, options).status, NewtonStatus::roundoff);
}

TEST(Newton, DoesNotTakeALargeStandingResidualForRounding) {
  Scalar system(cubic, cubic_slope, 1.2);
  system.rounding = 1e-12;
  system.noise = 1e-9;
  NewtonOptions options;
  options.length = 100.0;
  options.max_iterations = 40;
  const NewtonReport report = newton(system, options);
  EXPECT_EQ(report.status, NewtonStatus::too_many_iterations);
  EXPECT_EQ(report.factorizations, 40);
}

TEST(Newton, ReportsAMatrixThatCannotBeFactorized) {
  Scalar system(cubic, cubic_slope, 1.2);
  system.solvable = false;
  EXPECT_EQ(newton(system, {}).status, NewtonStatus::no_increment);
}

TEST(Newton, ReportsAnIncrementThatIsNotFinite) {
  Scalar system([](double) { return std::nan(""); }, cubic_slope, 1.2);
  EXPECT_EQ(newton(system, {}).status, NewtonStatus::not_finite);
}

TEST(Newton, HalvesStepsThatRaiseTheResidualWhenTheMatrixIsInexact) {
  // The matrix is 0.4 of the derivative: full steps overshoot to -1.5 x and diverge, halved ones go to -0.25 x.
  const auto line = [](double x) { return x; };
  const auto inexact = [](double) { return 0.4; };
  NewtonOptions options;
  options.length = 1e6;
  options.max_iterations = 60;
  Scalar wild(line, inexact, 1.0);
  EXPECT_FALSE(newton(wild, options).converged());
  Scalar damped(line, inexact, 1.0);
  options.inexact_matrix = true;
  const NewtonReport report = newton(damped, options);
  EXPECT_LE(report.residual, damped.accept);
  for (std::size_t k = 1; k < report.residuals.size(); ++k) EXPECT_LE(report.residuals[k], report.residuals[k - 1]);
}

TEST(GuardedNewton, FindsTheRootWithAQuadraticTail) {
  Scalar system(cubic, cubic_slope, 1.3);
  NewtonOptions options;
  options.length = 100.0;
  const NewtonReport report = guarded_newton(system, options);
  ASSERT_EQ(report.status, NewtonStatus::converged);
  EXPECT_NEAR(system.x, 1.0, 1e-15);
  EXPECT_LE(report.factorizations, 7);
}

TEST(GuardedNewton, ShortensAStepAgainstWhichTheResidualPushesBack) {
  // A soft start and a hard stop at x = 1: the whole step of 10 would end far behind it.
  Scalar system([](double x) { return 0.1 * (x - 1.0) + 1e3 * std::pow(std::max(0.0, x - 1.0), 3); },
                [](double x) { return 0.1 + 3e3 * std::pow(std::max(0.0, x - 1.0), 2); }, 0.0);
  system.f = [](double x) { return -1.0 + 0.1 * x + 1e3 * std::pow(std::max(0.0, x - 1.0), 3); };
  NewtonOptions options;
  options.length = 1000.0;
  options.max_iterations = 1;
  guarded_newton(system, options);
  EXPECT_GT(system.x, 0.5);
  EXPECT_LT(system.f(system.x), 0.5);
}

TEST(GuardedNewton, GoesDownhillWhereTheSlopeIsNegativeByRaisingTheFloor) {
  // Energy x^4/4 - x^2/2: Newton's own step from 0.1 goes up to the saddle at 0.
  Scalar system([](double x) { return x * x * x - x; }, [](double x) { return 3.0 * x * x - 1.0; }, 0.1);
  NewtonOptions options;
  options.length = 100.0;
  options.floor = 1.0;
  ASSERT_TRUE(guarded_newton(system, options).converged());
  EXPECT_NEAR(system.x, 1.0, 1e-12);
}

}  // namespace
}  // namespace hawser
