// Each topic from one participant to another, through the transports.

#include <gtest/gtest.h>

#include "poinsot/base/error.h"
#include "poinsot/base/limits.h"
#include "poinsot/wire/publisher.h"
#include "poinsot/wire/subscriber.h"
#include "support/protocol_equality.h"
#include "support/protocol_samples.h"
#include "support/test_domain.h"

namespace poinsot {
namespace {

using namespace std::chrono_literals;

template <class Message>
void expect_delivery(const Message& message) {
  Participant here({.domain = test_domain()});
  Participant there({.domain = test_domain()});
  Publisher<Message> publisher(here, "delivery");
  Subscriber<Message> subscriber(there, "delivery");
  ASSERT_TRUE(eventually([&] { return publisher.readers() == 1 && subscriber.writers() == 1; }));
  ASSERT_TRUE(publisher.write(message));
  Message received;
  ASSERT_TRUE(eventually([&] { return subscriber.take(received); }));
  expect_same(message, received);
  EXPECT_FALSE(subscriber.take(received));
}

TEST(RoundTrip, PosesArriveAsTheyAre) {
  expect_delivery(sample::poses(5, 10));
}
TEST(RoundTrip, ABodyArrivesAsItIs) {
  expect_delivery(sample::body_info(0, 1));
}
TEST(RoundTrip, AReportArrivesAsItIs) {
  expect_delivery(sample::report());
}
TEST(RoundTrip, AReportOfAsManyBodiesAsAllowedArrivesAsItIs) {
  RunReport report = sample::report();
  report.body_methods.assign(kMaxBodies, Method::rk4);
  expect_delivery(report);
}
TEST(RoundTrip, AWrenchArrivesAsItIs) {
  expect_delivery(sample::wrench());
}
TEST(RoundTrip, AControlArrivesAsItIs) {
  expect_delivery(sample::control());
}
TEST(RoundTrip, AReplyArrivesAsItIs) {
  expect_delivery(sample::reply());
}

TEST(RoundTrip, AnImpactArrivesAsItIs) {
  expect_delivery(sample::impact());
}

TEST(RoundTrip, ManyCommandsInOneGoAllArriveInOrder) {
  Participant here({.domain = test_domain()});
  Participant there({.domain = test_domain()});
  Publisher<WrenchCommand> publisher(here, "burst");
  Subscriber<WrenchCommand> subscriber(there, "burst");
  ASSERT_TRUE(eventually([&] { return publisher.readers() == 1 && subscriber.writers() == 1; }));
  constexpr std::uint64_t kCommands = 200;  // less than the writer keeps for repair
  WrenchCommand command = sample::wrench();
  for (command.seq = 1; command.seq <= kCommands; ++command.seq)
    ASSERT_TRUE(publisher.write(command));
  WrenchCommand received;
  for (std::uint64_t seq = 1; seq <= kCommands; ++seq) {
    ASSERT_TRUE(eventually([&] { return subscriber.take(received); })) << seq;
    EXPECT_EQ(received.seq, seq);
  }
}

TEST(RoundTrip, AParticipantOutOfRangeOrAStrangeWorldIsAnError) {
  EXPECT_THROW(Participant({.domain = kMaxDomain + 1}), Error);
  EXPECT_THROW(Participant({.domain = -1}), Error);
  Participant participant({.domain = test_domain()});
  EXPECT_THROW(Publisher<Reply>(participant, ""), Error);
  EXPECT_THROW(Publisher<Reply>(participant, "a/b"), Error);
  EXPECT_THROW(Subscriber<Reply>(participant, std::string(300, 'a')), Error);
}

TEST(RoundTrip, EndpointsOutliveTheirParticipantObject) {
  auto participant = std::make_unique<Participant>(BusOptions{.domain = test_domain()});
  Publisher<Reply> publisher(*participant, "owner");
  participant.reset();
  EXPECT_TRUE(publisher.write(sample::reply()));
}

}  // namespace
}  // namespace poinsot
