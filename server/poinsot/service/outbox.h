// Outbox: hands snapshots, replies and reports from the loop to the thread that writes them to the
// bus. The loop never waits: snapshots go through a ring whose oldest is dropped and counted when
// the writer is slow; replies through a bounded queue (a reply that is lost there is asked for
// again by its client); impacts likewise, counted when lost; of reports only the newest counts.
//
// While nobody reads poses the ring holds only the newest snapshot, and the writer is not woken.
// While nobody reads impacts none is taken.

#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <span>
#include <stop_token>
#include <vector>

#include "poinsot/protocol/frame_report.h"
#include "poinsot/protocol/impact_notice.h"
#include "poinsot/protocol/pose_snapshot.h"
#include "poinsot/protocol/wrench_command.h"

namespace poinsot {

class Outbox {
 public:
  static constexpr std::size_t kSnapshots = 8;
  static constexpr std::size_t kReplies = 4096;  // more than both inbox queues together
  static constexpr std::size_t kImpacts = 4096;

  // Room for snapshots and reports of so many bodies is made beforehand.
  explicit Outbox(std::size_t bodies);

  // From the loop, replies from any thread.
  void push(const PoseSnapshot& snapshot);
  void push(std::span<const ImpactNotice> impacts);  // of one frame
  void push(Reply reply);
  void push(const RunReport& report);

  // From the writer. take() exchanges contents, false: nothing there; wait() ends with something to
  // take, after the time-out, or with the stop; true: there is something.
  bool wait(const std::stop_token& stop, std::chrono::nanoseconds timeout);
  bool take(PoseSnapshot& snapshot);
  bool take(std::vector<Reply>& replies);
  bool take(RunReport& report);
  bool take(std::vector<ImpactNotice>& impacts);
  void set_poses_wanted(bool wanted);
  void set_impacts_wanted(bool wanted);

  RunReport newest_report() const;  // taken or not
  std::uint64_t snapshots_dropped() const;
  std::uint64_t replies_dropped() const;
  std::uint64_t impacts_dropped() const;

 private:
  bool anything_to_send() const;

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
  std::uint64_t snapshots_dropped_ = 0;
  std::uint64_t replies_dropped_ = 0;
  std::uint64_t impacts_dropped_ = 0;
};

}  // namespace poinsot
