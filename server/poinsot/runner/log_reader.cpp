#include "poinsot/runner/log_reader.h"

#include <cerrno>
#include <cstring>
#include <utility>

#include <nlohmann/json.hpp>

#include "poinsot/base/error.h"
#include "poinsot/runner/base64.h"
#include "poinsot/runner/checkpoint_file.h"
#include "poinsot/runner/command_json.h"
#include "poinsot/runner/hash_text.h"
#include "poinsot/runner/log_lines.h"
#include "poinsot/scene/fragment.h"

namespace poinsot {
namespace {

using Json = nlohmann::ordered_json;

static_assert(kMaxFragment == kMaxFragmentText);  // what comes by the bus can be read

std::uint64_t hash_of(const Json& json) {
  const auto hash = hash_from(json.get_ref<const std::string&>());
  if (!hash) throw Error("a hash must be 16 hexadecimal digits");
  return *hash;
}

// Without a sign and in the range of the type; at() throws what checked() catches.
template <class Whole>
Whole whole(const Json& json) {
  if (!json.is_number_unsigned() || !std::in_range<Whole>(json.get<std::uint64_t>()))
    throw Error("a number must be whole and must fit");
  return json.get<Whole>();
}

Order order_from(Json json,
                 const std::map<std::uint64_t, std::shared_ptr<const Checkpoint>>& checkpoints) {
  std::shared_ptr<const Checkpoint> checkpoint;
  if (json.contains("checkpoint")) {
    const auto found = checkpoints.find(whole<std::uint64_t>(json.at("checkpoint")));
    if (found == checkpoints.end()) throw Error("a restore names a checkpoint that is not there");
    checkpoint = found->second;
    json.erase("checkpoint");
  }
  Order order{.control = control_from(json), .checkpoint = std::move(checkpoint)};
  if (order.control.action == ControlAction::spawn)
    order.fragment =
        std::make_shared<const std::vector<BodyDef>>(parse_fragment(order.control.text));
  return order;
}

}  // namespace

template <class Read>
auto CommandLogReader::checked(const Read& read) const {
  try {
    return read();
  } catch (const Error& error) {
    fail(error.what());
  } catch (const Json::exception& error) {
    fail(std::string("is no line of a log: ") + error.what());
  }
}

CommandLogReader::CommandLogReader(const std::filesystem::path& file)
    : name_(file.string()), stream_(file, std::ios::binary) {
  if (!stream_.is_open()) throw Error(name_ + ": cannot be read: " + std::strerror(errno));
  std::string line;
  if (!read_line(line)) fail("is no command log: it has no whole first line");
  checked([&] {
    const Json json = Json::parse(line);
    if (!json.is_object() || !json.contains("poinsot_log")) throw Error("is no command log");
    if (const int format = whole<int>(json.at("poinsot_log")); format != kLogFormat)
      throw Error("is a log of format " + std::to_string(format) + ", known is " +
                  std::to_string(kLogFormat));
    header_ = {.build = json.at("build").get<std::string>(),
               .world = json.at("world").get<std::string>(),
               .frame = whole<std::uint64_t>(json.at("frame")),
               .epoch = whole<std::uint32_t>(json.at("epoch")),
               .hash = hash_of(json.at("hash"))};
    start_ = json.at("checkpoint").get<std::string>();
    return 0;
  });
}

std::shared_ptr<const Checkpoint> CommandLogReader::start() const {
  return checkpoint_from(from_base64(start_), name_ + ":1");
}

std::optional<LogEntry> CommandLogReader::next() {
  std::string line;
  while (!ended_ && read_line(line))
    if (auto entry = checked([&] { return read_entry(line); })) return entry;
  cut_ = !ended_;
  return std::nullopt;
}

// Nothing: the line was no entry, but a checkpoint for those to come, or the last.
std::optional<LogEntry> CommandLogReader::read_entry(const std::string& line) {
  const Json json = Json::parse(line);
  if (!json.is_object()) throw Error("a line must be an object");
  if (json.contains("before")) {
    TurnRecord turn{.before = whole<std::uint64_t>(json.at("before")),
                    .epoch = whole<std::uint32_t>(json.at("epoch"))};
    for (const Json& item : json.value("wrenches", Json::array()))
      turn.wrenches.push_back(wrench_from(item));
    for (const Json& item : json.value("orders", Json::array()))
      turn.orders.push_back(order_from(item, checkpoints_));
    return turn;
  }
  if (json.contains("frame"))
    return FrameRecord{whole<std::uint64_t>(json.at("frame")), hash_of(json.at("hash"))};
  if (json.contains("checkpoint")) {
    const auto bytes = from_base64(json.at("bytes").get_ref<const std::string&>());
    checkpoints_[whole<std::uint64_t>(json.at("checkpoint"))] =
        checkpoint_from(bytes, "checkpoint");
    return std::nullopt;
  }
  ended_ = json.contains("end");
  if (!ended_) throw Error("a line must have one of before, frame, checkpoint, end");
  return std::nullopt;
}

std::string CommandLogReader::where() const {
  return name_ + ":" + std::to_string(line_);
}

// A line that does not end was cut while it was written.
bool CommandLogReader::read_line(std::string& line) {
  if (!std::getline(stream_, line) || stream_.eof()) return false;
  ++line_;
  return true;
}

void CommandLogReader::fail(const std::string& what) const {
  throw Error(where() + ": " + what);
}

}  // namespace poinsot
