#include "poinsot/study/progress_bar.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <unistd.h>

#include <spdlog/fmt/fmt.h>

namespace poinsot {
namespace {

constexpr int kBar = 40;                        // characters
constexpr std::chrono::milliseconds kPace{50};  // between two pictures of the same piece of work
constexpr const char* kEraseLine = "\r\x1b[K";  // ECMA-48

bool stderr_is_terminal() {
  const char* const kind = std::getenv("TERM");
  return isatty(STDERR_FILENO) == 1 && kind != nullptr && std::string_view(kind) != "dumb";
}

}  // namespace

std::string progress_line(double done, const std::string& what, std::size_t columns) {
  const double part = std::clamp(done, 0.0, 1.0);
  const auto full = static_cast<int>(part * kBar);
  std::string line = fmt::format(
      "[{}{}] {:3.0f} %  {}", std::string(static_cast<std::size_t>(full), '#'),
      std::string(static_cast<std::size_t>(kBar - full), ' '), std::floor(100 * part), what);
  return line.substr(0, columns);
}

ProgressBar::ProgressBar() : terminal_(stderr_is_terminal()) {}

ProgressBar::~ProgressBar() {
  if (terminal_ && !what_.empty()) std::fputs(kEraseLine, stderr);
}

void ProgressBar::show(double done, const std::string& what) {
  if (!terminal_) return;
  const auto now = std::chrono::steady_clock::now();
  if (what == what_ && now - last_ < kPace) return;
  what_ = what;
  last_ = now;
  std::fprintf(stderr, "%s%s", kEraseLine, progress_line(done, what).c_str());
}

}  // namespace poinsot
