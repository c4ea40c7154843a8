// The time source of the frame clock: CLOCK_MONOTONIC in [ns], and a sleep that a stop cuts short.

#pragma once

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <ctime>
#include <stop_token>
#include <sys/prctl.h>

namespace poinsot {

struct SteadyTime {
  // The longest time [ns] that a stop goes unnoticed.
  static constexpr std::int64_t kSlice = 50'000'000;

  std::stop_token stop;

  static std::int64_t now() {
    timespec t{};
    clock_gettime(CLOCK_MONOTONIC, &t);
    return std::int64_t{t.tv_sec} * 1'000'000'000 + t.tv_nsec;
  }

  // Linux lets sleeps of a thread overrun by 50 µs to save wake-ups; the calling thread's no more.
  static void sharpen_sleeps() { prctl(PR_SET_TIMERSLACK, 1); }

  // False if the stop came first.
  bool sleep_until(std::int64_t deadline) const {
    for (std::int64_t t = now(); t < deadline && !stop.stop_requested(); t = now()) {
      const std::int64_t wake = std::min(deadline, t + kSlice);
      const timespec until{wake / 1'000'000'000, wake % 1'000'000'000};
      while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
      }
    }
    return !stop.stop_requested();
  }
};

}  // namespace poinsot
