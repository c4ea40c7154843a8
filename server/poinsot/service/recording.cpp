#include "poinsot/service/recording.h"

#include <utility>

namespace poinsot {

void Recording::begin(std::string name, std::shared_ptr<CommandLogWriter> log, std::uint64_t next,
                      std::uint32_t epoch) {
  name_ = std::move(name);
  log_ = std::move(log);
  begin_turn(next, epoch);
}

std::shared_ptr<CommandLogWriter> Recording::end() {
  if (!log_) return nullptr;
  end_turn();
  log_->end();
  name_.clear();
  return std::exchange(log_, nullptr);
}

void Recording::begin_turn(std::uint64_t next, std::uint32_t epoch) {
  turn_.before = next;
  turn_.epoch = epoch;
}

void Recording::note(std::span<const WrenchCommand> wrenches) {
  if (log_) turn_.wrenches.insert(turn_.wrenches.end(), wrenches.begin(), wrenches.end());
}

void Recording::note(const Order& order) {
  if (log_) turn_.orders.push_back(order);
}

void Recording::end_turn() {
  if (!log_ || (turn_.wrenches.empty() && turn_.orders.empty())) return;
  log_->turn(std::move(turn_));
  turn_ = {};
}

void Recording::frame(std::uint64_t frame, std::uint64_t hash) {
  if (log_) log_->frame(frame, hash);
}

}  // namespace poinsot
