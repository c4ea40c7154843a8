// Command inbox: hands commands from the threads that receive them to the loop, which takes all
// that have come at once, between two frames. Bounded: a full inbox refuses and counts, and one
// client alone cannot fill it. No side waits for the other longer than it takes to move one
// element.

#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <stop_token>
#include <utility>
#include <vector>

#include "poinsot/presentation/order.h"
#include "poinsot/protocol/wrench_command.h"

namespace poinsot {

class CommandInbox {
 public:
  // Of each kind, so that a flood of pushes cannot shut out a pause.
  static constexpr std::size_t kWrenches = 2048;
  static constexpr std::size_t kOrders = 256;
  // Of that, what one client may take.
  static constexpr std::size_t kShare = 2;  // a half

  struct Batch {
    std::vector<WrenchCommand> wrenches;
    std::vector<Order> orders;
    // From within the daemon: orders whose checkpoint has been read from disk, releases of clients
    // that are gone (see kOwnSeq), and answers to orders that waited for the disk.
    std::vector<Order> own;
    std::vector<Reply> results;

    Batch();
    bool empty() const {
      return wrenches.empty() && orders.empty() && own.empty() && results.empty();
    }
    void clear();
  };

  // From any thread. False: full, not taken.
  bool push(WrenchCommand command);
  bool push(Order order);
  bool push(RunControl control) { return push(Order{.control = std::move(control)}); }

  // From any thread: whether such a command waits to be taken.
  bool waits(std::uint64_t client, std::uint64_t seq) const;

  // From within the daemon: never refused; as many as clients and jobs are allowed.
  void push_own(Order order);
  void push_result(Reply reply);

  // From any thread: the loop is to look after something else; its wait ends.
  void nudge();

  // From the loop: everything that has come since the last call, in order of arrival. What `batch`
  // held before is gone; its memory goes back into use.
  void take(Batch& batch);

  // From the loop: blocks until there is something to take or a nudge (true), the time [ns] of the
  // steady clock has come, or the stop (false).
  bool wait(const std::stop_token& stop, std::int64_t until = INT64_MAX);

  // A command that never got here: it could not be read, or was one too many of its client.
  void count_refused();

  std::uint64_t full() const;     // commands that found no room
  std::uint64_t refused() const;  // the same and those that never got here

 private:
  // How many of the commands that wait are whose.
  struct Shares {
    std::vector<std::pair<std::uint64_t, std::size_t>> of;
    std::size_t& operator[](std::uint64_t client);
  };

  template <class Command>
  bool push(Command&& command, std::vector<Command>& queue, Shares& shares, std::size_t capacity);

  mutable std::mutex mutex_;
  std::condition_variable_any arrived_;
  Batch pending_;
  bool nudged_ = false;
  Shares wrench_shares_, order_shares_;
  std::uint64_t full_ = 0;
  std::uint64_t never_got_here_ = 0;
};

// The number of orders that the daemon gives itself on behalf of a client that is gone, not for
// clients to use. Order::after tells which of its commands came before.
inline constexpr std::uint64_t kOwnSeq = UINT64_MAX;

}  // namespace poinsot
