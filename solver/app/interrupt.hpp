// Ctrl-C: the first SIGINT (or SIGTERM) asks for a tidy end, the second one kills.
#pragma once

namespace hawser {

/// Catches the signals while it lives. One at a time.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  bool requested() const;
};

}  // namespace hawser
