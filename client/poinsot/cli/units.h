// Small conversions that texts and JSON share.

#pragma once

#include <array>
#include <cstdint>
#include <cstdio>
#include <string>

#include "poinsot/base/names.h"
#include "poinsot/protocol/frame_report.h"

namespace poinsot {

inline double seconds(std::int64_t nanoseconds) {
  return static_cast<double>(nanoseconds) / 1e9;
}

// Frame n advances the world from (n − 1) / frame_rate to n / frame_rate [s].
inline double start_time(std::uint64_t frame, double frame_rate) {
  return frame == 0 ? 0.0 : static_cast<double>(frame - 1) / frame_rate;
}
inline double end_time(std::uint64_t frame, double frame_rate) {
  return static_cast<double>(frame) / frame_rate;
}

inline std::string hex(std::uint64_t value) {
  std::array<char, 17> text{};
  std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(value));
  return text.data();
}

inline constexpr std::array<Named<FrameFlag>, 8> kFrameFlagNames = {{
    {"body_quarantined", FrameFlag::body_quarantined},
    {"inbox_full", FrameFlag::inbox_full},
    {"overrun", FrameFlag::overrun},
    {"stiff", FrameFlag::stiff},
    {"crowded", FrameFlag::crowded},
    {"input_late", FrameFlag::input_late},
    {"record_failed", FrameFlag::record_failed},
    {"rate_limited", FrameFlag::rate_limited},
}};

}  // namespace poinsot
