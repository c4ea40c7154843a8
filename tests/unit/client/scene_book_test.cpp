#include "poinsot/client/scene_book.h"

#include <gtest/gtest.h>

namespace poinsot {
namespace {

BodyInfo body(std::uint64_t session, std::uint32_t slot, std::uint32_t revision = 1) {
  BodyInfo info;
  info.session = session;
  info.id = {slot, 1};
  info.index = slot;
  info.revision = revision;
  return info;
}

BodyInfo removed(std::uint64_t session, std::uint32_t slot) {
  BodyInfo info;
  info.session = session;
  info.id = {slot, 1};
  info.removed = true;
  return info;
}

RunReport report(std::uint64_t session, std::uint32_t bodies, std::uint32_t revision,
                 std::uint64_t frame = 0) {
  RunReport report;
  report.session = session;
  report.epoch = 1;
  report.frame.frame = frame;
  report.scene_bodies = bodies;
  report.scene_revision = revision;
  return report;
}

PoseSnapshot poses(std::uint64_t session, std::uint64_t frame,
                   const std::vector<std::uint32_t>& slots) {
  PoseSnapshot poses;
  poses.session = session;
  poses.epoch = 1;
  poses.frame = frame;
  for (const std::uint32_t slot : slots) {
    BodyState state;
    state.id = {slot, 1};
    poses.bodies.push_back(state);
  }
  return poses;
}

TEST(SceneBook, IsCompleteWithAsManyBodiesAsReported) {
  SceneBook book;
  book.add(body(7, 0));
  book.add(body(7, 1));
  EXPECT_FALSE(book.is_complete()) << "nobody has said how many there are";
  book.add(report(7, 3, 5));
  EXPECT_FALSE(book.is_complete());
  EXPECT_EQ(book.expected(), 3u);
  book.add(body(7, 4));
  EXPECT_TRUE(book.is_complete()) << "what was removed before is not told";
  ASSERT_EQ(book.bodies().size(), 3u);
  EXPECT_EQ(book.bodies()[2].id.slot, 4u);
}

TEST(SceneBook, AnEmptySceneIsComplete) {
  SceneBook book;
  book.add(report(7, 0, 1));
  EXPECT_TRUE(book.is_complete());
}

TEST(SceneBook, FollowsSpawnsAndRemovals) {
  SceneBook book;
  book.add(report(7, 2, 1));
  book.add(body(7, 0));
  book.add(body(7, 1));
  ASSERT_TRUE(book.is_complete());
  book.add(report(7, 3, 2));
  EXPECT_FALSE(book.is_complete());
  book.add(body(7, 2, 2));
  EXPECT_TRUE(book.is_complete());
  book.add(report(7, 2, 3));
  EXPECT_FALSE(book.is_complete());
  book.add(removed(7, 0));
  EXPECT_TRUE(book.is_complete());
  EXPECT_EQ(book.bodies().front().id.slot, 1u);
}

TEST(SceneBook, AnEqualNumberIsNotEnoughWhileTheLastBodyIsMissing) {
  SceneBook book;
  book.add(report(7, 2, 1));
  book.add(body(7, 0));
  book.add(body(7, 1));
  book.add(report(7, 2, 3));  // one removed, one spawned
  EXPECT_FALSE(book.is_complete());
  book.add(removed(7, 0));
  EXPECT_FALSE(book.is_complete());
  book.add(body(7, 2, 3));
  EXPECT_TRUE(book.is_complete());
}

TEST(SceneBook, WhoJoinsLaterDoesNotWaitForWordOfEarlierRemovals) {
  SceneBook book;
  book.add(report(7, 3, 1));
  book.add(report(7, 2, 4));  // one removed long ago
  book.join();
  book.add(body(7, 0));
  EXPECT_FALSE(book.is_complete());
  book.add(body(7, 1));
  EXPECT_TRUE(book.is_complete());
}

TEST(SceneBook, WaitsForABodyThatWasSeenInAFrame) {
  SceneBook book;
  book.add(report(7, 1, 1, 10));
  book.add(body(7, 0));
  book.add(poses(7, 11, {0, 1}));
  EXPECT_FALSE(book.is_complete()) << "a body of frame 11 is unknown, and no report is as new";
  book.add(report(7, 2, 2, 11));
  EXPECT_FALSE(book.is_complete());
  book.add(body(7, 1, 2));
  EXPECT_TRUE(book.is_complete());
}

TEST(SceneBook, DoesNotWaitForABodyThatIsGoneSince) {
  SceneBook book;
  book.add(report(7, 1, 1, 10));
  book.add(body(7, 0));
  book.add(poses(7, 11, {0, 1}));
  book.add(report(7, 1, 3, 12));
  book.add(body(7, 1, 2));
  book.add(removed(7, 1));
  EXPECT_TRUE(book.is_complete());
}

TEST(SceneBook, LooksAtTheDaemonWhosePosesOrReportCameLast) {
  SceneBook book;
  book.add(report(7, 1, 1));
  book.add(body(7, 0));
  book.add(body(8, 0));
  book.add(body(8, 1));
  EXPECT_EQ(book.bodies().size(), 1u);
  book.add(report(8, 2, 1));
  EXPECT_TRUE(book.is_complete());
  EXPECT_EQ(book.bodies().front().session, 8u);
}

}  // namespace
}  // namespace poinsot
