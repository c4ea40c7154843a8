// Names of checkpoints and logs, see kMaxStoreName: words that lead out of no directory.

#pragma once

#include <string>
#include <string_view>

namespace poinsot {

// Why this cannot be the name of a checkpoint or a log; empty if it can.
std::string store_name_fault(std::string_view name);

// "auto-17": a name of the autosaves and nobody else's.
inline constexpr std::string_view kAutosavePrefix = "auto-";
bool is_autosave_name(std::string_view name);

}  // namespace poinsot
