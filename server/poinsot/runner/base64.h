// Bytes as text: base64 (RFC 4648, with padding), for bytes inside JSON.

#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace poinsot {

std::string to_base64(std::span<const std::byte> bytes);

// Throws Error for text that to_base64() does not make.
std::vector<std::byte> from_base64(std::string_view text);

}  // namespace poinsot
