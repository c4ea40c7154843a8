// What one filtered stream of poses sends: of the bodies that match, those that changed enough, as
// often as is asked for. Pure: it is told the time.

#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "poinsot/protocol/pose_snapshot.h"
#include "poinsot/wire/stream_name.h"

namespace poinsot {

// A body of the scene.
struct NamedBody {
  BodyId id;
  std::string name;
};

class StreamFilter {
 public:
  explicit StreamFilter(PoseFilter filter) : filter_(std::move(filter)) {}

  // The bodies that there are from now on; those without a generation are nobody.
  void set_bodies(std::span<const NamedBody> bodies);
  // Somebody began to read: what is sent next is complete, and soon.
  void join() { joined_ = true; }

  // The newest frame, at `now` [ns] of a steady clock. True: `out` is to be sent; its session,
  // sequence and publish_time_ns are left to whoever sends it. May be asked again with the same
  // frame, to send later what was held back by the rate.
  bool take(const PoseSnapshot& frame, std::int64_t now, PoseSnapshot& out);

 private:
  struct Sent {
    std::uint32_t generation = 0;  // 0: not yet
    Vec3 position;
    Quat orientation;
  };

  bool is_due(std::int64_t now) const { return joined_ || filter_.rate == 0 || now >= due_; }
  void set_next_due(std::int64_t now);
  bool changed(const BodyState& body, Sent& sent) const;

  PoseFilter filter_;
  std::vector<std::uint32_t> wanted_;  // per slot: the generation that matches; 0: none
  std::vector<Sent> sent_;             // per slot, if changes are asked for
  bool joined_ = true;
  std::uint32_t epoch_ = 0;  // of the frame sent last
  std::uint64_t frame_ = 0;  // … its index …
  std::uint64_t hash_ = 0;   // … and its hash: a paused run may change
  std::int64_t due_ = 0;     // [ns]
};

}  // namespace poinsot
