// The time of day, for stamps that other processes compare with theirs.

#pragma once

#include <chrono>
#include <cstdint>

namespace poinsot {

// [ns] since 1970-01-01 UTC.
inline std::int64_t utc_ns() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
}

}  // namespace poinsot
