#include "poinsot/runner/run_offline.h"

#include <optional>
#include <stdexcept>
#include <utility>

#include "poinsot/base/error.h"
#include "poinsot/runner/command_log.h"
#include "poinsot/runner/log_reader.h"
#include "poinsot/runner/replay.h"
#include "poinsot/runner/trajectory.h"

namespace poinsot {
namespace {

class OfflineRun {
 public:
  OfflineRun(Scene scene, const OfflineOptions& options)
      : options_(options), layer_(std::move(scene)) {
    if (!options.commands.empty()) {
      commands_.emplace(options.commands);
      if (commands_->header().frame != 0)
        throw Error(options.commands.string() + ": begins at frame " +
                    std::to_string(commands_->header().frame) +
                    ", not with a scene: poinsotd replay runs it");
      player_.emplace(*commands_, layer_);
    }
    if (!options.trajectory.empty()) {
      trajectory_.emplace(options.trajectory, layer_.world(), layer_.frame_rate());
      trajectory_->write(layer_.world(), 0);
    }
    if (!options.record.empty()) {
      record_.emplace(LogStart{.file = options.record,
                               .world = layer_.scene().world,
                               .checkpoint = layer_.make_checkpoint(""),
                               .replace = true});
      if (player_) player_->record_to(&*record_);
      if (!record_->wait_until_open()) throw Error("--record: " + record_->failure());
    }
  }

  RunSummary run(std::stop_token stop) {
    Elapsed elapsed;
    std::uint64_t frames = 0;
    {
      const Stopwatch::Lap lap(elapsed);
      while (!stop.stop_requested() && (options_.frames == 0 || frames < options_.frames)) {
        if (!advance()) break;
        ++frames;
        if (trajectory_) trajectory_->write(layer_.world(), layer_.frame());
        if (!record_) continue;
        record_->frame(layer_.frame(), layer_.snapshot().state_hash);
        record_->wait_for_room();
      }
    }
    if (trajectory_) trajectory_->close();
    if (record_ && !record_->close()) throw std::runtime_error(record_->failure());
    return summarize(layer_, frames, elapsed.wall_s, {});
  }

 private:
  // False: the log of the commands has ended, and with it the run.
  bool advance() {
    if (player_) {
      if (player_->advance()) return true;
      if (options_.frames == 0) return false;
      player_.reset();
    }
    layer_.advance_frame();
    return true;
  }

  const OfflineOptions& options_;
  PresentationLayer layer_;
  std::optional<CommandLogReader> commands_;
  std::optional<LogPlayer> player_;
  std::optional<Trajectory> trajectory_;
  std::optional<CommandLogWriter> record_;
};

}  // namespace

RunSummary run_offline(Scene scene, const OfflineOptions& options, std::stop_token stop) {
  return OfflineRun(std::move(scene), options).run(std::move(stop));
}

}  // namespace poinsot
