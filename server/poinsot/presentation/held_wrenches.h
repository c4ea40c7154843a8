// Held wrenches: what clients and the scene push, from the frame that accepts a command to its last
// frame of effect. A zero-order hold: within a frame nothing changes.
//
// Accepting resolves everything that depends on the moment: the body becomes a column, a point
// becomes body-fixed, a duration becomes a first and a last frame. Applying only adds up, in the
// order (client, seq), so that the sums do not depend on the order of arrival. Nothing is computed
// in a frame in which no wrench starts, ends or is cleared, and only for the kinds that are
// concerned.

#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "poinsot/base/archive.h"
#include "poinsot/base/hash.h"
#include "poinsot/base/limits.h"
#include "poinsot/collision/collision_layer.h"
#include "poinsot/presentation/body_search.h"
#include "poinsot/presentation/held_of_client.h"
#include "poinsot/protocol/held_list.h"
#include "poinsot/protocol/wrench_command.h"

namespace poinsot {

// Frames that a duration [s] of simulated time takes: rounded up, at least one. The slack of 1e-6
// of a frame keeps 0.5 s at 60 Hz at 30 frames whatever the last bit says.
std::uint64_t frames_of(double duration, double frame_rate);

class HeldWrenches {
 public:
  // The most wrenches that can be held at once, by the scene and all clients together.
  static constexpr std::size_t kCapacity = kMaxHeldWrenches;

  explicit HeldWrenches(double frame_rate, std::uint64_t revision = 0);

  // Appends one reply per command, in order. The commands are sorted by (client, seq); `next` is
  // the frame that will be advanced next, `epoch` the run's.
  void accept(std::span<const WrenchCommand> commands, const World& world, std::uint64_t next,
              std::uint32_t epoch, Suggestions& suggestions, std::vector<Reply>& replies);
  // Ends, from the next frame on, what the client holds and what does not outlive it.
  // The scene never leaves.
  void release(std::uint64_t client, std::uint64_t next);
  // All that clients hold goes; the scene's stays.
  void release_all_clients();
  // What is held on a body that goes. To be called while it is still there.
  void remove_body(Eigen::Index column, CollisionLayer& collision);

  // After a frozen body was set and moves again: the layer may have left its tethers out meanwhile.
  void hand_on_again(CollisionLayer& collision) const;

  // Whether what is held in `frame` differs from what was last applied; if not, apply_to() has
  // nothing to do.
  bool changes(std::uint64_t frame) const;
  // Before `frame` is advanced: gives the layer the forces and tethers of that frame, and the kicks
  // at its start.
  void apply_to(CollisionLayer& collision, std::uint64_t frame);
  // After it: forgets what has ended with it.
  void end_frame(std::uint64_t frame) { sweep(frame + 1); }

  // Adds what the frames to come depend on.
  void hash_into(Hash64& hash) const;

  std::size_t size() const { return size_; }
  std::size_t held_by(std::uint64_t client) const;
  // Another one when list() would tell something else.
  std::uint64_t revision() const { return revision_; }
  // In the order (client, seq); replaces the items.
  void list(HeldList& list, const World& world) const;

  void save(ByteWriter& out) const;
  // Throws Error if the bytes are damaged, or speak of more bodies than there are columns.
  void restore(ByteReader& in, Eigen::Index columns);

 private:
  struct Moment {  // of acceptance
    const World& world;
    std::uint64_t next;
    std::uint32_t epoch;
    Suggestions& suggestions;
  };

  std::optional<Refusal> take(const WrenchCommand& command, Moment& moment, Reply& reply);
  std::optional<Refusal> hold(const WrenchCommand& command, const Moment& moment,
                              Eigen::Index column, Reply& reply);
  std::optional<Refusal> check_room(const WrenchCommand& command, std::uint64_t first,
                                    std::uint64_t next) const;
  void end(std::uint64_t client, const Selection& selection, std::uint64_t frame,
           std::uint64_t next);
  void note_change(KindSet kinds, std::uint64_t frame);
  void sweep(std::uint64_t next);

  template <class Visit>
  void each_of(WrenchKind kind, Visit&& visit) const;
  void sum_forces(World& world, std::uint64_t frame);
  void set_tethers(CollisionLayer& collision, std::uint64_t frame);
  void kick(CollisionLayer& collision, std::uint64_t frame);
  std::uint64_t& due(WrenchKind kind) { return due_[static_cast<std::size_t>(kind)]; }

  double frame_rate_;  // [Hz]
  std::map<std::uint64_t, HeldOfClient> clients_;
  std::size_t size_ = 0;  // that are not over
  std::uint64_t revision_;
  std::uint64_t next_end_ = kForever;                 // first frame for which sweep() has work
  std::array<std::uint64_t, kWrenchKinds> due_ = {};  // per kind: frame of the next change
  std::vector<Eigen::Index> summed_;                  // columns with a sum in world.held
  bool sums_known_ = false;                           // summed_ names all of them
  std::vector<Tether> tethers_;                       // that the layer has …
  std::vector<Tether> next_tethers_;                  // … and shall have: scratch
};

}  // namespace poinsot
