// Creep on systems of one and two unknowns whose equilibria are known.
#include "solver/creep.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

namespace hawser {
namespace {

/// R(x) in the plane, of unit mass.
class Plane : public CreepingSystem {
 public:
  explicit Plane(const Eigen::Vector2d& start) : x(start), from_(start) {}
  Eigen::Vector2d x;

  virtual Eigen::Vector2d R() const = 0;
  virtual Eigen::Matrix2d K() const = 0;

  double residual() override { return whole().norm(); }
  double tolerance() override { return 1e-12; }
  double roundoff() override { return 1e-16; }
  double least_tension() override { return 0.0; }
  bool solve(double) override {
    d_ = -(K() + c_ * Eigen::Matrix2d::Identity()).partialPivLu().solve(whole());
    return true;
  }
  IncrementSize increment() const override { return {d_.norm(), 0.0, d_.norm()}; }
  double work() const override { return d_.dot(whole()); }
  void carry(bool) override {}
  void advance(double factor) override { x += factor * d_; }
  void resist(double c) override { c_ = c, from_ = x; }
  void go_back() override { x = from_; }

 private:
  Eigen::Vector2d whole() const { return R() + c_ * (x - from_); }
  Eigen::Vector2d from_, d_ = Eigen::Vector2d::Zero();
  double c_ = 0.0;
};

/// R = (x^3 - x, 0): equilibria at -1 and 1 (stable) and at 0 (not).
class DoubleWell : public Plane {
 public:
  using Plane::Plane;
  Eigen::Vector2d R() const override { return {std::pow(x[0], 3) - x[0], x[1]}; }
  Eigen::Matrix2d K() const override { return Eigen::Vector2d(3.0 * x[0] * x[0] - 1.0, 1.0).asDiagonal(); }
};

/// A force of size up to one towards the origin that saturates like friction within a thousandth, and one across it that has no potential.
class Swirl : public Plane {
 public:
  using Plane::Plane;
  static constexpr double slip = 1e-3;
  Eigen::Vector2d R() const override { return (x + Eigen::Vector2d(-x[1], x[0])) / size(); }
  Eigen::Matrix2d K() const override {
    const Eigen::Matrix2d turn = (Eigen::Matrix2d() << 1.0, -1.0, 1.0, 1.0).finished();
    return turn * (Eigen::Matrix2d::Identity() - x * x.transpose() / (size() * size())) / size();
  }

 private:
  double size() const { return std::sqrt(x.squaredNorm() + slip * slip); }
};

CreepOptions slow() {
  CreepOptions options;
  options.length = 100.0;
  options.resistance = 50.0;
  options.enough = 1.0;
  options.max_iterations = 300;
  return options;
}

TEST(Creep, ComesToRestInTheWellItStartsIn) {
  for (const double start : {0.7, 2.5, -0.7}) {  // convex there
    DoubleWell system({start, 0.5});
    const NewtonReport report = creep(system, slow());
    ASSERT_TRUE(report.converged()) << start;
    EXPECT_NEAR(system.x[0], std::copysign(1.0, start), 1e-12);  // |R| = 2 |x - 1| there
    EXPECT_LE(report.residual, system.tolerance());
  }
}

TEST(Creep, NeedsNoPotentialAndIsNotMisledByAForceThatSaturates) {
  // Newton from there flies off: the tangent along x is 1e-9 of what it is at the origin.
  Swirl newtons({1.0, 0.5}), system({1.0, 0.5});
  EXPECT_FALSE(newton(newtons, {100.0, 0.0, 1e-8, 50}).converged());
  ASSERT_TRUE(creep(system, slow()).converged());
  EXPECT_LT(system.x.norm(), Swirl::slip * 1e-12);  // |R| = sqrt(2) |x|/slip there
}

TEST(Creep, LeavesTheSystemWithoutResistanceAndSaysThatItStillMoves) {
  Swirl system({1.0, 0.5});
  CreepOptions options = slow();
  options.max_iterations = 3;
  const NewtonReport report = creep(system, options);
  EXPECT_EQ(report.status, NewtonStatus::too_many_iterations);
  EXPECT_LE(report.factorizations, 3);
  EXPECT_DOUBLE_EQ(system.residual(), system.R().norm());
}

}  // namespace
}  // namespace hawser
