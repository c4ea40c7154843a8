#include "poinsot/service/command_inbox.h"

#include <atomic>
#include <chrono>
#include <thread>

#include <gtest/gtest.h>

namespace poinsot {
namespace {

using namespace std::chrono_literals;

WrenchCommand wrench(std::uint64_t client, std::uint64_t seq) {
  WrenchCommand command;
  command.client = client;
  command.seq = seq;
  return command;
}

TEST(CommandInbox, HandsOverEverythingOnce) {
  CommandInbox inbox;
  CommandInbox::Batch batch;
  EXPECT_TRUE(inbox.push(wrench(1, 1)));
  EXPECT_TRUE(inbox.push(wrench(1, 2)));
  EXPECT_TRUE(inbox.push(RunControl{.client = 1, .seq = 3}));
  inbox.push_own(Order{.control = {.client = 1, .seq = kOwnSeq}});
  inbox.push_result(Reply{.client = 1, .seq = 4});
  inbox.take(batch);
  ASSERT_EQ(batch.wrenches.size(), 2u);
  EXPECT_EQ(batch.orders.size(), 1u);
  EXPECT_EQ(batch.own.size(), 1u);
  EXPECT_EQ(batch.results.size(), 1u);
  EXPECT_EQ(batch.wrenches[1].seq, 2u);
  inbox.take(batch);
  EXPECT_TRUE(batch.empty());
}

constexpr std::size_t kOneClient = CommandInbox::kWrenches / CommandInbox::kShare;

TEST(CommandInbox, RefusesAndCountsWhenFull) {
  CommandInbox inbox;
  for (std::uint64_t n = 1; n <= CommandInbox::kWrenches; ++n)
    ASSERT_TRUE(inbox.push(wrench(n % 4, n)));
  EXPECT_FALSE(inbox.push(wrench(1, 5000)));
  EXPECT_FALSE(inbox.push(wrench(9, 5001)));
  EXPECT_TRUE(inbox.push(wrench(1, 5)));  // sent again: it waits
  EXPECT_EQ(inbox.full(), 2u);
  inbox.count_refused();
  EXPECT_EQ(inbox.full(), 2u);
  EXPECT_EQ(inbox.refused(), 3u);
  CommandInbox::Batch batch;
  inbox.take(batch);
  EXPECT_EQ(batch.wrenches.size(), CommandInbox::kWrenches);
  EXPECT_TRUE(inbox.push(wrench(1, 5002)));
}

TEST(CommandInbox, OneClientLeavesRoomForOthers) {
  CommandInbox inbox;
  std::uint64_t seq = 1;
  while (inbox.push(wrench(1, seq))) ++seq;  // each a new one: the same would be taken again
  EXPECT_EQ(seq, kOneClient + 1);
  for (seq = 1; seq <= kOneClient; ++seq) ASSERT_TRUE(inbox.push(wrench(2, seq)));
  EXPECT_FALSE(inbox.push(wrench(3, 1)));
  EXPECT_TRUE(inbox.push(RunControl{.client = 1}));  // pushes do not shut out a pause
  CommandInbox::Batch batch;
  inbox.take(batch);
  EXPECT_TRUE(inbox.push(wrench(1, 9999)));
}

TEST(CommandInbox, TheDaemonsOwnOrdersAlwaysFindRoom) {
  CommandInbox inbox;
  for (std::uint64_t n = 1; n <= CommandInbox::kOrders; ++n)
    ASSERT_TRUE(inbox.push(RunControl{.client = n, .seq = n}));
  EXPECT_FALSE(inbox.push(RunControl{.client = 0, .seq = 1}));
  inbox.push_own(Order{});
  CommandInbox::Batch batch;
  inbox.take(batch);
  EXPECT_EQ(batch.own.size(), 1u);
}

TEST(CommandInbox, WaitEndsWithTheTime) {
  CommandInbox inbox;
  const auto begin = std::chrono::steady_clock::now();
  const auto until = begin + 20ms;
  EXPECT_FALSE(inbox.wait({}, std::chrono::nanoseconds(until.time_since_epoch()).count()));
  EXPECT_GE(std::chrono::steady_clock::now(), until);
}

TEST(CommandInbox, WaitEndsWithACommand) {
  CommandInbox inbox;
  std::jthread sender([&] {
    std::this_thread::sleep_for(20ms);
    inbox.push(wrench(1, 1));
  });
  EXPECT_TRUE(inbox.wait({}));
}

TEST(CommandInbox, WaitEndsWithTheStop) {
  CommandInbox inbox;
  std::atomic<bool> stopped = false;
  std::jthread waiter([&](const std::stop_token& stop) {
    EXPECT_FALSE(inbox.wait(stop));
    stopped = true;
  });
  std::this_thread::sleep_for(20ms);
  EXPECT_FALSE(stopped);
  waiter.request_stop();
  waiter.join();
  EXPECT_TRUE(stopped);
}

// Also for the thread sanitizer: many pushers, one taker, nothing lost and nothing twice.
TEST(CommandInbox, ManyThreadsPushAndOneTakes) {
  constexpr std::uint64_t kThreads = 4, kEach = 5000;
  CommandInbox inbox;
  std::atomic<std::uint64_t> refused = 0;
  std::vector<std::uint64_t> last(kThreads, 0);  // seq per client
  std::uint64_t taken = 0;
  {
    std::vector<std::jthread> pushers;
    for (std::uint64_t client = 0; client < kThreads; ++client)
      pushers.emplace_back([&, client] {
        for (std::uint64_t seq = 1; seq <= kEach; ++seq)
          if (!inbox.push(wrench(client, seq))) ++refused;
      });
    CommandInbox::Batch batch;
    while (taken + refused < kThreads * kEach) {
      inbox.take(batch);
      for (const WrenchCommand& command : batch.wrenches) {
        ASSERT_GT(command.seq, last[command.client]);  // in each client's own order
        last[command.client] = command.seq;
      }
      taken += batch.wrenches.size();
    }
  }
  EXPECT_EQ(taken + refused, kThreads * kEach);
  EXPECT_EQ(inbox.full(), refused);
}

TEST(CommandInbox, KnowsWhatWaitsToBeTaken) {
  CommandInbox inbox;
  WrenchCommand command;
  command.client = 1;
  command.seq = 7;
  inbox.push(command);
  EXPECT_TRUE(inbox.waits(1, 7));
  EXPECT_FALSE(inbox.waits(1, 8));
  CommandInbox::Batch batch;
  inbox.take(batch);
  EXPECT_FALSE(inbox.waits(1, 7));
}

}  // namespace
}  // namespace poinsot
