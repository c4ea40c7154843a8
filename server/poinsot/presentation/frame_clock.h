// Frame clock: frame n is due at t0 + n·T, an absolute deadline, so that errors of single frames do
// not add up. Waiting is sleep until shortly before the deadline, then a spin.
//
// A frame that comes late by less than a period keeps its deadline, and the next ones catch up. One
// that comes later than that starts the clock afresh from now: simulated time never skips, and a
// run never hurries to make up for more than one frame. Both count as overruns.
//
// The time source is injected: now() and sleep_until(t), both in [ns] of one steady clock. A sleep
// that returns false was cut short by the end of the run: then the wait ends as well.

#pragma once

#include <cmath>
#include <cstdint>
#include <utility>

#include "poinsot/base/check.h"

namespace poinsot {

template <class Time>
class FrameClock {
 public:
  // Before the deadline by this much [ns] the sleep ends: later than a sleep usually overshoots.
  static constexpr std::int64_t kSpin = 150'000;

  FrameClock(Time time, double frame_rate) : time_(std::move(time)), period_(1e9 / frame_rate) {
    POINSOT_CHECK(frame_rate > 0);
    restart();
  }

  // The next frame is due one period from now.
  void restart() {
    start_ = time_.now();
    frame_ = 0;
  }

  // Waits until the next frame is due. False if it was overdue.
  bool wait() {
    ++frame_;
    const std::int64_t due = start_ + std::llround(static_cast<double>(frame_) * period_);
    const std::int64_t now = time_.now();
    if (now <= due) {
      if (due - now > kSpin && !time_.sleep_until(due - kSpin)) return true;
      while (time_.now() < due) {
      }
      return true;
    }
    ++overruns_;
    if (static_cast<double>(now - due) >= period_) {
      start_ = now;
      frame_ = 0;
    }
    return false;
  }

  std::uint64_t overruns() const { return overruns_; }  // frames that came late so far

 private:
  Time time_;
  double period_;           // [ns]
  std::int64_t start_ = 0;  // [ns] t0
  std::int64_t frame_ = 0;  // n of the last wait
  std::uint64_t overruns_ = 0;
};

}  // namespace poinsot
