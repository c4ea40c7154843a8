#include "poinsot/program/exit_code.h"

namespace poinsot {

std::string exit_code_help() {
  std::string text = "Exit codes:\n";
  for (const ExitCodeRow& row : kExitCodes)
    text += "  " + std::to_string(to_int(row.code)) + "  " + std::string(row.meaning) + "\n";
  return text;
}

}  // namespace poinsot
