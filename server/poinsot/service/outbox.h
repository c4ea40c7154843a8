// Outbox: hands what leaves the daemon from the loop to the thread that writes it to the bus. The
// loop never waits: snapshots go through a ring whose oldest is dropped and counted when the writer
// is slow; replies through a bounded queue (a reply that is lost there is asked for again by its
// client); impacts likewise, counted when lost; changes of the scene are never lost; of reports,
// contacts and what is held only the newest counts.
//
// While nobody reads poses the ring holds only the newest snapshot, and the writer is not woken.
// While nobody reads impacts, contacts or what is held, none is taken.

#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <span>
#include <stop_token>
#include <vector>

#include "poinsot/protocol/contact_snapshot.h"
#include "poinsot/protocol/frame_report.h"
#include "poinsot/protocol/held_list.h"
#include "poinsot/protocol/impact_notice.h"
#include "poinsot/protocol/pose_snapshot.h"
#include "poinsot/protocol/wrench_command.h"
#include "poinsot/service/scene_changes.h"

namespace poinsot {

class Outbox {
 public:
  static constexpr std::size_t kSnapshots = 8;
  static constexpr std::size_t kReplies = 4096;  // more than both inbox queues together
  static constexpr std::size_t kImpacts = 4096;

  // Room for snapshots and reports of so many bodies is made beforehand.
  // `wanted` is called, by the writer's thread, when something that the loop has is wanted from now
  // on and may be asked for at once: a paused loop has no next frame.
  explicit Outbox(std::size_t bodies, std::function<void()> wanted = {});

  std::size_t bodies() const { return bodies_; }  // that there was room for at the start

  // From the loop, replies from any thread.
  void push(const PoseSnapshot& snapshot);
  void push(std::span<const ImpactNotice> impacts);  // of one frame
  void push(Reply reply);
  void push(const RunReport& report);
  void push(SceneChange change);
  // Contents are exchanged: the memory of an older one comes back.
  void swap_in(ContactSnapshot& contacts);
  void swap_in(HeldList& held);
  bool contacts_wanted() const { return contacts_wanted_; }
  bool held_wanted() const { return held_wanted_; }

  // From the writer. take() exchanges contents, false: nothing there; wait() ends with something to
  // take, after the time-out, or with the stop; true: there is something.
  bool wait(const std::stop_token& stop, std::chrono::nanoseconds timeout);
  bool take(PoseSnapshot& snapshot);
  bool take(std::vector<Reply>& replies);
  bool take(RunReport& report);
  bool take(std::vector<ImpactNotice>& impacts);
  bool take(SceneChange& change);
  bool take(ContactSnapshot& contacts);
  bool take(HeldList& held);
  void set_poses_wanted(bool wanted);
  void set_impacts_wanted(bool wanted);
  void set_contacts_wanted(bool wanted) { set_wanted(contacts_wanted_, wanted); }
  void set_held_wanted(bool wanted) { set_wanted(held_wanted_, wanted); }

  RunReport newest_report() const;  // taken or not
  std::uint64_t snapshots_dropped() const;
  std::uint64_t replies_dropped() const;
  std::uint64_t impacts_dropped() const;

 private:
  bool anything_to_send() const;
  void set_wanted(std::atomic<bool>& flag, bool wanted);

  std::size_t bodies_;
  mutable std::mutex mutex_;
  std::condition_variable_any filled_;
  std::array<PoseSnapshot, kSnapshots> ring_;
  std::size_t oldest_ = 0;  // place in the ring
  std::size_t count_ = 0;
  bool poses_wanted_ = false;
  std::vector<Reply> replies_;
  std::vector<ImpactNotice> impacts_;
  std::atomic<bool> impacts_wanted_ = false;  // looked at without the mutex
  RunReport report_;
  bool report_is_new_ = false;
  SceneChange scene_;
  ContactSnapshot contacts_;
  HeldList held_;
  bool contacts_are_new_ = false, held_is_new_ = false;
  std::atomic<bool> contacts_wanted_ = false, held_wanted_ = false;
  std::function<void()> on_wanted_;
  std::uint64_t snapshots_dropped_ = 0;
  std::uint64_t replies_dropped_ = 0;
  std::uint64_t impacts_dropped_ = 0;
};

}  // namespace poinsot
