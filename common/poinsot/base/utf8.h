// Text from outside that may be shown: names in scenes and messages.

#pragma once

#include <string>
#include <string_view>

namespace poinsot {

// Well-formed UTF-8 (no overlong forms, no surrogates) without control characters.
// Source: Unicode 15, table 3-7.
bool is_printable_utf8(std::string_view text);

// The same, with '\n' between lines.
bool are_printable_lines(std::string_view text);
// Makes such lines of anything: each byte that has no place in them becomes a question mark.
std::string to_printable_lines(std::string_view text);

}  // namespace poinsot
