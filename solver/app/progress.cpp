#include "solver/app/progress.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "solver/app/text.hpp"

namespace hawser {

std::string progress_line(const ProgressNumbers& n) {
  const double percent = n.duration > 0.0 ? 100.0 * n.time / n.duration : 100.0;
  return fmt::format("t {:.4g}/{:.4g} s  {:.0f} %  h {:.3g} s  newton {:.1f}/step  T_top {}  ETA {}", n.time, n.duration, percent, n.step,
                     n.newton_per_step, with_prefix(n.top_tension, "N"), clock_text(n.eta));
}

Progress::Progress(double duration, std::FILE* stream, bool rewrite)
    : duration_(duration), stream_(stream), rewrite_(rewrite), start_(Clock::now()), last_print_(start_) {}

bool Progress::due(double time, Clock::time_point now) {
  if (rewrite_) return time >= duration_ || now - last_print_ >= std::chrono::milliseconds(250);
  // Output instants are sums of steps: a tenth missed by rounding still counts.
  const int tenths = static_cast<int>(std::floor(10.0 * time / duration_ + 1e-9));
  if (tenths <= tenths_) return false;
  tenths_ = tenths;
  return true;
}

void Progress::update(double time, const SimulateCounters& counters, double top_tension) {
  const Clock::time_point now = Clock::now();
  if (time > 0.0 && due(time, now)) {
    const double elapsed = std::chrono::duration<double>(now - start_).count();
    const auto new_steps = static_cast<double>(counters.steps - last_steps_);
    ProgressNumbers numbers;
    numbers.time = time;
    numbers.duration = duration_;
    numbers.step = new_steps > 0.0 ? (time - last_time_) / new_steps : 0.0;
    numbers.newton_per_step = static_cast<double>(counters.newton_iterations) / static_cast<double>(std::max(counters.steps, 1L));
    numbers.top_tension = top_tension;
    numbers.eta = elapsed * (duration_ - time) / time;
    fmt::print(stream_, "{}{}{}", rewrite_ ? "\r" : "", progress_line(numbers), rewrite_ ? "\x1b[K" : "\n");
    std::fflush(stream_);
    line_open_ = rewrite_;
    last_print_ = now;
  }
  last_time_ = time;
  last_steps_ = counters.steps;
}

void Progress::finish() {
  if (!line_open_) return;
  std::fputc('\n', stream_);
  std::fflush(stream_);
  line_open_ = false;
}

}  // namespace hawser
