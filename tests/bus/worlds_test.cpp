// Several worlds on one domain.

#include <signal.h>

#include <gtest/gtest.h>

#include "bus/roles.h"
#include "poinsot/wire/publisher.h"
#include "poinsot/wire/subscriber.h"
#include "support/child_process.h"
#include "support/protocol_samples.h"
#include "support/test_domain.h"

namespace poinsot {
namespace {

using namespace std::chrono_literals;
using Names = std::vector<std::string>;

TEST(Worlds, OnOneDomainDoNotMix) {
  Participant here({.domain = test_domain()});
  Participant there({.domain = test_domain()});
  Publisher<PoseSnapshot> poses_a(here, "a");
  Publisher<PoseSnapshot> poses_b(here, "b");
  Subscriber<WrenchCommand> wrench_a(here, "a");
  Subscriber<WrenchCommand> wrench_b(here, "b");
  Subscriber<PoseSnapshot> reader_a(there, "a");
  Publisher<WrenchCommand> writer_a(there, "a");
  ASSERT_TRUE(eventually([&] {
    return poses_a.readers() == 1 && reader_a.writers() == 1 && wrench_a.writers() == 1 &&
           writer_a.readers() == 1;
  }));
  EXPECT_EQ(poses_b.readers(), 0);
  EXPECT_EQ(wrench_b.writers(), 0);

  ASSERT_TRUE(writer_a.write(sample::wrench()));
  ASSERT_TRUE(poses_b.write(sample::poses(1, 1)));
  ASSERT_TRUE(poses_a.write(sample::poses(2, 1)));
  PoseSnapshot poses;
  ASSERT_TRUE(eventually([&] { return reader_a.take(poses); }));
  EXPECT_EQ(poses.frame, 2u);
  WrenchCommand command;
  ASSERT_TRUE(eventually([&] { return wrench_a.take(command); }));
  EXPECT_FALSE(wrench_b.take(command));
}

TEST(Worlds, AreDiscoveredAndForgotten) {
  Participant observer({.domain = test_domain()});
  {
    Participant first({.domain = test_domain()});
    Participant second({.domain = test_domain()});
    Publisher<RunReport> beta(first, "beta");
    Publisher<RunReport> alpha(second, "alpha");
    Publisher<PoseSnapshot> no_daemon(second, "gamma");  // poses alone make no daemon
    EXPECT_TRUE(eventually([&] { return observer.worlds() == Names{"alpha", "beta"}; }));
  }
  EXPECT_TRUE(eventually([&] { return observer.worlds().empty(); }));
}

TEST(Worlds, OfAKilledProcessAreForgottenAfterItsLease) {
  Participant observer({.domain = test_domain()});
  ChildProcess daemon(role("serve", "mortal"));
  ASSERT_TRUE(eventually([&] { return observer.worlds() == Names{"mortal"}; }));
  daemon.signal(SIGKILL);
  EXPECT_TRUE(eventually([&] { return observer.worlds().empty(); }));
}

TEST(Worlds, ManyParticipantsOfThisHostAllFindEachOther) {
  std::vector<Participant> participants;
  for (int i = 0; i < 10; ++i) participants.emplace_back(BusOptions{.domain = test_domain()});
  Publisher<RunReport> report(participants.back(), "late_number");
  EXPECT_TRUE(eventually([&] {
    for (std::size_t i = 0; i + 1 < participants.size(); ++i)
      if (participants[i].worlds() != Names{"late_number"}) return false;
    return true;
  }));
  EXPECT_EQ(participants.back().worlds(), Names{});  // its own is none that it met
}

TEST(Worlds, AProcessThatJoinedAndLeftManyTimesIsStillMet) {
  Participant daemon({.domain = test_domain()});
  Publisher<RunReport> report(daemon, "patient");
  constexpr int kJoins = 40;  // more than there are numbers of participants that are greeted
  for (int i = 0; i < kJoins; ++i) Participant({.domain = test_domain()});
  Participant observer({.domain = test_domain()});
  EXPECT_TRUE(eventually([&] { return observer.worlds() == Names{"patient"}; }));
}

}  // namespace
}  // namespace poinsot
