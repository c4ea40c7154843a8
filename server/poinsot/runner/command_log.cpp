#include "poinsot/runner/command_log.h"

#include <cerrno>
#include <chrono>
#include <cstring>
#include <exception>
#include <system_error>
#include <utility>

#include "poinsot/runner/file_handle.h"
#include "poinsot/runner/log_lines.h"

namespace poinsot {
namespace {

// What is queued waits no longer than this for more to come.
constexpr std::chrono::milliseconds kPatience{100};
constexpr std::size_t kPart = 1u << 18;  // [bytes] of a write
constexpr mode_t kReadableByAll = 0644;

// About what a turn takes while it waits, without the checkpoints, which it shares.
std::size_t bytes_of(const TurnRecord& turn) {
  std::size_t bytes = sizeof turn;
  for (const WrenchCommand& wrench : turn.wrenches)
    bytes += sizeof wrench + wrench.body_name.size();
  for (const Order& order : turn.orders)
    bytes += sizeof order + order.control.text.size() + order.control.body_name.size();
  return bytes;
}

std::string reason(const std::filesystem::path& file, int error) {
  return "cannot write '" + file.string() + "': " + std::strerror(error);
}

}  // namespace

CommandLogWriter::CommandLogWriter(LogStart start) : start_(std::move(start)) {
  queue_.entries.reserve(kEntries);
  queue_.turns.reserve(kTurns);
  thread_ = std::thread([this] { run(); });
}

CommandLogWriter::~CommandLogWriter() {
  end();
  thread_.join();
}

// From the loop ----------------------------------------------------------------------------------

void CommandLogWriter::turn(TurnRecord&& record) noexcept {
  const std::size_t bytes = bytes_of(record);
  const std::scoped_lock lock(mutex_);
  if (!takes_more()) return;
  if (queue_.turns.size() == kTurns || queue_.turn_bytes + bytes > kTurnBytes) return overflow();
  queue_.turn_bytes += bytes;
  queue_.turns.push_back(std::move(record));
  push({.frame = {}, .turn = static_cast<std::int32_t>(queue_.turns.size() - 1)});
}

void CommandLogWriter::frame(std::uint64_t frame, std::uint64_t hash) noexcept {
  const std::scoped_lock lock(mutex_);
  if (takes_more()) push({.frame = {frame, hash}});
}

void CommandLogWriter::push(const Entry& entry) noexcept {
  if (queue_.entries.size() == kEntries) return overflow();
  queue_.entries.push_back(entry);
  if (queue_.entries.size() == 1 || queue_.entries.size() == kEntries / 2) changed_.notify_all();
}

void CommandLogWriter::overflow() noexcept {
  overflowed_ = true;
  changed_.notify_all();
}

void CommandLogWriter::end() noexcept {
  const std::scoped_lock lock(mutex_);
  ending_ = true;
  changed_.notify_all();
}

bool CommandLogWriter::close() {
  end();
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return state_ == State::failed || state_ == State::ended; });
  return state_ == State::ended;
}

// From any thread --------------------------------------------------------------------------------

bool CommandLogWriter::takes_more() const {
  return !ending_ && !overflowed_ && state_ != State::failed;
}

bool CommandLogWriter::has_room() const {
  return queue_.entries.size() < kEntries / 2 && queue_.turns.size() < kTurns / 2 &&
         queue_.turn_bytes < kTurnBytes / 2;
}

bool CommandLogWriter::wait_for_room() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return has_room() || !takes_more(); });
  return takes_more();
}

bool CommandLogWriter::wait_until_open() const {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return state_ != State::opening || overflowed_; });
  return state_ != State::failed && !overflowed_;
}

CommandLogWriter::State CommandLogWriter::state() const {
  const std::scoped_lock lock(mutex_);
  return overflowed_ ? State::failed : state_;
}

std::string CommandLogWriter::failure() const {
  const std::scoped_lock lock(mutex_);
  // Told at once: the thread may hang in the disk.
  return overflowed_ ? start_.file.string() + ": the disk is too slow for this run" : failure_;
}

// On its own thread ------------------------------------------------------------------------------

void CommandLogWriter::set_state(State state, const std::string& failure) {
  const std::scoped_lock lock(mutex_);
  state_ = state;
  failure_ = failure;
  if (state == State::failed) queue_ = {};
  changed_.notify_all();
}

void CommandLogWriter::run() {
  try {
    const std::string failure = write();
    set_state(failure.empty() ? State::ended : State::failed, failure);
  } catch (const std::exception& error) {  // memory, or a checkpoint that cannot be written
    set_state(State::failed, "cannot write '" + start_.file.string() + "': " + error.what());
  }
}

// The next entries; false: the last ones.
bool CommandLogWriter::take(Queue& queue) {
  queue.entries.clear();
  queue.turns.clear();
  queue.turn_bytes = 0;
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return !queue_.entries.empty() || !takes_more(); });
  changed_.wait_for(lock, kPatience, [this] { return !has_room() || !takes_more(); });
  std::swap(queue, queue_);
  const bool more = takes_more();
  changed_.notify_all();
  return more;
}

std::string CommandLogWriter::write() {
  if (const auto directory = start_.file.parent_path(); !directory.empty()) {
    std::error_code error;
    std::filesystem::create_directories(directory, error);
    if (error) return reason(start_.file, error.value());
  }
  const int mode = start_.replace ? O_TRUNC : O_EXCL | O_NOFOLLOW;
  FileHandle file(
      ::open(start_.file.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | mode, kReadableByAll));
  if (!file.is_open()) return reason(start_.file, errno);

  LogLines lines;
  std::string text = lines.first(start_);
  if (!write_all(file.get(), text)) return reason(start_.file, errno);
  set_state(State::writing, {});

  Queue queue;
  queue.entries.reserve(kEntries);
  queue.turns.reserve(kTurns);
  std::uint64_t frames = 0;
  for (bool more = true; more;) {
    more = take(queue);
    text.clear();
    for (const Entry& entry : queue.entries) {
      if (entry.turn >= 0) {
        lines.add(queue.turns[static_cast<std::size_t>(entry.turn)], text);
      } else {
        lines.add(entry.frame, text);
        ++frames;
      }
      if (text.size() < kPart) continue;
      if (!write_all(file.get(), text)) return reason(start_.file, errno);
      text.clear();
    }
    if (!write_all(file.get(), text)) return reason(start_.file, errno);
  }
  if (state() == State::failed) return failure();
  if (!write_all(file.get(), lines.last(frames)) || !bring_to_disk(file.get()) || !file.close())
    return reason(start_.file, errno);
  return {};
}

}  // namespace poinsot
