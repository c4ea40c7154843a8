// The presentation layer: the run as the outside sees it, in fixed frames. Commands enter and poses
// leave only between frames; frame n ends at exactly n / frame_rate.

#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "poinsot/base/stopwatch.h"
#include "poinsot/collision/collision_layer.h"
#include "poinsot/presentation/checkpoint.h"
#include "poinsot/presentation/checkpoint_ring.h"
#include "poinsot/presentation/held_wrenches.h"
#include "poinsot/presentation/living_scene.h"
#include "poinsot/presentation/order.h"
#include "poinsot/presentation/state_hash.h"
#include "poinsot/protocol/contact_snapshot.h"
#include "poinsot/protocol/frame_report.h"
#include "poinsot/protocol/held_list.h"
#include "poinsot/protocol/impact_notice.h"
#include "poinsot/protocol/pose_snapshot.h"

namespace poinsot {

class PresentationLayer {
 public:
  // The scene must be valid (validate()).
  explicit PresentationLayer(Scene scene);

  // Before the commands and orders of a turn, unless a frame was advanced since the last.
  void begin_turn();

  // Takes commands for the frames to come, paused or not. Appends one reply per command, in order.
  // The commands are sorted by (client, seq).
  void accept(std::span<const WrenchCommand> commands, std::vector<Reply>& replies);

  // Does at once what the physics has to know of: reset, spawn, remove, set_state, save (to
  // memory), restore, release. Other actions are the loop's. Between frames, in the order (client,
  // seq) among the wrenches of the same turn.
  Reply obey(const Order& order);
  // What was last saved by save.
  std::shared_ptr<const Checkpoint> last_saved() const { return ring_.newest(); }
  // All that a continuation needs, now. Named by frame and epoch.
  std::shared_ptr<const Checkpoint> make_checkpoint(std::string name) const;
  // Goes on from there, in the next epoch. Throws Error if the bytes are damaged; the run is then
  // as it was.
  void restore(const Checkpoint& checkpoint);
  std::size_t checkpoints() const { return ring_.size(); }  // in memory
  // Of those; of no name: the newest. Nothing if there is none.
  std::shared_ptr<const Checkpoint> find_checkpoint(std::string_view name) const {
    return ring_.find(name);
  }

  // Advances to the end of the next frame.
  void advance_frame();

  // Back to frame 0 of the scene, in the next epoch, with the hashes of a fresh start.
  void reset();

  std::uint64_t frame() const { return frame_; }  // the last one advanced; 0: the initial state
  std::uint32_t epoch() const { return epoch_; }  // from 1, grows with each reset
  double frame_rate() const { return scene().presentation.frame_rate; }  // [Hz]
  double time() const { return collision_.time(); }                      // [s] frame / frame_rate
  // As it is now, with absent bodies: places that nobody has. In the order of the slots.
  const Scene& scene() const { return scene_.now(); }
  const World& world() const { return collision_.world(); }

  // The dynamic bodies at the end of the last frame, with its hash. session and publish_time_ns are
  // left to whoever sends it.
  const PoseSnapshot& snapshot() const { return snapshot_; }
  const FrameReport& report() const { return report_; }
  const CollisionReport& collision_report() const { return collision_.report(); }
  // What moved each dynamic body in the last frame, in the order of the snapshot.
  std::span<const Method> body_methods() const { return body_methods_; }
  // Located in the last frame. session is left to whoever sends them.
  std::span<const ImpactNotice> impacts() const { return impacts_; }
  LayerTimes times() const;  // since construction, over all epochs

  // From 1; another one when bodies came, went, or static ones were moved.
  std::uint32_t scene_revision() const { return scene_.revision(); }
  // Of all kinds that are there.
  std::uint32_t scene_bodies() const { return static_cast<std::uint32_t>(scene_.bodies()); }
  // Computed when asked for; session and sequence are left to whoever sends them.
  void contacts(ContactSnapshot& contacts) const;
  void held(HeldList& list) const;
  // Another one when held() would tell of other items.
  std::uint64_t held_revision() const { return held_.revision(); }
  std::size_t held_count() const { return held_.size(); }
  std::uint32_t held_by(std::uint64_t client) const {
    return static_cast<std::uint32_t>(held_.held_by(client));
  }

 private:
  void hold_scene_wrenches();
  void follow_scene();
  void capture();
  void capture_impacts();
  void refresh();
  void refresh_report();

  std::optional<Refusal> carry_out(const Order& order, Reply& reply);
  std::optional<Refusal> spawn(const Order& order, Reply& reply);
  std::optional<Refusal> remove(const RunControl& control, Reply& reply);
  std::optional<Refusal> set_state(const RunControl& control, Reply& reply);
  std::optional<Refusal> save(const RunControl& control, Reply& reply);
  std::optional<Refusal> restore(const Order& order);
  std::optional<Refusal> find(const RunControl& control, Eigen::Index& column, Reply& reply);
  void remove_body(Eigen::Index i);

  void reset(std::uint8_t scope);
  void return_to_start(Eigen::Index i);
  void begin_again(bool with_state);
  void next_epoch();

  LivingScene scene_;
  CollisionLayer collision_;
  HeldWrenches held_;
  Suggestions suggestions_;  // left in this turn
  std::uint64_t frame_ = 0;
  std::uint32_t epoch_ = 1;
  PoseSnapshot snapshot_;
  FrameReport report_;
  std::vector<Method> body_methods_;
  std::vector<ImpactNotice> impacts_;
  std::uint64_t impacts_so_far_ = 0;   // in this epoch
  std::vector<Eigen::Index> columns_;  // of the snapshot's bodies
  // Per body of the snapshot: the stamp of the course with which it fell asleep and was captured;
  // 0: it is awake.
  std::vector<std::uint32_t> captured_asleep_;
  BodyDigests digests_;
  CheckpointRing ring_;
  mutable std::vector<ContactForce> contact_forces_;  // scratch of contacts()
  LayerTimes times_;  // own time, and the inner layers' before the last reset
};

}  // namespace poinsot
