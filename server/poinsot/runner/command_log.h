// The command log: all that a run was told, and the hash of every frame, so that it can be run
// again and compared bit for bit (replay.h). Text, one JSON object per line:
//
//   {"poinsot_log": 1, "build": …, "world": …, "frame": 120, "epoch": 1, "hash": "16 hex digits",
//    "checkpoint": "base64"}                             the first line: where the log begins
//   {"before": 121, "epoch": 1, "wrenches": […], "orders": […]}        a turn that had commands
//   {"checkpoint": 1, "bytes": "base64"}      before the first restore of it: "checkpoint": 1 there
//   {"frame": 121, "hash": "0123456789abcdef"}                         a frame that was advanced to
//   {"end": 480}                                         the last line, with the number of frames
//
// Numbers read back to the same bits. A log that was cut anywhere (the machine died, the disk was
// full) can be read up to its last whole line.

#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "poinsot/presentation/checkpoint.h"
#include "poinsot/runner/turn_record.h"

namespace poinsot {

struct LogStart {
  std::filesystem::path file;
  std::string world;
  std::shared_ptr<const Checkpoint> checkpoint;  // of the run now, before the first entry
  bool replace = false;                          // a file of this name; else it is refused
};

// Writes a log on a thread of its own. The loop only moves entries into a bounded queue; a full
// disk or a full queue ends the recording with a reason that can be asked for, and the run goes on.
//
//   CommandLogWriter log({file, world, layer.make_checkpoint("")});
//   TurnRecord turn{.before = layer.frame() + 1, .epoch = layer.epoch(), …};
//   apply_turn(turn, layer, replies);
//   log.turn(std::move(turn));  // after what it says is done, before the next frame
//   layer.advance_frame();
//   log.frame(layer.frame(), layer.snapshot().state_hash);
//   log.end();                                                          // or the destructor
class CommandLogWriter {
 public:
  enum class State : std::uint8_t {
    opening,  // the file is about to be created, with its directory
    writing,
    failed,  // see failure(); what was written is a log that was cut
    ended,
  };
  static constexpr std::size_t kEntries = 1u << 15;     // of the queue: frames and turns
  static constexpr std::size_t kTurns = 1u << 12;       // of these, turns at most
  static constexpr std::size_t kTurnBytes = 64u << 20;  // of these turns; checkpoints are shared

  explicit CommandLogWriter(LogStart start);
  ~CommandLogWriter();  // end(), and waits until all is on disk
  CommandLogWriter(const CommandLogWriter&) = delete;
  CommandLogWriter& operator=(const CommandLogWriter&) = delete;

  // From one thread, the loop's. Neither waits for the disk nor allocates. The state does not
  // change what they do: after a failure they do nothing.
  void turn(TurnRecord&& record) noexcept;
  void frame(std::uint64_t frame, std::uint64_t hash) noexcept;
  // For a caller with time: waits until the queue has room again. False: the log has failed.
  bool wait_for_room();

  // Takes no more entries; what is queued will be written and the file closed. Does not wait.
  void end() noexcept;
  // The same, and waits until all is on disk. False: the log has failed.
  bool close();

  // From any thread.
  State state() const;
  std::string failure() const;   // why it failed; empty as long as it has not
  bool wait_until_open() const;  // false: it has failed
  const std::filesystem::path& file() const { return start_.file; }

 private:
  struct Entry {
    FrameRecord frame;
    std::int32_t turn = -1;  // index into turns; -1: a frame
  };
  struct Queue {
    std::vector<Entry> entries;
    std::vector<TurnRecord> turns;
    std::size_t turn_bytes = 0;
  };

  // With the mutex.
  bool takes_more() const;
  bool has_room() const;
  void push(const Entry& entry) noexcept;
  void overflow() noexcept;

  void run();
  std::string write();  // the reason of a failure, or nothing
  bool take(Queue& queue);
  void set_state(State state, const std::string& failure);

  const LogStart start_;
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  Queue queue_;
  State state_ = State::opening;
  bool ending_ = false;
  bool overflowed_ = false;
  std::string failure_;
  std::thread thread_;
};

}  // namespace poinsot
