// The presentation layer: the run as the outside sees it, in fixed frames. Commands enter and poses
// leave only between frames; frame n ends at exactly n / frame_rate.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "poinsot/base/stopwatch.h"
#include "poinsot/collision/collision_layer.h"
#include "poinsot/presentation/held_wrenches.h"
#include "poinsot/presentation/state_hash.h"
#include "poinsot/protocol/frame_report.h"
#include "poinsot/protocol/impact_notice.h"
#include "poinsot/protocol/pose_snapshot.h"

namespace poinsot {

class PresentationLayer {
 public:
  // The scene must be valid (validate()).
  explicit PresentationLayer(Scene scene);

  // Takes commands for the frames to come, paused or not. Appends one reply per command, in order.
  // The commands are sorted by (client, seq).
  void accept(std::span<const WrenchCommand> commands, std::vector<Reply>& replies);

  // Advances to the end of the next frame.
  void advance_frame();

  // Back to frame 0 of the scene, in the next epoch, with the hashes of a fresh start.
  void reset();

  std::uint64_t frame() const { return frame_; }  // the last one advanced; 0: the initial state
  std::uint32_t epoch() const { return epoch_; }  // from 1, grows with each reset
  double frame_rate() const { return scene_.presentation.frame_rate; }  // [Hz]
  double time() const { return collision_.time(); }                     // [s] frame / frame_rate
  const Scene& scene() const { return scene_; }
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

 private:
  void hold_scene_wrenches();
  void capture();
  void capture_impacts();

  Scene scene_;
  CollisionLayer collision_;
  HeldWrenches held_;
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
  LayerTimes times_;  // own time, and the inner layers' before the last reset
};

}  // namespace poinsot
