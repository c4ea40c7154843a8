#include "poinsot/program/log.h"

#include <algorithm>
#include <cctype>

#include <spdlog/sinks/stdout_color_sinks.h>

namespace poinsot {

Logger make_logger(const std::string& name, spdlog::level::level_enum quiet, int verbosity) {
  auto logger = std::make_shared<spdlog::logger>(
      name, std::make_shared<spdlog::sinks::stderr_color_sink_mt>());
  logger->set_pattern("%Y-%m-%dT%H:%M:%S.%e%z %^%-8l%$ %v");
  const int level = std::max<int>(quiet - verbosity, spdlog::level::trace);
  logger->set_level(static_cast<spdlog::level::level_enum>(level));
  return logger;
}

std::string quoted(std::string_view value) {
  const auto plain = [](unsigned char c) { return std::isgraph(c) && c != '"' && c != '='; };
  if (!value.empty() && std::all_of(value.begin(), value.end(), plain)) return std::string(value);
  std::string text = "\"";
  for (const char c : value) {
    if (c == '"' || c == '\\') text += '\\';
    text += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? ' ' : c;
  }
  return text + '"';
}

std::optional<std::uint64_t> RepeatLimiter::admit(Time now) {
  if (last_ && now - *last_ < interval_) {
    ++held_back_;
    return std::nullopt;
  }
  last_ = now;
  return std::exchange(held_back_, 0);
}

}  // namespace poinsot
