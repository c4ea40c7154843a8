// The names of filtered streams of poses. Who reads poinsot/<world>/poses/<suffix> makes the daemon
// write it; the suffix says what is wanted, so that a reader of any vendor can ask for it and
// nobody pays for what nobody reads.
//
//   rate/10/change/0_2e001/match/box_2a
//
// Keys, each at most once, in this order: `rate` [Hz] at most so many samples a second of wall
// time; `change` [m, rad] only bodies that moved or turned by more than that since they were last
// sent; `match` a pattern of names with * and ?, or several, separated by commas. A value is
// written with letters and digits; every other byte as _ and two hexadecimal digits, because topic
// names of some vendors hold nothing else.

#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace poinsot {

struct PoseFilter {
  std::string match = {};             // empty: all bodies
  double rate = 0;                    // [Hz]; 0: every frame
  std::optional<double> change = {};  // [m, rad] ≥ 0

  bool is_all() const { return match.empty() && rate == 0 && !change; }
  friend bool operator==(const PoseFilter&, const PoseFilter&) = default;
};

// The longest suffix: a topic's name has room for 255 bytes.
inline constexpr std::size_t kMaxStreamSuffix = 120;

// Throws Error if a value is out of range or the suffix would be too long. Empty: all bodies.
std::string stream_suffix(const PoseFilter& filter);
// Nothing if it is no such suffix.
std::optional<PoseFilter> parse_stream_suffix(std::string_view suffix);

// Whether a name matches the pattern or one of the patterns of `match`; an empty one matches all.
bool matches(std::string_view match, std::string_view name);

}  // namespace poinsot
