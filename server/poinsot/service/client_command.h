// How a shell on this machine calls the client that belongs to this daemon.

#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace poinsot {

// "poinsot" if a shell with this search path (as in PATH) finds the client beside `program`, or if
// there is none beside it; else its full path.
std::string client_command(const std::filesystem::path& program, std::string_view search_path);

}  // namespace poinsot
