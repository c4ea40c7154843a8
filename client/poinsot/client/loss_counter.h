// Counts the samples of a stream that are missing, by their sequence numbers.

#pragma once

#include <algorithm>
#include <cstdint>

namespace poinsot {

class LossCounter {
 public:
  // A daemon that was started again (another session) counts anew.
  void add(std::uint64_t session, std::uint64_t sequence) {
    if (session == session_ && sequence > sequence_) lost_ += sequence - sequence_ - 1;
    sequence_ = session == session_ ? std::max(sequence_, sequence) : sequence;
    session_ = session;
  }

  std::uint64_t lost() const { return lost_; }

 private:
  std::uint64_t session_ = 0, sequence_ = 0, lost_ = 0;
};

}  // namespace poinsot
