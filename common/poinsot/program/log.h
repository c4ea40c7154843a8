// The log of an executable: one logger, made in main and passed down; lines `event key=value` on
// stderr. Data belongs on stdout. Nothing is logged per frame, and repeats go through
// RepeatLimiter.
//
//   logger->info("listening world={} domain={}", poinsot::quoted(world), domain);

#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include <spdlog/logger.h>

namespace poinsot {

using Logger = std::shared_ptr<spdlog::logger>;

// `quiet` is the level without -v; each -v adds one level of detail. Any thread may log.
Logger make_logger(const std::string& name, spdlog::level::level_enum quiet, int verbosity);

// A value as it stands after `key=`: as it is if it is one word, else in quotes, always one line.
std::string quoted(std::string_view value);

// Lets one of many equal lines through per interval. One limiter per kind of line, one thread at a
// time; the time is handed in.
class RepeatLimiter {
 public:
  using Time = std::chrono::steady_clock::time_point;

  explicit RepeatLimiter(std::chrono::nanoseconds interval) : interval_(interval) {}

  // The number of lines held back since the last one let through, if this one may pass.
  std::optional<std::uint64_t> admit(Time now);

 private:
  std::chrono::nanoseconds interval_;
  std::optional<Time> last_;
  std::uint64_t held_back_ = 0;
};

}  // namespace poinsot
