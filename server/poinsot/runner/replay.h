// Replay: a recorded run again, frame by frame. The same program gives the same hashes, whatever
// the number of threads and however fast it goes; what differs has a name and a frame.

#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "poinsot/presentation/presentation_layer.h"
#include "poinsot/runner/command_log.h"
#include "poinsot/runner/log_reader.h"

namespace poinsot {

// Leads a layer through a log.
class LogPlayer {
 public:
  // The layer stands where the log begins; both outlive the player. Restores bring the number of
  // threads of their scenes along, unless `threads` says another.
  LogPlayer(CommandLogReader& log, PresentationLayer& layer, int threads = 0)
      : log_(log),
        layer_(layer),
        threads_(threads),
        epochs_later_(layer.epoch() - log.header().epoch) {}

  // Does what the log says up to its next frame and advances to it. What was recorded of that
  // frame; nothing: the log has ended.
  std::optional<FrameRecord> advance();

  // Whatever is done to the layer is then written there as well.
  void record_to(CommandLogWriter* record) { record_ = record; }

  std::uint64_t commands() const { return commands_; }
  std::uint64_t refused() const { return refused_; }

 private:
  void play(TurnRecord turn);

  CommandLogReader& log_;
  PresentationLayer& layer_;
  int threads_;
  std::uint32_t epochs_later_;  // modulo 2³²
  CommandLogWriter* record_ = nullptr;
  std::vector<Reply> replies_;
  std::uint64_t commands_ = 0, refused_ = 0;
};

struct ReplayOptions {
  int threads = 0;                        // 0: as the scene says
  std::filesystem::path trajectory = {};  // empty: none
};

struct ReplayResult {
  struct Difference {
    FrameRecord recorded, found;
    std::string where;  // "<file>:<line>"
  };
  std::uint64_t frames = 0;  // that were compared
  std::uint64_t commands = 0, refused = 0;
  std::optional<Difference> difference;  // the first; the replay ends there
  bool cut = false;                      // the log has lost its end
  bool stopped = false;
  double sim_time = 0;  // [s] of the frames
  double wall_s = 0;
};

// Throws Error for a log that cannot be read or is of another build.
ReplayResult replay(const std::filesystem::path& log, const ReplayOptions& options,
                    std::stop_token stop);

std::string to_text(const ReplayResult& result);
// One line, one object: frames, commands, refused, same, cut, sim_time, wall_s, and if a frame
// differs: first_difference {frame, recorded, found, where}.
std::string to_json(const ReplayResult& result);

}  // namespace poinsot
