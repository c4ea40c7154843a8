// Median, 99th percentile and maximum of values, and the times between arrivals.

#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "poinsot/protocol/frame_report.h"

namespace poinsot {

// By nearest rank: the smallest value that at least the given share of all values is not above.
inline Spread spread_of(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const auto rank = [&](double share) {
    const auto count = static_cast<double>(values.size());
    const auto index = static_cast<std::size_t>(std::max(1.0, std::ceil(share * count))) - 1;
    return values[std::min(index, values.size() - 1)];
  };
  return {.p50 = rank(0.5), .p99 = rank(0.99), .max = values.back()};
}

// Times between samples that come one after another [s].
class ArrivalMeter {
 public:
  using Time = std::chrono::steady_clock::time_point;

  void add(Time now) {
    if (last_) periods_.push_back(std::chrono::duration<double>(now - *last_).count());
    last_ = now;
  }

  // Since the last call: the samples [1/s] and the times between them.
  struct Report {
    double rate = 0;  // [Hz] 0 if none came
    std::size_t samples = 0;
    Spread period;  // [s]
  };
  Report take() {
    Report report;
    report.samples = periods_.size();
    double span = 0;
    for (const double period : periods_) span += period;
    if (span > 0) report.rate = static_cast<double>(periods_.size()) / span;
    report.period = spread_of(std::move(periods_));
    periods_.clear();
    return report;
  }

 private:
  std::optional<Time> last_;
  std::vector<double> periods_;
};

}  // namespace poinsot
