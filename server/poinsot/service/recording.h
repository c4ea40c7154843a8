// Recording: the command log of a run as its loop sees it. Begins with a checkpoint made between
// frames; then each turn that had commands, as they were handed to the layer, and each frame. The
// writing itself is the writer's thread.

#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "poinsot/runner/command_log.h"

namespace poinsot {

class Recording {
 public:
  bool active() const { return log_ != nullptr; }
  const std::string& name() const { return name_; }  // empty: none
  bool failed() const { return log_ && log_->state() == CommandLogWriter::State::failed; }

  // From here on; `next` is the frame that will be advanced next.
  void begin(std::string name, std::shared_ptr<CommandLogWriter> log, std::uint64_t next,
             std::uint32_t epoch);
  // Takes no more. The last to let go of the writer waits for the disk.
  std::shared_ptr<CommandLogWriter> end();

  // A turn of the loop, and within it what is handed to the layer, in that order.
  void begin_turn(std::uint64_t next, std::uint32_t epoch);
  void note(std::span<const WrenchCommand> wrenches);
  void note(const Order& order);
  void end_turn();

  void frame(std::uint64_t frame, std::uint64_t hash);

 private:
  std::string name_;
  std::shared_ptr<CommandLogWriter> log_;
  TurnRecord turn_;
};

}  // namespace poinsot
