#include "solver/app/progress.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <limits>
#include <memory>
#include <string>

#include "solver/app/text.hpp"

namespace hawser {
namespace {

TEST(ProgressLine, SaysTimeShareStepNewtonTensionAndRest) {
  EXPECT_EQ(progress_line({41.2, 120.0, 0.05, 2.1, 58200.0, 2.0}), "t 41.2/120 s  34 %  h 0.05 s  newton 2.1/step  T_top 58.2 kN  ETA 00:02");
}

std::string printed_by_a_run(bool rewrite) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(std::tmpfile(), &std::fclose);
  Progress progress(10.0, stream.get(), rewrite);
  SimulateCounters counters;
  for (int i = 0; i <= 100; ++i) {
    counters.steps = 2 * i;
    counters.newton_iterations = 4 * i;
    progress.update(0.1 * i, counters, 1000.0);
  }
  progress.finish();
  std::rewind(stream.get());
  std::string text;
  for (int c = std::fgetc(stream.get()); c != EOF; c = std::fgetc(stream.get())) text += static_cast<char>(c);
  return text;
}

TEST(Progress, PrintsALineEachTenthWhereTheStreamIsNoTerminal) {
  const std::string text = printed_by_a_run(false);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 10);
  EXPECT_EQ(text.find('\x1b'), std::string::npos);
  EXPECT_NE(text.find("t 5/10 s  50 %  h 0.05 s  newton 2.0/step  T_top 1.00 kN"), std::string::npos) << text;
}

TEST(Progress, RewritesOneLineOnATerminalAndEndsIt) {
  const std::string text = printed_by_a_run(true);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1);
  EXPECT_EQ(text.front(), '\r');
  EXPECT_EQ(text.back(), '\n');
  EXPECT_NE(text.find("t 10/10 s  100 %"), std::string::npos);
}

TEST(WithPrefix, GivesThreeDigitsAndTheNearestPrefix) {
  EXPECT_EQ(with_prefix(58200.0, "N"), "58.2 kN");
  EXPECT_EQ(with_prefix(999.6, "N"), "1.00 kN");
  EXPECT_EQ(with_prefix(999.4, "N"), "999 N");
  EXPECT_EQ(with_prefix(-1234.0, "N"), "-1.23 kN");
  EXPECT_EQ(with_prefix(0.0123, "s"), "12.3 ms");
  EXPECT_EQ(with_prefix(-0.0, "N"), "0 N");
  EXPECT_EQ(with_prefix(4e12, "N"), "4000 GN");
}

TEST(ClockText, CountsMinutesThenHours) {
  EXPECT_EQ(clock_text(2.0), "00:02");
  EXPECT_EQ(clock_text(3599.4), "59:59");
  EXPECT_EQ(clock_text(3661.0), "1:01:01");
  EXPECT_EQ(clock_text(std::numeric_limits<double>::infinity()), "--:--");
}

TEST(Table, AlignsTheFirstColumnLeftAndTheOthersRight) { EXPECT_EQ(table({{"a", "long"}, {"\xc3\xa9tat", "1"}}), "a     long\n\xc3\xa9tat     1\n"); }

}  // namespace
}  // namespace hawser
