// StepControl: cuts one nominal step into halves, quarters, ... where steps fail.
//
// A nominal step from t0 to t1 is a row of 2^max_halvings ticks. A sub-step of level k covers 2^(max_halvings - k) of
// them and starts at a multiple of its length, so that sub-steps end exactly at t1 and every halving can be undone.
// The level survives into the next nominal step and falls by one after an easy step.
#pragma once

namespace hawser {

class StepControl {
 public:
  /// max_halvings in [0, 30].
  explicit StepControl(int max_halvings) : max_halvings_(max_halvings) {}

  /// Starts the nominal step from t0 to t1, h = t1 - t0 but for rounding [s].
  void begin(double t0, double t1, double h);

  /// The sub-step in hand: its end and its length [s].
  double end_time() const { return time_at(tick_ + ticks()); }
  double step() const { return h_ * static_cast<double>(ticks()) / static_cast<double>(whole()); }

  bool finished() const { return tick_ == whole(); }
  bool subdivided() const { return level_ > 0; }

  /// The sub-step succeeded. An easy one lets the next be twice as long where that fits.
  void advance(bool easy);

  /// The sub-step failed: halve it. False where the halvings are used up.
  bool halve();

 private:
  long whole() const { return 1L << max_halvings_; }
  long ticks() const { return whole() >> level_; }
  double time_at(long tick) const;

  int max_halvings_;
  int level_ = 0;
  long tick_ = 0;
  double t0_ = 0.0, t1_ = 0.0, h_ = 0.0;
};

}  // namespace hawser
