// Token bucket: so many a second, and so many at once after a quiet time. The time is handed in, in
// [ns] of one steady clock.

#pragma once

#include <algorithm>
#include <cstdint>

namespace poinsot {

class TokenBucket {
 public:
  TokenBucket(double per_second, double burst, std::int64_t now)
      : per_ns_(1e-9 * per_second), burst_(burst), tokens_(burst), last_(now) {}

  // False: there are not as many. What costs more than a full bucket costs a full bucket.
  bool take(double cost, std::int64_t now) {
    tokens_ = std::min(
        burst_, tokens_ + per_ns_ * static_cast<double>(std::max<std::int64_t>(now - last_, 0)));
    last_ = now;
    cost = std::min(cost, burst_);
    if (tokens_ < cost) return false;
    tokens_ -= cost;
    return true;
  }

 private:
  double per_ns_;
  double burst_;
  double tokens_;
  std::int64_t last_;
};

}  // namespace poinsot
