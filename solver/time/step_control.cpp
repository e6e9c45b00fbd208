#include "solver/time/step_control.hpp"

namespace hawser {

void StepControl::begin(double t0, double t1, double h) {
  t0_ = t0;
  t1_ = t1;
  h_ = h;
  tick_ = 0;
}

void StepControl::advance(bool easy) {
  tick_ += ticks();
  const bool aligned = tick_ % (2 * ticks()) == 0;
  if (easy && level_ > 0 && aligned) {
    --level_;
  }
}

bool StepControl::halve() {
  if (level_ == max_halvings_) {
    return false;
  }
  ++level_;
  return true;
}

/// Exactly t1 at the last tick.
double StepControl::time_at(long tick) const {
  return tick == whole() ? t1_ : t0_ + (t1_ - t0_) * static_cast<double>(tick) / static_cast<double>(whole());
}

}  // namespace hawser
