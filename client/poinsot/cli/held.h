// What is held on bodies, in words and as JSON.

#pragma once

#include <cstdint>
#include <string>

#include "poinsot/cli/roster.h"
#include "poinsot/protocol/held_list.h"

namespace poinsot {

struct HeldView {
  const HeldList& held;
  const Roster& roster;
  std::uint64_t me = 0;    // whose items are "you"
  double frame_rate = 60;  // [Hz]
};

// A table with a line per item, or a sentence if there is none.
std::string held_text(const HeldView& view);

// {"frame", "epoch", "held": [{"client", "you", "seq", "slot", "body", "kind", …}], "left_out"};
// the client is "scene" or 16 hexadecimal digits, slot and last_frame may be null.
std::string held_json(const HeldView& view);

}  // namespace poinsot
