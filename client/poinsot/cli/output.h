// What a verb prints: to stdout at once, and whether anybody still reads it.

#pragma once

#include <cstdio>
#include <string_view>

namespace poinsot {

// False once stdout is closed, as by `| head`.
inline bool put(std::string_view text) {
  return std::fwrite(text.data(), 1, text.size(), stdout) == text.size() &&
         std::fflush(stdout) == 0;
}

}  // namespace poinsot
