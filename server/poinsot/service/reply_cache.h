// Reply cache: a command that comes again, with the same (client, seq), gets the reply it got
// before and is not obeyed again; while its reply is still to come, it is known to be under way.
// Bounded: the oldest replies are forgotten.

#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <set>
#include <utility>

#include "poinsot/protocol/wrench_command.h"

namespace poinsot {

class ReplyCache {
 public:
  // A client resends within a second: that is 60 frames with a full inbox each.
  static constexpr std::size_t kCapacity = 65536;

  // The reply to (client, seq); nothing if it is not known (any more).
  const Reply* find(std::uint64_t client, std::uint64_t seq) const {
    const auto found = replies_.find({client, seq});
    return found == replies_.end() ? nullptr : &found->second;
  }

  void insert(const Reply& reply) {
    const Key key{reply.client, reply.seq};
    under_way_.erase(key);
    if (!replies_.try_emplace(key, reply).second) return;
    order_.push_back(key);
    if (order_.size() <= kCapacity) return;
    replies_.erase(order_.front());
    order_.pop_front();
  }

  // Its reply will be inserted later.
  void expect(std::uint64_t client, std::uint64_t seq) { under_way_.emplace(client, seq); }
  bool is_under_way(std::uint64_t client, std::uint64_t seq) const {
    return !under_way_.empty() && under_way_.contains({client, seq});
  }

  std::size_t size() const { return replies_.size(); }

 private:
  using Key = std::pair<std::uint64_t, std::uint64_t>;  // client, seq

  std::map<Key, Reply> replies_;
  std::deque<Key> order_;  // of insertion
  std::set<Key> under_way_;
};

}  // namespace poinsot
