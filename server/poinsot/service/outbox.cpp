#include "poinsot/service/outbox.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace poinsot {

Outbox::Outbox(std::size_t bodies, std::function<void()> wanted)
    : bodies_(bodies), on_wanted_(std::move(wanted)) {
  for (PoseSnapshot& snapshot : ring_) snapshot.bodies.reserve(bodies);
  replies_.reserve(kReplies);
  impacts_.reserve(kImpacts);
  report_.body_methods.reserve(bodies);
}

void Outbox::push(const PoseSnapshot& snapshot) {
  bool wake;
  {
    const std::lock_guard lock(mutex_);
    wake = poses_wanted_;
    if (!poses_wanted_) count_ = 0;
    if (count_ == kSnapshots) {
      oldest_ = (oldest_ + 1) % kSnapshots;
      --count_;
      ++snapshots_dropped_;
    }
    ring_[(oldest_ + count_) % kSnapshots] = snapshot;
    ++count_;
  }
  if (wake) filled_.notify_one();
}

void Outbox::push(std::span<const ImpactNotice> impacts) {
  if (impacts.empty() || !impacts_wanted_) return;
  {
    const std::lock_guard lock(mutex_);
    const std::size_t room = std::min(kImpacts - impacts_.size(), impacts.size());
    impacts_dropped_ += impacts.size() - room;
    impacts = impacts.first(room);
    impacts_.insert(impacts_.end(), impacts.begin(), impacts.end());
  }
  filled_.notify_one();
}

void Outbox::push(Reply reply) {
  {
    const std::lock_guard lock(mutex_);
    if (replies_.size() >= kReplies) {
      ++replies_dropped_;
      return;
    }
    replies_.push_back(std::move(reply));
  }
  filled_.notify_one();
}

void Outbox::push(const RunReport& report) {
  {
    const std::lock_guard lock(mutex_);
    report_ = report;
    report_is_new_ = true;
  }
  filled_.notify_one();
}

void Outbox::push(SceneChange change) {
  if (change.empty()) return;
  {
    const std::lock_guard lock(mutex_);
    if (scene_.empty()) {
      scene_ = std::move(change);
    } else {
      // What came and is gone again before it was sent is not told as new.
      std::vector<BodyId> gone = change.removed;
      std::ranges::sort(gone);
      std::erase_if(scene_.added, [&gone](const BodyInfo& body) {
        return std::ranges::binary_search(gone, body.id);
      });
      scene_.removed.insert(scene_.removed.end(), change.removed.begin(), change.removed.end());
      std::ranges::move(change.added, std::back_inserter(scene_.added));
    }
  }
  filled_.notify_one();
}

void Outbox::swap_in(ContactSnapshot& contacts) {
  {
    const std::lock_guard lock(mutex_);
    std::swap(contacts_, contacts);
    contacts_are_new_ = true;
  }
  filled_.notify_one();
}

void Outbox::swap_in(HeldList& held) {
  {
    const std::lock_guard lock(mutex_);
    std::swap(held_, held);
    held_is_new_ = true;
  }
  filled_.notify_one();
}

bool Outbox::anything_to_send() const {
  return (poses_wanted_ && count_ > 0) || !replies_.empty() || !impacts_.empty() ||
         report_is_new_ || !scene_.empty() || contacts_are_new_ || held_is_new_;
}

bool Outbox::wait(const std::stop_token& stop, std::chrono::nanoseconds timeout) {
  std::unique_lock lock(mutex_);
  return filled_.wait_for(lock, stop, timeout, [&] { return anything_to_send(); });
}

bool Outbox::take(PoseSnapshot& snapshot) {
  const std::lock_guard lock(mutex_);
  if (count_ == 0) return false;
  std::swap(snapshot, ring_[oldest_]);
  oldest_ = (oldest_ + 1) % kSnapshots;
  --count_;
  return true;
}

bool Outbox::take(std::vector<Reply>& replies) {
  replies.clear();
  const std::lock_guard lock(mutex_);
  std::swap(replies, replies_);
  return !replies.empty();
}

bool Outbox::take(RunReport& report) {
  const std::lock_guard lock(mutex_);
  report = report_;
  return std::exchange(report_is_new_, false);
}

bool Outbox::take(std::vector<ImpactNotice>& impacts) {
  impacts.clear();
  const std::lock_guard lock(mutex_);
  std::swap(impacts, impacts_);
  return !impacts.empty();
}

bool Outbox::take(SceneChange& change) {
  change = {};
  const std::lock_guard lock(mutex_);
  std::swap(change, scene_);
  return !change.empty();
}

bool Outbox::take(ContactSnapshot& contacts) {
  const std::lock_guard lock(mutex_);
  if (!std::exchange(contacts_are_new_, false)) return false;
  std::swap(contacts, contacts_);
  return true;
}

bool Outbox::take(HeldList& held) {
  const std::lock_guard lock(mutex_);
  if (!std::exchange(held_is_new_, false)) return false;
  std::swap(held, held_);
  return true;
}

void Outbox::set_wanted(std::atomic<bool>& flag, bool wanted) {
  if (flag.exchange(wanted) != wanted && on_wanted_) on_wanted_();
}

void Outbox::set_poses_wanted(bool wanted) {
  const std::lock_guard lock(mutex_);
  poses_wanted_ = wanted;
}

void Outbox::set_impacts_wanted(bool wanted) {
  impacts_wanted_ = wanted;
}

RunReport Outbox::newest_report() const {
  const std::lock_guard lock(mutex_);
  return report_;
}

std::uint64_t Outbox::snapshots_dropped() const {
  const std::lock_guard lock(mutex_);
  return snapshots_dropped_;
}

std::uint64_t Outbox::impacts_dropped() const {
  const std::lock_guard lock(mutex_);
  return impacts_dropped_;
}

std::uint64_t Outbox::replies_dropped() const {
  const std::lock_guard lock(mutex_);
  return replies_dropped_;
}

}  // namespace poinsot
