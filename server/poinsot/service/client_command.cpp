#include "poinsot/service/client_command.h"

#include <system_error>

namespace poinsot {

std::string client_command(const std::filesystem::path& program, std::string_view search_path) {
  const std::string name = "poinsot";
  const std::filesystem::path beside = program.parent_path() / name;
  std::error_code error;  // what cannot be read is not there
  if (!std::filesystem::is_regular_file(beside, error)) return name;
  while (!search_path.empty()) {
    const std::string_view directory = search_path.substr(0, search_path.find(':'));
    search_path.remove_prefix(std::min(directory.size() + 1, search_path.size()));
    const std::filesystem::path found = std::filesystem::path(directory) / name;
    if (!std::filesystem::is_regular_file(found, error)) continue;
    return std::filesystem::equivalent(found, beside, error) ? name : beside.string();
  }
  return beside.string();
}

}  // namespace poinsot
