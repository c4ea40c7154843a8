// Command inbox: hands commands from the threads that receive them to the loop, which takes all
// that have come at once, between two frames. Bounded: a full inbox refuses and counts. No side
// waits for the other longer than it takes to move one element.

#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <stop_token>
#include <vector>

#include "poinsot/protocol/run_control.h"
#include "poinsot/protocol/wrench_command.h"

namespace poinsot {

class CommandInbox {
 public:
  // Of each kind, so that a flood of pushes cannot shut out a pause.
  static constexpr std::size_t kCapacity = 1024;

  struct Batch {
    std::vector<WrenchCommand> wrenches;
    std::vector<RunControl> controls;

    Batch() {
      wrenches.reserve(kCapacity);
      controls.reserve(kCapacity);
    }
    bool empty() const { return wrenches.empty() && controls.empty(); }
    void clear() {
      wrenches.clear();
      controls.clear();
    }
  };

  // From any thread. False: full, not taken.
  bool push(WrenchCommand command);
  bool push(RunControl control);

  // From the loop: everything that has come since the last call, in order of arrival. What `batch`
  // held before is gone; its memory goes back into use.
  void take(Batch& batch);

  // From the loop: blocks until there is something to take (true) or the stop (false).
  bool wait(const std::stop_token& stop);

  // A command that never got here: it could not be read.
  void count_malformed();

  std::uint64_t full() const;     // commands that found no room
  std::uint64_t refused() const;  // the same and the malformed ones

 private:
  template <class Command>
  bool push(Command&& command, std::vector<Command>& queue);

  mutable std::mutex mutex_;
  std::condition_variable_any arrived_;
  Batch pending_;
  std::uint64_t full_ = 0;
  std::uint64_t malformed_ = 0;
};

}  // namespace poinsot
