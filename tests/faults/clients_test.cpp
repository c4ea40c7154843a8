// Clients that go wrong: the run must not change by a bit, and the daemon must stay to be talked
// to.

#include <csignal>
#include <deque>

#include <gtest/gtest.h>

#include "faults/scene.h"
#include "support/test_domain.h"

namespace poinsot::faults {
namespace {

// fault_client, on this process's domain.
struct FaultClient : ChildProcess {
  explicit FaultClient(const std::string& role, Words more = {})
      : ChildProcess(POINSOT_FAULT_CLIENT, arguments(role, std::move(more))) {}

  static Words arguments(const std::string& role, Words more) {
    more.insert(more.begin(), {role, std::to_string(test_domain()), kWorld});
    return more;
  }
};

// A daemon, and a witness that has seen a frame.
struct FaultyClients : testing::Test {
  Daemon daemon{kWorld};
  Witness witness{test_domain(), kWorld};
  std::uint64_t start = 0;

  void SetUp() override {
    ASSERT_TRUE(eventually([&] { return witness.frame() > 0; }));
    start = witness.frame();
  }

  // The daemon still answers, frames still come, and they are the right ones.
  void TearDown() override {
    const std::uint64_t now = witness.frame();
    ASSERT_TRUE(eventually([&] { return witness.frame() > now + 30; }));
    print_pace(client_json({"status"}));
    expect_undisturbed(witness, 30);
  }
};

// Asks for what is the case already, and is answered whatever else comes in.
void expect_answers(int times) {
  for (int i = 0; i < times; ++i) EXPECT_EQ(client({"resume"}).code, 0);
}

TEST_F(FaultyClients, AHundredThousandFuzzedCommandsAreRefusedAndChangeNothing) {
  constexpr int kSeeds = 5;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    ChildProcess fuzz(POINSOT_FUZZ,
                      {std::to_string(test_domain()), kWorld, "20000", std::to_string(seed)});
    expect_answers(1);
    const std::string sent = fuzz.read_rest();
    EXPECT_EQ(fuzz.wait(), 0) << fuzz.errors();
    std::printf("%s%s", seed == 1 ? sent.c_str() : "", fuzz.errors().c_str());
  }
  const Json status = client_json({"status"});
  EXPECT_EQ(status["commands_accepted"], kSeeds);  // the resumes
  // The others had no identity, or one that had been answered before.
  EXPECT_GE(status["commands_refused"].get<int>(), 1000);
}

TEST_F(FaultyClients, FloodOfTenThousandCommandsASecondShutsNobodyOut) {
  FaultClient flood("flood", {"10000", "4"});
  expect_answers(3);
  std::printf("%s", flood.read_rest().c_str());
  EXPECT_EQ(flood.wait(), 0) << flood.errors();
  EXPECT_EQ(client_json({"status"})["commands_accepted"], 3);
}

TEST_F(FaultyClients, JoiningAndLeavingAHundredTimes) {
  std::deque<FaultClient> visitors;
  for (int i = 0; i < 4; ++i) visitors.emplace_back("visit", Words{"25"});
  for (FaultClient& visitor : visitors) {
    EXPECT_EQ(visitor.read_line(), "left") << visitor.errors();
    EXPECT_EQ(visitor.wait(), 0);
  }
}

TEST_F(FaultyClients, KilledOnes) {
  for (int i = 0; i < 10; ++i) {
    FaultClient doomed("hold");
    ASSERT_EQ(doomed.read_line(), "ready") << doomed.errors();
    doomed.signal(SIGKILL);
    doomed.wait();
  }
}

TEST_F(FaultyClients, StoppedOnes) {
  std::deque<FaultClient> stopped;
  for (int i = 0; i < 3; ++i) {
    stopped.emplace_back("hold");
    ASSERT_EQ(stopped.back().read_line(), "ready") << stopped.back().errors();
    stopped.back().signal(SIGSTOP);
  }
  const std::uint64_t then = witness.frame();
  ASSERT_TRUE(eventually([&] { return witness.frame() > then + 180; }));  // three seconds
  for (FaultClient& client : stopped) client.signal(SIGCONT);
}

}  // namespace
}  // namespace poinsot::faults
