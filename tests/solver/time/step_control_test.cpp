#include "solver/time/step_control.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace hawser {
namespace {

TEST(StepControl, WithoutFailuresTakesTheNominalStep) {
  StepControl control(10);
  control.begin(0.0, 0.1, 0.1);
  EXPECT_FALSE(control.subdivided());
  EXPECT_EQ(control.end_time(), 0.1);
  EXPECT_EQ(control.step(), 0.1);
  control.advance(true);
  EXPECT_TRUE(control.finished());
}

TEST(StepControl, SubStepsAfterAFailureEndExactlyAtTheNominalEnd) {
  StepControl control(10);
  control.begin(0.0, 0.3, 0.3);
  ASSERT_TRUE(control.halve());
  ASSERT_TRUE(control.halve());
  std::vector<double> ends;
  while (!control.finished()) {
    ends.push_back(control.end_time());
    control.advance(true);
  }
  // A quarter, one more because a half does not fit there, then the second half.
  ASSERT_EQ(ends.size(), 3U);
  EXPECT_DOUBLE_EQ(ends[0], 0.075);
  EXPECT_DOUBLE_EQ(ends[1], 0.15);
  EXPECT_EQ(ends[2], 0.3);
}

TEST(StepControl, StaysFineWhileStepsAreHard) {
  StepControl control(10);
  control.begin(0.0, 1.0, 1.0);
  ASSERT_TRUE(control.halve());
  ASSERT_TRUE(control.halve());
  int steps = 0;
  for (; !control.finished(); ++steps) {
    control.advance(false);
  }
  EXPECT_EQ(steps, 4);
  control.begin(1.0, 2.0, 1.0);
  EXPECT_DOUBLE_EQ(control.step(), 0.25);
  EXPECT_TRUE(control.subdivided());
}

TEST(StepControl, HalvingsAreBounded) {
  StepControl control(3);
  control.begin(0.0, 8.0, 8.0);
  EXPECT_TRUE(control.halve());
  EXPECT_TRUE(control.halve());
  EXPECT_TRUE(control.halve());
  EXPECT_DOUBLE_EQ(control.step(), 1.0);
  EXPECT_FALSE(control.halve());
  EXPECT_DOUBLE_EQ(control.step(), 1.0);
}

}  // namespace
}  // namespace hawser
