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
  inbox.take(batch);
  ASSERT_EQ(batch.wrenches.size(), 2u);
  ASSERT_EQ(batch.controls.size(), 1u);
  EXPECT_EQ(batch.wrenches[1].seq, 2u);
  inbox.take(batch);
  EXPECT_TRUE(batch.empty());
}

TEST(CommandInbox, RefusesAndCountsWhenFull) {
  CommandInbox inbox;
  for (std::uint64_t n = 1; n <= CommandInbox::kCapacity; ++n)
    ASSERT_TRUE(inbox.push(wrench(1, n)));
  EXPECT_FALSE(inbox.push(wrench(1, 5000)));
  EXPECT_FALSE(inbox.push(wrench(1, 5001)));
  EXPECT_EQ(inbox.full(), 2u);
  inbox.count_malformed();
  EXPECT_EQ(inbox.full(), 2u);
  EXPECT_EQ(inbox.refused(), 3u);
  CommandInbox::Batch batch;
  inbox.take(batch);
  EXPECT_EQ(batch.wrenches.size(), CommandInbox::kCapacity);
  EXPECT_TRUE(inbox.push(wrench(1, 5002)));
}

TEST(CommandInbox, AFloodOfPushesLeavesRoomForAPause) {
  CommandInbox inbox;
  std::uint64_t seq = 1;
  while (inbox.push(wrench(1, seq))) ++seq;  // each a new one: the same would be taken again
  EXPECT_EQ(seq, CommandInbox::kCapacity + 1);
  EXPECT_TRUE(inbox.push(RunControl{}));
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

}  // namespace
}  // namespace poinsot
