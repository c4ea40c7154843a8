#include "poinsot/service/pace_meter.h"

#include <algorithm>
#include <cmath>

namespace poinsot {

void RecentValues::add(double value) {
  ring_[next_] = value;
  next_ = (next_ + 1) % kCapacity;
  count_ = std::min(count_ + 1, kCapacity);
}

Spread RecentValues::spread() const {
  if (count_ == 0) return {};
  std::array<double, kCapacity> sorted = ring_;
  const auto begin = sorted.begin();
  const auto end = begin + static_cast<std::ptrdiff_t>(count_);
  // The smallest value that so many of all do not exceed.
  const auto quantile = [&](double share) {
    const auto rank = static_cast<std::ptrdiff_t>(std::ceil(share * static_cast<double>(count_)));
    const auto place = begin + rank - 1;
    std::nth_element(begin, place, end);
    return *place;
  };
  return {.p50 = quantile(0.50), .p99 = quantile(0.99), .max = *std::max_element(begin, end)};
}

void PaceMeter::restart(std::int64_t now) {
  newest_ = 0;
  count_ = 1;
  marks_[0] = {now, frames_};
  factor_ = 0;
}

void PaceMeter::frame(std::int64_t now) {
  ++frames_;
  const Mark& last = marks_[newest_];
  if (now - last.time < kInstant) return;
  const Mark mark{now, frames_};
  factor_ = between(last, mark);
  newest_ = (newest_ + 1) % kMarks;
  count_ = std::min(count_ + 1, kMarks);
  marks_[newest_] = mark;
}

void PaceMeter::paced(std::int64_t lateness, std::int64_t work) {
  lateness_.add(1e-9 * static_cast<double>(lateness));
  frame_time_.add(1e-9 * static_cast<double>(work));
}

double PaceMeter::window_factor() const {
  const Mark& newest = marks_[newest_];
  for (std::size_t back = count_ - 1; back > 0; --back) {
    const Mark& from = marks_[(newest_ + kMarks - back) % kMarks];
    if (newest.time - from.time <= kWindow || back == 1) return between(from, newest);
  }
  return 0;
}

double PaceMeter::between(const Mark& from, const Mark& to) const {
  const double wall = 1e-9 * static_cast<double>(to.time - from.time);
  return static_cast<double>(to.frames - from.frames) / frame_rate_ / wall;
}

}  // namespace poinsot
