#include "poinsot/service/outbox.h"

#include <atomic>
#include <thread>

#include <gtest/gtest.h>

#include "support/allocation_counter.h"

namespace poinsot {
namespace {

using namespace std::chrono_literals;

PoseSnapshot snapshot(std::uint64_t frame, std::size_t bodies = 3) {
  PoseSnapshot s;
  s.frame = frame;
  s.bodies.resize(bodies);
  return s;
}

TEST(Outbox, HandsOverSnapshotsInOrder) {
  Outbox outbox(3);
  outbox.set_poses_wanted(true);
  for (std::uint64_t frame = 1; frame <= 5; ++frame) outbox.push(snapshot(frame));
  PoseSnapshot taken;
  for (std::uint64_t frame = 1; frame <= 5; ++frame) {
    ASSERT_TRUE(outbox.take(taken));
    EXPECT_EQ(taken.frame, frame);
    EXPECT_EQ(taken.bodies.size(), 3u);
  }
  EXPECT_FALSE(outbox.take(taken));
  EXPECT_EQ(outbox.snapshots_dropped(), 0u);
}

TEST(Outbox, DropsTheOldestSnapshotAndCounts) {
  Outbox outbox(3);
  outbox.set_poses_wanted(true);
  for (std::uint64_t frame = 1; frame <= Outbox::kSnapshots + 2; ++frame)
    outbox.push(snapshot(frame));
  EXPECT_EQ(outbox.snapshots_dropped(), 2u);
  PoseSnapshot taken;
  ASSERT_TRUE(outbox.take(taken));
  EXPECT_EQ(taken.frame, 3u);
}

TEST(Outbox, KeepsOnlyTheNewestSnapshotWhileNobodyReads) {
  Outbox outbox(3);
  for (std::uint64_t frame = 1; frame <= 100; ++frame) outbox.push(snapshot(frame));
  EXPECT_EQ(outbox.snapshots_dropped(), 0u);
  PoseSnapshot taken;
  ASSERT_TRUE(outbox.take(taken));
  EXPECT_EQ(taken.frame, 100u);
  EXPECT_FALSE(outbox.take(taken));
}

TEST(Outbox, RepliesKeepTheirOrderAndHaveABound) {
  Outbox outbox(0);
  Reply reply;
  for (std::uint64_t n = 1; n <= Outbox::kReplies + 5; ++n) {
    reply.seq = n;
    outbox.push(reply);
  }
  EXPECT_EQ(outbox.replies_dropped(), 5u);
  std::vector<Reply> taken;
  ASSERT_TRUE(outbox.take(taken));
  ASSERT_EQ(taken.size(), Outbox::kReplies);
  EXPECT_EQ(taken.front().seq, 1u);
  EXPECT_EQ(taken.back().seq, Outbox::kReplies);
  EXPECT_FALSE(outbox.take(taken));
}

TEST(Outbox, OfReportsOnlyTheNewestCounts) {
  Outbox outbox(0);
  RunReport report;
  EXPECT_FALSE(outbox.take(report));
  report.frame.frame = 1;
  outbox.push(report);
  report.frame.frame = 2;
  outbox.push(report);
  RunReport taken;
  ASSERT_TRUE(outbox.take(taken));
  EXPECT_EQ(taken.frame.frame, 2u);
  EXPECT_FALSE(outbox.take(taken));
  EXPECT_EQ(outbox.newest_report().frame.frame, 2u);
}

TEST(Outbox, WaitEndsWithAReplyAndOtherwiseAfterTheTimeOut) {
  Outbox outbox(0);
  const auto start = std::chrono::steady_clock::now();
  outbox.wait({}, 30ms);
  EXPECT_GE(std::chrono::steady_clock::now() - start, 29ms);
  outbox.push(Reply{});
  outbox.wait({}, 1h);  // returns, or the test times out
}

TEST(Outbox, SnapshotsTravelWithoutAllocating) {
  if (!test::can_count_allocations()) GTEST_SKIP() << "the sanitizer owns malloc";
  Outbox outbox(50);
  outbox.set_poses_wanted(true);
  const PoseSnapshot original = snapshot(1, 50);
  PoseSnapshot taken;
  taken.bodies.reserve(50);
  const std::size_t before = test::allocations();
  for (int n = 0; n < 100; ++n) {
    outbox.push(original);
    if (n % 3 != 0) outbox.take(taken);
  }
  EXPECT_EQ(test::allocations() - before, 0u);
}

TEST(Outbox, ReportsTravelWithoutAllocating) {
  if (!test::can_count_allocations()) GTEST_SKIP() << "the sanitizer owns malloc";
  Outbox outbox(50);
  RunReport original;
  original.body_methods.assign(50, Method::flight);
  RunReport taken;
  taken.body_methods.reserve(50);
  const std::size_t before = test::allocations();
  for (int n = 0; n < 10; ++n) {
    outbox.push(original);
    outbox.take(taken);
  }
  EXPECT_EQ(test::allocations() - before, 0u);
  EXPECT_EQ(taken.body_methods, original.body_methods);
}

// Also for the thread sanitizer.
ImpactNotice impact(std::uint64_t frame) {
  ImpactNotice notice;
  notice.frame = frame;
  return notice;
}

TEST(Outbox, TakesNoImpactsWhileNobodyReadsThem) {
  Outbox outbox(0);
  std::vector<ImpactNotice> taken;
  outbox.push(std::vector{impact(1)});
  EXPECT_FALSE(outbox.take(taken));
  EXPECT_EQ(outbox.impacts_dropped(), 0u);
}

TEST(Outbox, ImpactsKeepTheirOrderAndHaveABound) {
  Outbox outbox(0);
  outbox.set_impacts_wanted(true);
  std::vector<ImpactNotice> frame, taken;
  for (std::uint64_t n = 0; n < 100; ++n) frame.push_back(impact(n));
  constexpr std::uint64_t kFrames = Outbox::kImpacts / 100 + 1;
  for (std::uint64_t n = 0; n < kFrames; ++n) outbox.push(frame);
  EXPECT_EQ(outbox.impacts_dropped(), kFrames * 100 - Outbox::kImpacts);
  ASSERT_TRUE(outbox.take(taken));
  ASSERT_EQ(taken.size(), Outbox::kImpacts);
  for (std::size_t i = 0; i < taken.size(); ++i) ASSERT_EQ(taken[i].frame, i % 100);
  EXPECT_FALSE(outbox.take(taken));
}

TEST(Outbox, AnImpactWakesTheWriter) {
  Outbox outbox(0);
  outbox.set_impacts_wanted(true);
  EXPECT_FALSE(outbox.wait({}, 1ms));
  outbox.push(std::vector{impact(1)});
  EXPECT_TRUE(outbox.wait({}, 0ms));
}

TEST(Outbox, ImpactsInSteadyStateDoNotAllocate) {
  if (!test::can_count_allocations()) GTEST_SKIP() << "allocations are not counted here";
  Outbox outbox(0);
  outbox.set_impacts_wanted(true);
  const std::vector<ImpactNotice> frame(200);
  std::vector<ImpactNotice> taken;
  taken.reserve(Outbox::kImpacts);
  const std::size_t before = test::allocations();
  for (int n = 0; n < 100; ++n) {
    outbox.push(frame);
    outbox.take(taken);
  }
  EXPECT_EQ(test::allocations(), before);
}

TEST(Outbox, LoopAndWriterMeetWithoutLosingReplies) {
  Outbox outbox(10);
  outbox.set_poses_wanted(true);
  constexpr std::uint64_t kFrames = 20'000;
  std::atomic<bool> done = false;
  std::jthread loop([&] {
    Reply reply;
    for (std::uint64_t n = 1; n <= kFrames; ++n) {
      outbox.push(snapshot(n, 10));
      reply.seq = n;
      outbox.push(reply);
      outbox.push(RunReport{});
    }
    done = true;
  });
  std::uint64_t newest = 0, snapshots = 0, replies = 0;
  PoseSnapshot taken;
  std::vector<Reply> batch;
  RunReport report;
  for (bool last = false; !last;) {
    last = done;
    outbox.wait({}, 1ms);
    for (; outbox.take(taken); ++snapshots) {
      ASSERT_GT(taken.frame, newest);
      newest = taken.frame;
    }
    if (outbox.take(batch)) replies += batch.size();
    outbox.take(report);
  }
  EXPECT_EQ(newest, kFrames);
  EXPECT_EQ(snapshots + outbox.snapshots_dropped(), kFrames);
  EXPECT_EQ(replies + outbox.replies_dropped(), kFrames);
}

}  // namespace
}  // namespace poinsot
