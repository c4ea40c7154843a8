#include "poinsot/wire/stream_name.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>

#include "poinsot/base/error.h"
#include "poinsot/base/limits.h"

namespace poinsot {
namespace {

constexpr double kLeastRate = 1e-3, kMaxRate = 1e6;  // [Hz]

bool is_plain(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
}

std::string encoded(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (is_plain(c)) {
      out += c;
      continue;
    }
    std::array<char, 4> hex{};
    std::snprintf(hex.data(), hex.size(), "_%02x",
                  static_cast<unsigned>(static_cast<unsigned char>(c)));
    out += hex.data();
  }
  return out;
}

std::optional<std::string> decoded(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (is_plain(text[i])) {
      out += text[i];
      continue;
    }
    if (text[i] != '_' || i + 2 >= text.size()) return std::nullopt;
    unsigned byte = 0;
    const auto [end, error] = std::from_chars(&text[i + 1], &text[i + 1] + 2, byte, 16);
    if (error != std::errc() || end != &text[i + 1] + 2 || byte == 0) return std::nullopt;
    out += static_cast<char>(byte);
    i += 2;
  }
  return out;
}

std::string number(double value) {
  std::array<char, 32> text{};
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), end};
}

std::optional<double> parse_number(const std::string& text, double limit) {
  double value = 0;
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, value);
  if (error != std::errc() || end != last || !std::isfinite(value) || value < 0 || value > limit)
    return std::nullopt;
  return value;
}

// "key/value/rest": takes key and value off if it begins with this key.
std::optional<std::string_view> take(std::string_view& suffix, std::string_view key) {
  std::string_view rest = suffix;
  if (!rest.starts_with(key) || rest.size() <= key.size() || rest[key.size()] != '/')
    return std::nullopt;
  rest.remove_prefix(key.size() + 1);
  const std::size_t end = rest.find('/');
  const std::string_view value = rest.substr(0, end);
  suffix = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
  return value;
}

bool matches_pattern(std::string_view pattern, std::string_view name) {
  std::size_t p = 0, n = 0, star = std::string_view::npos, resume = 0;
  while (n < name.size()) {
    if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == name[n]) && pattern[p] != '*') {
      ++p, ++n;
    } else if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      resume = n;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      n = ++resume;
    } else {
      return false;
    }
  }
  while (p < pattern.size() && pattern[p] == '*') ++p;
  return p == pattern.size();
}

}  // namespace

std::string stream_suffix(const PoseFilter& filter) {
  if (filter.rate != 0 && !(filter.rate >= kLeastRate && filter.rate <= kMaxRate))
    throw Error("rate " + number(filter.rate) + " is not between " + number(kLeastRate) + " and " +
                number(kMaxRate));
  if (filter.change && !(*filter.change >= 0 && *filter.change <= kMaxPoint))
    throw Error("change " + number(*filter.change) + " is not between 0 and " + number(kMaxPoint));
  std::string suffix;
  const auto add = [&suffix](std::string_view key, const std::string& value) {
    suffix.append(suffix.empty() ? "" : "/").append(key).append("/").append(encoded(value));
  };
  if (filter.rate > 0) add("rate", number(filter.rate));
  if (filter.change) add("change", number(*filter.change));
  if (!filter.match.empty()) add("match", filter.match);
  if (suffix.size() > kMaxStreamSuffix)
    throw Error("match '" + filter.match + "' is too long for the name of a topic");
  return suffix;
}

std::optional<PoseFilter> parse_stream_suffix(std::string_view suffix) {
  if (suffix.empty() || suffix.size() > kMaxStreamSuffix) return std::nullopt;
  PoseFilter filter;
  if (const auto rate = take(suffix, "rate")) {
    const auto text = decoded(*rate);
    const auto value = text ? parse_number(*text, kMaxRate) : std::nullopt;
    if (!value || *value < kLeastRate) return std::nullopt;
    filter.rate = *value;
  }
  if (const auto change = take(suffix, "change")) {
    const auto text = decoded(*change);
    filter.change = text ? parse_number(*text, kMaxPoint) : std::nullopt;
    if (!filter.change) return std::nullopt;
  }
  if (const auto match = take(suffix, "match")) {
    const auto text = decoded(*match);
    if (!text || text->empty()) return std::nullopt;
    filter.match = *text;
  }
  if (!suffix.empty()) return std::nullopt;
  return filter;
}

bool matches(std::string_view match, std::string_view name) {
  if (match.empty()) return true;
  while (true) {
    const std::size_t comma = match.find(',');
    if (matches_pattern(match.substr(0, comma), name)) return true;
    if (comma == std::string_view::npos) return false;
    match.remove_prefix(comma + 1);
  }
}

}  // namespace poinsot
