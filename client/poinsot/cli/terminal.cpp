#include "poinsot/cli/terminal.h"

#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <sys/ioctl.h>
#include <unistd.h>

namespace poinsot {
namespace {

// ECMA-48 and xterm control sequences.
constexpr std::string_view kEnter = "\x1b[?1049h\x1b[?25l";
constexpr std::string_view kLeave = "\x1b[?25h\x1b[?1049l";
constexpr std::string_view kHome = "\x1b[H";
constexpr std::string_view kEndOfLine = "\x1b[K";
constexpr std::string_view kRestOfScreen = "\x1b[J";

void put(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stdout);
  std::fflush(stdout);
}

}  // namespace

bool stdout_is_terminal() {
  const char* const kind = std::getenv("TERM");
  return isatty(STDOUT_FILENO) == 1 && kind != nullptr && std::string_view(kind) != "dumb";
}

LiveScreen::LiveScreen() {
  put(kEnter);
}

LiveScreen::~LiveScreen() {
  std::string text(kLeave);
  for (const std::string& line : last_) text += line + "\n";
  put(text);
}

Screen LiveScreen::size() const {
  winsize window{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &window) != 0 || window.ws_row == 0) return {};
  return {.columns = window.ws_col, .rows = window.ws_row};
}

void LiveScreen::draw(const std::vector<std::string>& lines) {
  std::string text(kHome);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    text += lines[i];
    text += kEndOfLine;
    if (i + 1 < lines.size()) text += "\r\n";  // a break after the last row would scroll
  }
  text += kRestOfScreen;
  put(text);
  last_ = lines;
}

}  // namespace poinsot
