// Text from outside that may be shown: names in scenes and messages.

#pragma once

#include <string_view>

namespace poinsot {

// Well-formed UTF-8 (no overlong forms, no surrogates) without control characters.
// Source: Unicode 15, table 3-7.
bool is_printable_utf8(std::string_view text);

}  // namespace poinsot
