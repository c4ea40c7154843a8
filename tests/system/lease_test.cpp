// What a client holds ends with it, by whatever end; what is meant to outlive it stays.

#include <csignal>

#include <gtest/gtest.h>

#include "support/test_domain.h"
#include "system/free_world.h"
#include "system/holding_client.h"

namespace poinsot {
namespace {

Json held() {
  const Json list = FreeWorld::json({"pushes"});
  return list["held"];
}

// One push by the tool, which outlives it, and one by a client that is there.
void hold_two(ChildProcess& holder) {
  ASSERT_NE(holder.read_line(), "");
  FreeWorld::json({"push", "bystander", "--force", "0,1,0", "--hold"});
  ASSERT_EQ(held().size(), 2u);
}

void expect_that_only_the_tools_is_left() {
  Json left;
  EXPECT_TRUE(eventually([&] {
    left = held();
    return left.size() < 2;
  }));
  ASSERT_EQ(left.size(), 1u) << left;
  EXPECT_EQ(left[0]["body"], "bystander");
  EXPECT_EQ(left[0]["you"], true);
  EXPECT_EQ(left[0]["outlives_client"], true);
}

TEST(Lease, OfAKilledClientEndsWhatItHolds) {
  FreeWorld world;
  world.start();
  ChildProcess holder(holding_client("probe", Hold::until_cleared));
  hold_two(holder);
  holder.signal(SIGKILL);
  holder.wait();
  expect_that_only_the_tools_is_left();
  const Json status = FreeWorld::json({"status"});
  EXPECT_EQ(status["held_wrenches"], 1);
}

TEST(Lease, OfAStoppedClientEndsWhatItHolds) {
  FreeWorld world;
  world.start();
  ChildProcess holder(holding_client("probe", Hold::until_cleared));
  hold_two(holder);
  holder.signal(SIGSTOP);
  expect_that_only_the_tools_is_left();
  holder.signal(SIGCONT);
}

TEST(Lease, OfAKilledMemberOfLockStepLetsTheRunGoOn) {
  FreeWorld world;
  world.start({});
  ChildProcess member(blocking_client());
  ASSERT_NE(member.read_line(), "");
  const int frame = FreeWorld::json({"status"})["frame"];
  EXPECT_EQ(FreeWorld::json({"status"})["frame"], frame) << "every frame waits for its input";
  member.signal(SIGKILL);
  member.wait();
  EXPECT_TRUE(eventually([&] { return FreeWorld::json({"status"})["frame"] > frame + 10; }));
}

}  // namespace
}  // namespace poinsot
