#include "poinsot/service/clients.h"

#include <gtest/gtest.h>

#include "poinsot/base/limits.h"

namespace poinsot {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;  // [ns]

WriterKey writer(std::uint32_t number) {
  WriterKey key{};
  for (std::size_t i = 0; i < 4; ++i) key[i] = static_cast<std::uint8_t>(number >> (8 * i));
  return key;
}

std::vector<ClientStatus> report(Clients& clients, std::int64_t now, std::uint64_t holder = 0) {
  std::vector<ClientStatus> all;
  clients.report(
      now, [&](ClientStatus& status) { status.held = status.client == holder ? 1 : 0; }, all);
  return all;
}

TEST(Clients, AClientIsGoneWithTheLastOfItsWriters) {
  Clients clients({});
  clients.admit(5, writer(1), 1, 0);
  clients.admit(5, writer(2), 1, 0);
  clients.admit(6, writer(3), 1, 0);
  std::vector<std::uint64_t> left;
  clients.lose(writer(1), 0, left);
  EXPECT_TRUE(left.empty());
  EXPECT_TRUE(report(clients, 0)[0].alive);
  clients.lose(writer(2), 0, left);
  EXPECT_EQ(left, std::vector<std::uint64_t>{5});
  clients.lose(writer(2), 0, left);   // told twice
  clients.lose(writer(99), 0, left);  // never heard of
  EXPECT_EQ(left.size(), 1u);
}

TEST(Clients, AClientThatIsHeardOfAgainIsAliveAgain) {
  Clients clients({});
  std::vector<std::uint64_t> left;
  clients.admit(5, writer(1), 1, 0);
  clients.lose(writer(1), 0, left);
  EXPECT_TRUE(report(clients, 0).empty());
  clients.admit(5, writer(1), 1, 0);
  EXPECT_TRUE(report(clients, 0)[0].alive);
  clients.lose(writer(1), 0, left);
  EXPECT_EQ(left.size(), 2u);
}

TEST(Clients, AControllerOfFiveHundredBodiesIsNotLimited) {
  Clients clients({});
  for (std::int64_t frame = 0; frame < 600; ++frame)
    for (int body = 0; body < 500; ++body)
      ASSERT_TRUE(clients.admit(5, writer(1), 1, frame * kSecond / 60)) << frame << " " << body;
  EXPECT_EQ(clients.limited(), 0u);
}

TEST(Clients, AFloodIsLimitedToItsRateAndOthersAreNot) {
  const ClientLimits limits{.commands_per_second = 1000, .commands_at_once = 100};
  Clients clients(limits);
  int passed = 0;
  for (std::int64_t n = 0; n < 100'000; ++n) {  // ten seconds of it
    const std::int64_t now = n * kSecond / 10'000;
    passed += clients.admit(1, writer(1), 1, now) ? 1 : 0;
    if (n % 100 == 0) {
      EXPECT_TRUE(clients.admit(2, writer(2), 1, now));
    }
  }
  EXPECT_NEAR(passed, 100 + 10 * 1000, 1);
  EXPECT_EQ(clients.limited(), 100'000u - static_cast<std::uint64_t>(passed));
  EXPECT_EQ(report(clients, 0)[0].limited, clients.limited());
}

TEST(Clients, AFloodOfRefusalsIsAnsweredAtALowRate) {
  Clients clients({.refusals_per_second = 200, .refusals_at_once = 10});
  clients.admit(1, writer(1), 1, 0);
  int answered = 0;
  for (std::int64_t n = 0; n < 10'000; ++n)
    answered += clients.refuse(1, n * kSecond / 10'000) ? 1 : 0;
  EXPECT_NEAR(answered, 10 + 200, 1);
  EXPECT_EQ(clients.unanswered(), 10'000u - static_cast<std::uint64_t>(answered));
  EXPECT_EQ(report(clients, 0)[0].refused, 10'000u);
}

TEST(Clients, AWriterThatSpeaksForManyIsStopped) {
  Clients clients({});
  std::size_t admitted = 0;
  for (std::uint64_t client = 1; client <= 5000; ++client)
    admitted += clients.admit(client, writer(1), 1, 0) ? 1 : 0;
  EXPECT_EQ(admitted, Clients::kClientsOfOneWriter);
  EXPECT_TRUE(clients.admit(9999, writer(2), 1, 0));
}

TEST(Clients, ThousandsOfShortLivedClientsDoNotGrowMemory) {
  Clients clients({});
  std::vector<std::uint64_t> left;
  for (std::uint32_t n = 1; n <= 5000; ++n) {
    ASSERT_TRUE(clients.admit(n, writer(n), 1, n));
    clients.lose(writer(n), n, left);
  }
  EXPECT_EQ(clients.known(), Clients::kKnown);
  EXPECT_TRUE(report(clients, 5000).empty());
  report(clients, 5000 + Clients::kRemembered + 1);
  EXPECT_EQ(clients.known(), 0u);
}

TEST(Clients, ADeadOneIsToldOfWhileItHoldsSomething) {
  Clients clients({});
  std::vector<std::uint64_t> left;
  clients.admit(5, writer(1), 1, 0);
  clients.lose(writer(1), 0, left);
  const auto all = report(clients, 2 * Clients::kRemembered, 5);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_FALSE(all[0].alive);
  EXPECT_EQ(all[0].held, 1u);
  EXPECT_TRUE(report(clients, 2 * Clients::kRemembered).empty());
  EXPECT_EQ(clients.known(), 0u);
}

TEST(Clients, ToldOfAreNoMoreThanFitInAReport) {
  Clients clients({});
  for (std::uint32_t n = 1; n <= 2 * kMaxClients; ++n) clients.admit(n, writer(n), 1, 0);
  EXPECT_EQ(report(clients, 0).size(), kMaxClients);
}

TEST(Clients, NoWriterSpeaksForTheScene) {
  Clients clients({});
  EXPECT_FALSE(clients.admit(0, writer(1), 1, 0));
  EXPECT_FALSE(clients.refuse(0, 0));
  std::vector<std::uint64_t> left;
  clients.lose(writer(1), 0, left);
  EXPECT_TRUE(left.empty());
}

TEST(Clients, WhoFindsNoPlaceIsToldSoAtALowRate) {
  Clients clients({.refusals_per_second = 200, .refusals_at_once = 10});
  for (std::uint32_t n = 1; n <= Clients::kKnown; ++n) clients.admit(n, writer(n), 1, 0);
  EXPECT_FALSE(clients.admit(5000, writer(5000), 1, 0));
  int answered = 0;
  for (std::uint64_t n = 0; n < 100; ++n) answered += clients.refuse(5000 + n, 0) ? 1 : 0;
  EXPECT_EQ(answered, 10);
}

}  // namespace
}  // namespace poinsot
