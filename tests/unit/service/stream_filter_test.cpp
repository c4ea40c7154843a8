#include "poinsot/service/stream_filter.h"

#include <gtest/gtest.h>

#include "poinsot/math/rotation.h"

namespace poinsot {
namespace {

const std::vector<NamedBody> kBodies = {{{0, 1}, "floor"}, {{1, 1}, "box1"}, {{2, 1}, "box2"}};
constexpr std::int64_t kSecond = 1'000'000'000;

PoseSnapshot frame(std::uint64_t n) {
  PoseSnapshot snapshot;
  snapshot.epoch = 1;
  snapshot.frame = n;
  snapshot.bodies.resize(2);
  snapshot.bodies[0].id = {1, 1};
  snapshot.bodies[1].id = {2, 1};
  return snapshot;
}

StreamFilter filter_of(const PoseFilter& what) {
  StreamFilter filter(what);
  filter.set_bodies(kBodies);
  return filter;
}

TEST(StreamFilter, SendsTheBodiesThatMatch) {
  StreamFilter filter = filter_of({.match = "*2"});
  PoseSnapshot out;
  ASSERT_TRUE(filter.take(frame(3), 0, out));
  EXPECT_EQ(out.frame, 3u);
  EXPECT_EQ(out.total, 1u);
  EXPECT_TRUE(out.complete);
  ASSERT_EQ(out.bodies.size(), 1u);
  EXPECT_EQ(out.bodies[0].id, (BodyId{2, 1}));
}

TEST(StreamFilter, ABodyInTheSlotOfAnotherIsNotTakenForIt) {
  StreamFilter filter = filter_of({.match = "box2"});
  PoseSnapshot later = frame(1), out;
  later.bodies[1].id.generation = 2;
  ASSERT_TRUE(filter.take(later, 0, out));
  EXPECT_EQ(out.total, 0u);
  filter.set_bodies(std::vector<NamedBody>{{{2, 2}, "box2"}});
  later.frame = 2;
  ASSERT_TRUE(filter.take(later, 0, out));
  EXPECT_EQ(out.total, 1u);
}

TEST(StreamFilter, SendsAFrameOnce) {
  StreamFilter filter = filter_of({.match = "*"});
  PoseSnapshot out;
  EXPECT_TRUE(filter.take(frame(1), 0, out));
  EXPECT_FALSE(filter.take(frame(1), kSecond, out));
  filter.join();
  EXPECT_TRUE(filter.take(frame(1), kSecond, out));
}

// 60 frames a second for 10 s, 7 wanted: evenly spaced to a frame.
TEST(StreamFilter, KeepsToItsRate) {
  StreamFilter filter = filter_of({.rate = 7});
  PoseSnapshot out;
  std::vector<std::int64_t> sent;
  for (std::int64_t n = 0; n < 600; ++n)
    if (filter.take(frame(static_cast<std::uint64_t>(n)), n * kSecond / 60, out)) sent.push_back(n);
  EXPECT_NEAR(static_cast<double>(sent.size()), 70, 1);
  for (std::size_t k = 2; k < sent.size(); ++k) {
    EXPECT_GE(sent[k] - sent[k - 1], 8);
    EXPECT_LE(sent[k] - sent[k - 1], 9);
  }
}

TEST(StreamFilter, TheNewestFrameIsSentWhenItsTimeHasCome) {
  StreamFilter filter = filter_of({.rate = 1});
  PoseSnapshot out;
  EXPECT_TRUE(filter.take(frame(1), 0, out));
  EXPECT_FALSE(filter.take(frame(2), kSecond / 2, out));
  EXPECT_TRUE(filter.take(frame(2), kSecond, out));
  EXPECT_EQ(out.frame, 2u);
}

TEST(StreamFilter, AfterAPauseItDoesNotMakeUp) {
  StreamFilter filter = filter_of({.rate = 10});
  PoseSnapshot out;
  int sent = 0;
  filter.take(frame(1), 0, out);
  for (std::uint64_t n = 2; n < 62; ++n)
    sent += filter.take(frame(n), 100 * kSecond + static_cast<std::int64_t>(n) * kSecond / 60, out);
  EXPECT_LE(sent, 11);
}

TEST(StreamFilter, SendsWhatMovedOrTurnedEnough) {
  StreamFilter filter = filter_of({.change = 0.1});
  PoseSnapshot out, next = frame(1);
  ASSERT_TRUE(filter.take(next, 0, out));
  EXPECT_TRUE(out.complete);
  next.frame = 2;
  next.bodies[0].position.x() = 0.09;  // and again: small steps add up
  EXPECT_FALSE(filter.take(next, 0, out));
  next.frame = 3;
  next.bodies[0].position.x() = 0.11;
  ASSERT_TRUE(filter.take(next, 0, out));
  EXPECT_FALSE(out.complete);
  EXPECT_EQ(out.total, 2u);
  ASSERT_EQ(out.bodies.size(), 1u);
  EXPECT_EQ(out.bodies[0].id, (BodyId{1, 1}));
  next.frame = 4;
  next.bodies[1].orientation = Quat(Eigen::AngleAxisd(0.11, Vec3::UnitX()));
  next.bodies[0].orientation.coeffs() *= -1;  // the same orientation
  ASSERT_TRUE(filter.take(next, 0, out));
  ASSERT_EQ(out.bodies.size(), 1u);
  EXPECT_EQ(out.bodies[0].id, (BodyId{2, 1}));
}

TEST(StreamFilter, AResetIsACompleteSample) {
  StreamFilter filter = filter_of({.change = 1});
  PoseSnapshot out, next = frame(5);
  ASSERT_TRUE(filter.take(next, 0, out));
  next.epoch = 2;
  next.frame = 0;
  ASSERT_TRUE(filter.take(next, 0, out));
  EXPECT_TRUE(out.complete);
  EXPECT_EQ(out.bodies.size(), 2u);
}

}  // namespace
}  // namespace poinsot
