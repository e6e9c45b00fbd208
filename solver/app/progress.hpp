// Progress of a run on stderr:
//
//   t 41.2/120 s  34 %  h 0.05 s  newton 2.1/step  T_top 58.2 kN  ETA 00:02
//
// On a terminal one line is rewritten at most 4 times a second; elsewhere a line is printed at each tenth of the duration.
#pragma once

#include <chrono>
#include <cstdio>
#include <string>

#include "solver/simulate.hpp"

namespace hawser {

struct ProgressNumbers {
  double time = 0.0, duration = 0.0;  // s, simulated
  double step = 0.0;                  // s, mean since the last output instant
  double newton_per_step = 0.0;       // mean since the start
  double top_tension = 0.0;           // N
  double eta = 0.0;                   // s of wall clock; not finite: unknown
};

std::string progress_line(const ProgressNumbers& numbers);

class Progress {
 public:
  /// `rewrite`: the stream is a terminal that may be rewritten in place.
  Progress(double duration, std::FILE* stream, bool rewrite);

  /// Call at every output instant; prints when it is time to.
  void update(double time, const SimulateCounters& counters, double top_tension);

  /// Ends a line that was being rewritten.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;
  bool due(double time, Clock::time_point now);

  double duration_;
  std::FILE* stream_;
  bool rewrite_;
  bool line_open_ = false;
  Clock::time_point start_, last_print_;
  int tenths_ = 0;  // tenths of the duration already reported
  double last_time_ = 0.0;
  long last_steps_ = 0;
};

}  // namespace hawser
