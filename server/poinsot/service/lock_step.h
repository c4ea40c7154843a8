// Lock step: the clients whose input is waited for before every frame. A member says with `advance`
// that its input for the next frame is complete; the frame may begin when all have said so, or when
// the shortest of their time-outs has run out.
//
// Plain bookkeeping: who waits, and on what clock, is the loop's affair. One thread.

#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "poinsot/protocol/run_control.h"

namespace poinsot {

class LockStep {
 public:
  bool empty() const { return members_.empty(); }
  std::size_t size() const { return members_.size(); }
  bool has(std::uint64_t client) const { return find(client) != nullptr; }

  // Joins, or changes the time-out [ns] of a member.
  void join(std::uint64_t client, std::int64_t timeout_ns);
  // The member's `advance` that no frame has answered, if there is one.
  std::optional<RunControl> leave(std::uint64_t client);

  // A member's input is complete. False: it was already.
  bool offer(const RunControl& advance);

  bool ready() const;               // nobody is waited for
  std::int64_t timeout_ns() const;  // the shortest; there must be a member

  // Hands out every `advance` that has come, by client; the next frame needs new ones.
  void take(std::vector<RunControl>& advances);

 private:
  struct Member {
    std::uint64_t client = 0;
    std::int64_t timeout_ns = 0;
    std::optional<RunControl> advance = {};
  };

  const Member* find(std::uint64_t client) const;
  Member* find(std::uint64_t client);

  std::vector<Member> members_;  // by client
};

}  // namespace poinsot
