// The lines of a command log, see command_log.h. Private to this module.

#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "poinsot/presentation/checkpoint.h"
#include "poinsot/runner/command_log.h"
#include "poinsot/runner/turn_record.h"

namespace poinsot {

inline constexpr int kLogFormat = 1;

class LogLines {
 public:
  static std::string first(const LogStart& start);
  void add(const TurnRecord& turn, std::string& text);
  static void add(const FrameRecord& frame, std::string& text);
  static std::string last(std::uint64_t frames);

 private:
  // A checkpoint is written once; later restores of it name it by its number.
  std::uint64_t number_of(const std::shared_ptr<const Checkpoint>& checkpoint, std::string& text);

  std::vector<std::pair<std::weak_ptr<const Checkpoint>, std::uint64_t>> written_;
  std::uint64_t checkpoints_ = 0;
};

}  // namespace poinsot
