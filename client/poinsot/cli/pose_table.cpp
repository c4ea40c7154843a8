#include <algorithm>
#include <array>
#include <cmath>

#include <spdlog/fmt/fmt.h>

#include "poinsot/cli/format.h"
#include "poinsot/cli/units.h"

namespace poinsot {
namespace {

// Columns of one quantity; shown while there is room, in this order.
struct Group {
  std::string_view title;
  int numbers;
  std::size_t width;  // of one number, with the space before it
  int decimals;
  double (*value)(const BodyState&, int);
};

constexpr std::array<Group, 4> kGroups = {{
    {"position x y z [m]", 3, 10, 4, [](const BodyState& b, int i) { return b.position[i]; }},
    {"orientation x y z w", 4, 8, 4,
     [](const BodyState& b, int i) { return b.orientation.coeffs()[i]; }},
    {"velocity x y z [m/s]", 3, 10, 4,
     [](const BodyState& b, int i) { return b.linear_velocity[i]; }},
    {"angular velocity x y z [rad/s]", 3, 11, 4,
     [](const BodyState& b, int i) { return b.angular_velocity[i]; }},
}};

std::size_t width_of(const Group& group) {
  return static_cast<std::size_t>(group.numbers) * group.width;
}

// Characters, not bytes: continuation bytes of UTF-8 do not count.
bool starts_character(char c) {
  return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
}

std::string fitted(std::string_view text, std::size_t width) {
  std::size_t characters = 0;
  std::size_t bytes = 0;
  for (; bytes < text.size(); ++bytes) {
    if (!starts_character(text[bytes])) continue;
    if (characters == width) break;
    ++characters;
  }
  return std::string(text.substr(0, bytes)) + std::string(width - characters, ' ');
}

std::size_t characters(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), starts_character));
}

// A number in a fixed width: fixed point while it fits, else with an exponent; zero has no sign.
std::string cell(double value, const Group& group) {
  std::string text = fmt::format("{:.{}f}", value, group.decimals);
  if (text.find_first_not_of("-0.") == std::string::npos)
    text = fmt::format("{:.{}f}", 0.0, group.decimals);
  if (text.size() >= group.width) text = fmt::format("{:.1e}", value);
  return fmt::format("{:>{}}", text, group.width);
}

// How many groups fit beside names of this width.
std::size_t groups_that_fit(std::size_t name_width, std::size_t columns) {
  std::size_t used = name_width;
  std::size_t count = 0;
  while (count < kGroups.size() && used + width_of(kGroups[count]) <= columns)
    used += width_of(kGroups[count++]);
  return count;
}

std::string titles(std::size_t name_width, std::size_t groups) {
  std::string line = fitted("body", name_width);
  for (std::size_t g = 0; g < groups; ++g)
    line += fmt::format("{:>{}}", kGroups[g].title, width_of(kGroups[g]));
  return line;
}

std::string row(const std::string& name, const BodyState& body, std::size_t name_width,
                std::size_t groups) {
  std::string line = fitted(name, name_width);
  for (std::size_t g = 0; g < groups; ++g)
    for (int i = 0; i < kGroups[g].numbers; ++i)
      line += cell(kGroups[g].value(body, i), kGroups[g]);
  return line;
}

std::string header_line(const PoseSnapshot& poses, const WatchHeader& header) {
  return fmt::format("{}  {}  frame {}  time {:.3f} s  {:.1f} frames/s", header.world, header.state,
                     poses.frame, seconds(poses.sim_time_ns), header.frames_per_second);
}

}  // namespace

std::vector<std::string> pose_table(const PoseSnapshot& poses, const Roster& roster,
                                    const WatchHeader& header, const Screen& screen) {
  constexpr std::size_t kShortestName = 8, kLongestName = 24, kLinesAbove = 2;
  std::size_t name_width = kShortestName;
  std::size_t bodies = 0;
  for (const BodyState& body : poses.bodies) {
    const std::string* const name = roster.shown(body.id);
    if (name == nullptr) continue;
    name_width = std::clamp(characters(*name), name_width, kLongestName);
    ++bodies;
  }
  const std::size_t groups = groups_that_fit(name_width, screen.columns);
  const std::size_t room = screen.rows > kLinesAbove ? screen.rows - kLinesAbove : 0;
  const std::size_t shown = bodies <= room ? bodies : (room > 0 ? room - 1 : 0);

  std::vector<std::string> lines = {header_line(poses, header), titles(name_width, groups)};
  for (const BodyState& body : poses.bodies) {
    const std::string* const name = roster.shown(body.id);
    if (name == nullptr) continue;
    if (lines.size() == kLinesAbove + shown) break;
    lines.push_back(row(*name, body, name_width, groups));
  }
  if (shown < bodies)
    lines.push_back(fmt::format("and {} more (--body NAME chooses)", bodies - shown));
  if (lines.size() > screen.rows) lines.resize(screen.rows);
  for (std::string& line : lines) line = fitted(line, std::min(characters(line), screen.columns));
  return lines;
}

}  // namespace poinsot
