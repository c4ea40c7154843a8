// Frame clock: frame n is due at t0 + n·T, an absolute deadline, so that errors of single frames do
// not add up. Waiting is sleep until shortly before the deadline, then a spin. A change of T begins
// a new t0: nothing is owed from before.
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

  // Frames per second of the clock's time, from now on.
  void set_rate(double frame_rate) {
    POINSOT_CHECK(frame_rate > 0);
    period_ = 1e9 / frame_rate;
    restart();
  }

  // All deadlines to come move by so much [ns]: what held the run up was not the run's.
  void postpone(std::int64_t by) { start_ += by; }

  // Sleeps towards the next deadline, for at most `slice` [ns]. True: it is nearer than that.
  bool approach(std::int64_t slice) {
    const std::int64_t now = time_.now();
    if (due(frame_ + 1) - now <= slice) return true;
    time_.sleep_until(now + slice);
    return false;
  }

  // The next frame is due one period from now.
  void restart() {
    start_ = time_.now();
    frame_ = 0;
  }

  // Waits until the next frame is due. False if it was overdue.
  bool wait() {
    const std::int64_t deadline = due(++frame_);
    std::int64_t now = time_.now();
    if (now <= deadline) {
      if (deadline - now > kSpin && !time_.sleep_until(deadline - kSpin)) return true;
      while ((now = time_.now()) < deadline) {
      }
      lateness_ = now - deadline;
      return true;
    }
    lateness_ = now - deadline;
    ++overruns_;
    if (static_cast<double>(lateness_) >= period_) {
      start_ = now;
      frame_ = 0;
    }
    return false;
  }

  std::int64_t lateness() const {
    return lateness_;
  }  // [ns] that the last wait ended after its due
  std::uint64_t overruns() const { return overruns_; }  // frames that came late so far

 private:
  std::int64_t due(std::int64_t frame) const {
    return start_ + std::llround(static_cast<double>(frame) * period_);
  }

  Time time_;
  double period_;           // [ns]
  std::int64_t start_ = 0;  // [ns] t0
  std::int64_t frame_ = 0;  // n of the last wait
  std::int64_t lateness_ = 0;
  std::uint64_t overruns_ = 0;
};

}  // namespace poinsot
