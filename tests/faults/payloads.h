// Payloads that are no command, made from one that is: CDR little-endian with its header of four
// bytes. Whatever is done to them, none can be obeyed by chance: the original names an epoch and a
// body that do not exist, in numbers that differ from any that might in more bits than are ever
// flipped.

#pragma once

#include <array>
#include <cstdint>
#include <random>
#include <vector>

namespace poinsot::faults {

using Bytes = std::vector<unsigned char>;
using Random = std::mt19937_64;

enum class Kind {
  well_formed,    // refused for what it says
  random_bytes,   // after a valid header, up to 400 of them
  no_header,      // random bytes, header and all
  truncated,      // cut anywhere; no bytes at all cannot be written
  bit_flips,      // one to eight
  huge_length,    // four bytes anywhere become a huge number: string lengths, enumerators, flags
  non_finite,     // eight bytes anywhere become a NaN, an infinity, or a number far out of range
  trailing_bytes  // as it is, with up to 60 kB behind it
};
inline constexpr std::array<const char*, 8> kKindNames = {
    "well_formed", "random_bytes", "no_header",  "truncated",
    "bit_flips",   "huge_length",  "non_finite", "trailing_bytes"};

inline constexpr std::uint32_t kNoSuchNumber = 0xAAAAAAAA;
inline constexpr const char* kNoSuchBody = "~nobody~";

// `valid` is a well-formed payload; the result is one of `kind`.
Bytes spoil(const Bytes& valid, Kind kind, Random& random);

}  // namespace poinsot::faults
