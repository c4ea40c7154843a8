// Numbers of receive queues in shared memory (files fastrtps_port<number>). Private to this module.
//
// Fast DDS numbers a participant's queues like its UDP ports, so that a participant often gets the
// numbers of one that left or died. Who wrote to that one still holds its queue and goes on writing
// to it: the new participant is not heard for seconds, sometimes never. So each participant of ours
// has a number of its own: drawn at random, beyond all UDP ports, never used twice in practice.

#pragma once

#include <cstdint>

namespace poinsot {

inline constexpr std::uint32_t kFirstQueue = 66'000;
inline constexpr std::uint32_t kLastQueue = 99'999;  // the library's own tools expect five digits

constexpr bool is_own_queue(std::uint64_t number) {
  return number >= kFirstQueue && number <= kLastQueue;
}

// A number that no file has.
std::uint32_t draw_queue_number();

}  // namespace poinsot
