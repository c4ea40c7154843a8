#include "poinsot/service/command_inbox.h"

#include <algorithm>
#include <chrono>

namespace poinsot {
namespace {

std::pair<std::uint64_t, std::uint64_t> key(const WrenchCommand& command) {
  return {command.client, command.seq};
}
std::pair<std::uint64_t, std::uint64_t> key(const Order& order) {
  return {order.control.client, order.control.seq};
}

}  // namespace

CommandInbox::Batch::Batch() {
  wrenches.reserve(kWrenches);
  orders.reserve(kOrders);
}

void CommandInbox::Batch::clear() {
  wrenches.clear();
  orders.clear();
  own.clear();
  results.clear();
}

std::size_t& CommandInbox::Shares::operator[](std::uint64_t client) {
  const auto found =
      std::find_if(of.begin(), of.end(), [&](const auto& share) { return share.first == client; });
  return found != of.end() ? found->second : of.emplace_back(client, 0).second;
}

template <class Command>
bool CommandInbox::push(Command&& command, std::vector<Command>& queue, Shares& shares,
                        std::size_t capacity) {
  {
    const std::lock_guard lock(mutex_);
    std::size_t& share = shares[key(command).first];
    if (queue.size() >= capacity || share >= capacity / kShare) {
      const auto same = [&](const Command& c) { return key(c) == key(command); };
      if (std::any_of(queue.begin(), queue.end(), same)) return true;  // sent again: it waits
      ++full_;
      return false;
    }
    ++share;
    queue.push_back(std::move(command));
  }
  arrived_.notify_one();
  return true;
}

bool CommandInbox::push(WrenchCommand command) {
  return push(std::move(command), pending_.wrenches, wrench_shares_, kWrenches);
}

bool CommandInbox::push(Order order) {
  return push(std::move(order), pending_.orders, order_shares_, kOrders);
}

void CommandInbox::push_own(Order order) {
  {
    const std::lock_guard lock(mutex_);
    const auto note = [&](const auto& commands) {
      for (const auto& command : commands)
        if (const auto [client, seq] = key(command); client == order.control.client)
          order.after = std::max(order.after, seq);
    };
    note(pending_.wrenches);
    note(pending_.orders);
    pending_.own.push_back(std::move(order));
  }
  arrived_.notify_one();
}

void CommandInbox::push_result(Reply reply) {
  {
    const std::lock_guard lock(mutex_);
    pending_.results.push_back(std::move(reply));
  }
  arrived_.notify_one();
}

void CommandInbox::take(Batch& batch) {
  batch.clear();
  const std::lock_guard lock(mutex_);
  std::swap(batch, pending_);
  nudged_ = false;
  wrench_shares_.of.clear();
  order_shares_.of.clear();
}

void CommandInbox::nudge() {
  {
    const std::lock_guard lock(mutex_);
    nudged_ = true;
  }
  arrived_.notify_one();
}

bool CommandInbox::wait(const std::stop_token& stop, std::int64_t until) {
  std::unique_lock lock(mutex_);
  const auto something = [&] { return nudged_ || !pending_.empty(); };
  if (until == INT64_MAX) return arrived_.wait(lock, stop, something);
  const std::chrono::steady_clock::time_point time{std::chrono::nanoseconds(until)};
  return arrived_.wait_until(lock, stop, time, something);
}

bool CommandInbox::waits(std::uint64_t client, std::uint64_t seq) const {
  const std::lock_guard lock(mutex_);
  const auto same = [&](const auto& command) { return key(command) == std::pair(client, seq); };
  return std::ranges::any_of(pending_.wrenches, same) || std::ranges::any_of(pending_.orders, same);
}

void CommandInbox::count_refused() {
  const std::lock_guard lock(mutex_);
  ++never_got_here_;
}

std::uint64_t CommandInbox::full() const {
  const std::lock_guard lock(mutex_);
  return full_;
}

std::uint64_t CommandInbox::refused() const {
  const std::lock_guard lock(mutex_);
  return full_ + never_got_here_;
}

}  // namespace poinsot
