// Which datagrams the packaged library survives.
//
// Fast DDS 2.9.1 believes two things that a packet says: a GAP's range, which it walks through
// number by number (2^62 of them hold its thread, and whoever waits for that, for ever), and the
// size of a sample that comes in fragments, which it allocates. Both are bounded here by what
// anybody has a use for; a packet that says more is dropped whole.

#pragma once

#include <cstdint>
#include <span>

namespace poinsot {

inline constexpr std::int64_t kMaxGap = 1 << 16;             // sequence numbers in one GAP
inline constexpr std::uint32_t kMaxSample = 256u << 20;      // [bytes]: a body of many meshes
inline constexpr std::uint32_t kMaxCommandSample = 1 << 20;  // [bytes]: a fragment to spawn

// `packet` is a whole RTPS message, its header included. `largest` [bytes]: of a sample that comes
// in fragments.
bool is_harmless(std::span<const unsigned char> packet, std::uint32_t largest = kMaxSample);

}  // namespace poinsot
