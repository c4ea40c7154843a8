// Held wrenches: what clients and the scene push, from the frame that accepts a command to its last
// frame of effect. A zero-order hold: within a frame nothing changes.
//
// Accepting resolves everything that depends on the moment: the body becomes a column, a point
// becomes body-fixed, a duration becomes a first and a last frame. Applying only adds up, in the
// order (client, seq), so that the sums do not depend on the order of arrival. Nothing is computed
// in a frame in which no wrench starts, ends or is cleared.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "poinsot/base/hash.h"
#include "poinsot/base/limits.h"
#include "poinsot/presentation/command_check.h"
#include "poinsot/protocol/wrench_command.h"
#include "poinsot/simulation/world.h"

namespace poinsot {

// Frames that a duration [s] of simulated time takes: rounded up, at least one. The slack of 1e-6
// of a frame keeps 0.5 s at 60 Hz at 30 frames whatever the last bit says.
std::uint64_t frames_of(double duration, double frame_rate);

class HeldWrenches {
 public:
  // The most wrenches that can be held at once, by the scene and all clients together.
  static constexpr std::size_t kCapacity = kMaxHeldWrenches;

  explicit HeldWrenches(double frame_rate);

  // Appends one reply per command, in order. The commands are sorted by (client, seq); `next` is
  // the frame that will be advanced next, `epoch` the run's.
  void accept(std::span<const WrenchCommand> commands, const World& world, std::uint64_t next,
              std::uint32_t epoch, std::vector<Reply>& replies);

  // Whether what is held in `frame` differs from what was last applied; if not, apply_to() has
  // nothing to do.
  bool changes(std::uint64_t frame) const { return changed_ || frame >= next_change_; }
  // Sets world.held for frame `frame`, and forgets wrenches that have ended.
  void apply_to(World& world, std::uint64_t frame);

  // Adds what frames after `frame` depend on; `frame` is the one last applied.
  void hash_into(Hash64& hash, std::uint64_t frame) const;

  std::size_t size() const { return held_.size(); }

 private:
  struct Held {
    std::uint64_t client;
    std::uint64_t seq;
    std::uint64_t first_frame;
    std::uint64_t last_frame;
    Eigen::Index column;
    Axes axes;    // of force and torque
    Vec3 force;   // [N]
    Vec3 torque;  // [N·m] free couple
    Vec3 p_B;     // [m] point of action from the centre of mass, in B
  };

  struct Moment {  // of acceptance
    const World& world;
    std::uint64_t next;
    std::uint32_t epoch;
    int suggestions;  // nearest names still looked up in this batch
  };

  std::optional<Refusal> take(const WrenchCommand& command, Moment& moment, Reply& reply);
  std::optional<Refusal> hold(const WrenchCommand& command, const Moment& moment,
                              Eigen::Index column, Reply& reply);
  void clear(const WrenchCommand& command, std::optional<Eigen::Index> column, Reply& reply);
  static void add_to(HeldWrench& sum, const Held& held);

  double frame_rate_;              // [Hz]
  std::vector<Held> held_;         // sorted by (client, seq) since the last apply_to
  bool changed_ = true;            // since the last apply_to
  std::uint64_t next_change_ = 0;  // first frame in which a held wrench starts or has ended
};

}  // namespace poinsot
