// Dynamic relaxation on one unknown whose equilibria are known.
#include "solver/relaxation.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hawser {
namespace {

/// R(x) = x^3 - x: equilibria at -1 and 1 (stable) and at 0 (not); the mass is the floor alone.
class DoubleWell : public NewtonSystem {
 public:
  double x = 0.0, accept = 1e-12;

  double residual() override { return std::abs(R()); }
  double tolerance() override { return accept; }
  double roundoff() override { return 1e-16; }
  double least_tension() override { return 0.0; }
  bool solve(double floor) override {
    d_ = -R() / floor;
    return floor > 0.0;
  }
  IncrementSize increment() const override { return {std::abs(d_), 0.0, std::abs(d_)}; }
  double work() const override { return d_ * R(); }
  void carry(bool moving) override {
    if (moving) d_ += carried_;
    carried_ = d_;
  }
  void advance(double factor) override { x += factor * d_; }

 private:
  double R() const { return x * x * x - x; }
  double d_ = 0.0, carried_ = 0.0;
};

RelaxationOptions slow() {
  RelaxationOptions options;
  options.length = 100.0;
  options.floor = 200.0;  // a hundredth of the stiffness at rest, 2: the frequency of steps is a tenth
  return options;
}

TEST(Relaxation, ComesToRestWhereItIsStable) {
  DoubleWell system;
  system.x = 2.5;
  const NewtonReport report = relax(system, slow());
  ASSERT_TRUE(report.converged());
  // |R| = 2 |x - 1| there, at most 1e4 tolerances.
  EXPECT_NEAR(system.x, 1.0, 1e-8);
}

TEST(Relaxation, LeavesAnEquilibriumThatIsNotStable) {
  DoubleWell system;
  system.x = -1e-6;
  ASSERT_TRUE(relax(system, slow()).converged());
  EXPECT_NEAR(system.x, -1.0, 1e-8);
}

TEST(Relaxation, TakesManyFewerStepsWithMomentumThanDownhill) {
  DoubleWell system, downhill;
  system.x = downhill.x = 2.5;
  const int steps = relax(system, slow()).factorizations;
  int plain = 0;
  for (; downhill.residual() > 1e-8 && plain < 100000; ++plain) {
    downhill.solve(slow().floor);
    downhill.advance(1.0);
  }
  EXPECT_LT(3 * steps, plain);
}

TEST(Relaxation, SaysThatItStillMoves) {
  DoubleWell system;
  system.x = 2.5;
  RelaxationOptions options = slow();
  options.max_steps = 5;
  const NewtonReport report = relax(system, options);
  EXPECT_EQ(report.status, NewtonStatus::too_many_iterations);
  EXPECT_EQ(report.factorizations, 5);
  EXPECT_EQ(report.residuals.size(), 6u);
}

TEST(Relaxation, SaysThatThereIsNoIncrement) {
  DoubleWell system;
  system.x = 2.5;
  RelaxationOptions options = slow();
  options.floor = 0.0;
  EXPECT_EQ(relax(system, options).status, NewtonStatus::no_increment);
}

}  // namespace
}  // namespace hawser
