// Which frames to show, and how many come.

#pragma once

#include <chrono>
#include <deque>

namespace poinsot {

// Lets frames through at a given rate, evenly: the slots stay on a grid while frames keep coming.
class Pace {
 public:
  using Time = std::chrono::steady_clock::time_point;
  using Duration = std::chrono::nanoseconds;

  // rate [Hz]; 0: every frame.
  explicit Pace(double rate)
      : period_(rate > 0 ? Duration(static_cast<Duration::rep>(1e9 / rate)) : Duration::zero()) {}

  bool is_due(Time now) {
    // A frame that is early by a fraction of the period belongs to the slot it is next to.
    if (now < next_ - period_ / 8) return false;
    next_ = now - next_ < period_ ? next_ + period_ : now + period_;
    return true;
  }

 private:
  Duration period_;
  Time next_{};
};

// Frames per second of wall time, over the last second or so.
class FrameMeter {
 public:
  using Time = std::chrono::steady_clock::time_point;

  void add(Time now) {
    arrivals_.push_back(now);
    while (now - arrivals_.front() > kWindow) arrivals_.pop_front();
  }

  // 0 until two frames have come, and when none came within the window.
  double rate(Time now) const {
    if (arrivals_.size() < 2 || now - arrivals_.back() > kWindow) return 0;
    const std::chrono::duration<double> span = arrivals_.back() - arrivals_.front();
    return span.count() > 0 ? static_cast<double>(arrivals_.size() - 1) / span.count() : 0;
  }

 private:
  static constexpr std::chrono::seconds kWindow{2};
  std::deque<Time> arrivals_;
};

}  // namespace poinsot
