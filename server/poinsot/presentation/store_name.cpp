#include "poinsot/presentation/store_name.h"

#include <algorithm>

#include "poinsot/base/utf8.h"
#include "poinsot/protocol/run_control.h"

namespace poinsot {
namespace {

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         c == '-' || c == '.';
}

}  // namespace

std::string store_name_fault(std::string_view name) {
  if (!name.empty() && name.size() <= kMaxStoreName && name.front() != '.' &&
      std::ranges::all_of(name, is_letter))
    return {};
  const bool can_be_shown = name.size() <= kMaxStoreName && is_printable_utf8(name);
  std::string fault = "'";
  fault.append(can_be_shown ? name : "…").append("'");
  fault.append(" is no name: it must be 1 to ").append(std::to_string(kMaxStoreName));
  return fault + " letters, digits, '_', '-' or '.', and not begin with '.'";
}

bool is_autosave_name(std::string_view name) {
  if (!name.starts_with(kAutosavePrefix)) return false;
  name.remove_prefix(kAutosavePrefix.size());
  return !name.empty() && name.find_first_not_of("0123456789") == std::string_view::npos;
}

}  // namespace poinsot
