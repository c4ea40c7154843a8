// Exit codes of both executables: one table, printed at the end of --help.
//
// An interrupt (SIGINT) or a polite end (SIGTERM) that a program handles is a success: 0. A shell's
// 128 + n therefore always means a signal that was not handled.

#pragma once

#include <array>
#include <string>
#include <string_view>

namespace poinsot {

enum class ExitCode : int { ok = 0, failure = 1, usage = 2 };

struct ExitCodeRow {
  ExitCode code;
  std::string_view meaning;
};

inline constexpr std::array<ExitCodeRow, 3> kExitCodes = {{
    {ExitCode::ok, "done, or ended by Ctrl-C or SIGTERM"},
    {ExitCode::failure, "failed while running: refused, no answer in time, the bus or a file"},
    {ExitCode::usage, "bad input: the command line, the environment, a scene file"},
}};

constexpr int to_int(ExitCode code) {
  return static_cast<int>(code);
}

// The table as text, a line each.
std::string exit_code_help();

}  // namespace poinsot
