// What a run was told between two frames: one entry of its command log.

#pragma once

#include <cstdint>
#include <vector>

#include "poinsot/presentation/order.h"
#include "poinsot/presentation/presentation_layer.h"
#include "poinsot/protocol/wrench_command.h"

namespace poinsot {

// What was handed to PresentationLayer::accept() and obey() in one turn of the loop, refused or
// not. Each list is sorted by (client, seq); among both the order is the same, an order before a
// wrench of the same key.
struct TurnRecord {
  std::uint64_t before = 0;  // the frame that would have been next when the turn began …
  std::uint32_t epoch = 0;   // … and its epoch
  std::vector<WrenchCommand> wrenches = {};
  std::vector<Order> orders = {};
};

// A frame that was advanced to, with its hash.
struct FrameRecord {
  std::uint64_t frame = 0;
  std::uint64_t hash = 0;
};

// Does to the layer what a turn says; appends one reply per command, in the order in which they
// were done. A restore from memory gets its checkpoint: the record is complete afterwards, and can
// be repeated where nothing is in memory.
void apply_turn(TurnRecord& turn, PresentationLayer& layer, std::vector<Reply>& replies);

}  // namespace poinsot
