#include "poinsot/service/command_inbox.h"

#include <algorithm>
#include <utility>

namespace poinsot {

template <class Command>
bool CommandInbox::push(Command&& command, std::vector<Command>& queue) {
  {
    const std::lock_guard lock(mutex_);
    if (queue.size() >= kCapacity) {
      const auto same = [&](const Command& c) {
        return c.client == command.client && c.seq == command.seq;
      };
      if (std::any_of(queue.begin(), queue.end(), same)) return true;  // sent again: it waits
      ++full_;
      return false;
    }
    queue.push_back(std::move(command));
  }
  arrived_.notify_one();
  return true;
}

bool CommandInbox::push(WrenchCommand command) {
  return push(std::move(command), pending_.wrenches);
}

bool CommandInbox::push(RunControl control) {
  return push(std::move(control), pending_.controls);
}

void CommandInbox::take(Batch& batch) {
  batch.clear();
  const std::lock_guard lock(mutex_);
  std::swap(batch, pending_);
}

bool CommandInbox::wait(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  return arrived_.wait(lock, stop, [&] { return !pending_.empty(); });
}

void CommandInbox::count_malformed() {
  const std::lock_guard lock(mutex_);
  ++malformed_;
}

std::uint64_t CommandInbox::full() const {
  const std::lock_guard lock(mutex_);
  return full_;
}

std::uint64_t CommandInbox::refused() const {
  const std::lock_guard lock(mutex_);
  return full_ + malformed_;
}

}  // namespace poinsot
