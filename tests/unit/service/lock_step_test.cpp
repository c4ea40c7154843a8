#include "poinsot/service/lock_step.h"

#include <gtest/gtest.h>

namespace poinsot {
namespace {

RunControl advance(std::uint64_t client, std::uint64_t seq) {
  return {.client = client, .seq = seq, .action = ControlAction::advance};
}

TEST(LockStep, IsReadyWhenEveryMemberHasSaidSo) {
  LockStep lock_step;
  EXPECT_TRUE(lock_step.ready());  // nobody is waited for
  lock_step.join(7, 100);
  lock_step.join(3, 200);
  EXPECT_FALSE(lock_step.ready());
  EXPECT_TRUE(lock_step.offer(advance(7, 1)));
  EXPECT_FALSE(lock_step.ready());
  EXPECT_TRUE(lock_step.offer(advance(3, 1)));
  EXPECT_TRUE(lock_step.ready());

  std::vector<RunControl> advances;
  lock_step.take(advances);
  ASSERT_EQ(advances.size(), 2u);
  EXPECT_EQ(advances[0].client, 3u);
  EXPECT_FALSE(lock_step.ready());  // for the frame after
}

TEST(LockStep, OneInputPerFrameCounts) {
  LockStep lock_step;
  lock_step.join(7, 100);
  EXPECT_TRUE(lock_step.offer(advance(7, 1)));
  EXPECT_FALSE(lock_step.offer(advance(7, 2)));
}

TEST(LockStep, WaitsAsLongAsTheLeastPatientMember) {
  LockStep lock_step;
  lock_step.join(7, 100);
  lock_step.join(3, 200);
  EXPECT_EQ(lock_step.timeout_ns(), 100);
  lock_step.join(7, 500);  // another one
  EXPECT_EQ(lock_step.timeout_ns(), 200);
  EXPECT_EQ(lock_step.size(), 2u);
}

TEST(LockStep, WhoLeavesIsNoLongerWaitedFor) {
  LockStep lock_step;
  lock_step.join(7, 100);
  lock_step.join(3, 200);
  lock_step.offer(advance(3, 9));
  EXPECT_FALSE(lock_step.leave(7));
  EXPECT_TRUE(lock_step.ready());
  const auto pending = lock_step.leave(3);
  ASSERT_TRUE(pending);
  EXPECT_EQ(pending->seq, 9u);
  EXPECT_TRUE(lock_step.empty());
  EXPECT_FALSE(lock_step.leave(3));
}

}  // namespace
}  // namespace poinsot
