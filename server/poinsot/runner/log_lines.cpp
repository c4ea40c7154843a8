#include "poinsot/runner/log_lines.h"

#include <nlohmann/json.hpp>

#include "poinsot/runner/base64.h"
#include "poinsot/runner/build_identity.h"
#include "poinsot/runner/checkpoint_file.h"
#include "poinsot/runner/command_json.h"
#include "poinsot/runner/hash_text.h"

namespace poinsot {
namespace {

using Json = nlohmann::ordered_json;

// One line. Text that is no UTF-8 names nothing that there is.
std::string line(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace

std::string LogLines::first(const LogStart& start) {
  const Checkpoint& checkpoint = *start.checkpoint;
  return line({{"poinsot_log", kLogFormat},
               {"build", build_identity()},
               {"world", start.world},
               {"frame", checkpoint.frame},
               {"epoch", checkpoint.epoch},
               {"hash", hash_text(checkpoint.state_hash)},
               {"checkpoint", to_base64(checkpoint_bytes(checkpoint))}});
}

void LogLines::add(const TurnRecord& turn, std::string& text) {
  Json json = {{"before", turn.before}, {"epoch", turn.epoch}};
  for (const WrenchCommand& wrench : turn.wrenches) json["wrenches"].push_back(to_json(wrench));
  for (const Order& order : turn.orders) {
    Json& item = json["orders"].emplace_back(to_json(order.control));
    if (order.checkpoint) item["checkpoint"] = number_of(order.checkpoint, text);
  }
  text += line(json);
}

void LogLines::add(const FrameRecord& frame, std::string& text) {
  text.append("{\"frame\":").append(std::to_string(frame.frame));
  text.append(",\"hash\":\"").append(hash_text(frame.hash)).append("\"}\n");
}

std::string LogLines::last(std::uint64_t frames) {
  return line({{"end", frames}});
}

std::uint64_t LogLines::number_of(const std::shared_ptr<const Checkpoint>& checkpoint,
                                  std::string& text) {
  std::erase_if(written_, [](const auto& entry) { return entry.first.expired(); });
  for (const auto& [known, number] : written_)
    if (known.lock() == checkpoint) return number;
  text +=
      line({{"checkpoint", ++checkpoints_}, {"bytes", to_base64(checkpoint_bytes(*checkpoint))}});
  written_.emplace_back(checkpoint, checkpoints_);
  return checkpoints_;
}

}  // namespace poinsot
