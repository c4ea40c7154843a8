// Pace meter: how fast a run goes, against real time, and how well its frames keep their deadlines.
// Fixed memory; what needs sorting is sorted when it is asked for. Times are handed in, in [ns] of
// one steady clock.

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "poinsot/protocol/frame_report.h"

namespace poinsot {

// The last values of a stream of them.
class RecentValues {
 public:
  static constexpr std::size_t kCapacity = 1024;

  void add(double value);
  Spread spread() const;  // of nothing: zeros

 private:
  std::array<double, kCapacity> ring_ = {};
  std::size_t next_ = 0;
  std::size_t count_ = 0;
};

class PaceMeter {
 public:
  static constexpr std::int64_t kInstant = 150'000'000;    // shorter ones are too noisy
  static constexpr std::int64_t kWindow = 10'000'000'000;  // of the longer measure, at most

  PaceMeter(double frame_rate, std::int64_t now) : frame_rate_(frame_rate) { restart(now); }

  // Play begins, or the pace asked for is another one: what was measured no longer counts.
  void restart(std::int64_t now);
  // A frame is done.
  void frame(std::int64_t now);
  // It was waited for: how late it began, and how long its work took [ns].
  void paced(std::int64_t lateness, std::int64_t work);

  // Simulated / wall time: over the last kInstant or a little more; and since the restart, over
  // the last kWindow at most. 0 until measured.
  double factor() const { return factor_; }
  double window_factor() const;

  Spread lateness() const { return lateness_.spread(); }      // [s]
  Spread frame_time() const { return frame_time_.spread(); }  // [s]

 private:
  // A frame's end every kInstant or a little later.
  struct Mark {
    std::int64_t time = 0;
    std::uint64_t frames = 0;
  };
  static constexpr std::size_t kMarks = kWindow / kInstant + 2;

  double between(const Mark& from, const Mark& to) const;

  double frame_rate_;
  std::uint64_t frames_ = 0;
  std::array<Mark, kMarks> marks_ = {};
  std::size_t newest_ = 0;
  std::size_t count_ = 0;  // of marks
  double factor_ = 0;
  RecentValues lateness_, frame_time_;
};

}  // namespace poinsot
