// Budget: wall time that is shared out among runs. What a run leaves goes to those after it.

#pragma once

#include <chrono>
#include <cstddef>

namespace poinsot {

class Budget {
 public:
  using Clock = std::chrono::steady_clock;

  Budget(std::chrono::duration<double> total, std::size_t runs)
      : end_(Clock::now() + std::chrono::duration_cast<Clock::duration>(total)),
        runs_(runs),
        left_(runs) {}

  // The time by which the next `runs` are to end, that need but this part of their share. They are
  // taken off.
  Clock::time_point deadline(std::size_t runs = 1, double part = 1) {
    const Clock::time_point now = Clock::now();
    const double share = part * static_cast<double>(runs) / static_cast<double>(left_);
    left_ -= runs;
    return now + std::chrono::duration_cast<Clock::duration>((end_ - now) * share);
  }

  // Part of the runs that has been given a deadline, 0 … 1.
  double shared_out() const { return 1 - static_cast<double>(left_) / static_cast<double>(runs_); }

 private:
  Clock::time_point end_;
  std::size_t runs_;
  std::size_t left_;
};

}  // namespace poinsot
