// A reader that is stopped must not hold up its writer, nor other readers.

#include <signal.h>

#include <gtest/gtest.h>

#include "bus/roles.h"
#include "poinsot/wire/publisher.h"
#include "support/child_process.h"
#include "support/protocol_samples.h"
#include "support/test_domain.h"

namespace poinsot {
namespace {

using namespace std::chrono_literals;

struct Frame {
  int index = -1;
  int bodies = 0;
  bool good = false;
};

Frame parse(const std::string& line) {
  Frame frame;
  char word[8] = "";
  if (std::sscanf(line.c_str(), "%d %d %7s", &frame.index, &frame.bodies, word) != 3) return {};
  frame.good = std::string(word) == "good";
  return frame;
}

TEST(StoppedReader, DoesNotHoldUpTheWriterNorAnotherReader) {
  constexpr std::size_t kBodies = 1000;
  constexpr int kFrames = 180;
  Participant participant({.domain = test_domain(), .bodies = kBodies});
  Publisher<PoseSnapshot> poses(participant, "stopped");
  ChildProcess stopped(role("read_poses", "stopped", kFrames));
  ChildProcess running(role("read_poses", "stopped", kFrames));
  ASSERT_EQ(stopped.read_line(), "ready");
  ASSERT_EQ(running.read_line(), "ready");
  ASSERT_TRUE(eventually([&] { return poses.readers() == 2; }));

  stopped.signal(SIGSTOP);
  PoseSnapshot frame = sample::poses(1, kBodies);
  int slow = 0;  // writes that took half the blocking time or more
  for (; frame.frame <= kFrames; ++frame.frame) {
    const auto start = std::chrono::steady_clock::now();
    EXPECT_TRUE(poses.write(frame)) << frame.frame;
    slow += std::chrono::steady_clock::now() - start >= 5ms / 2 ? 1 : 0;
    std::this_thread::sleep_for(5ms);
  }
  // A writer that waits does so for its blocking time, 5 ms, in each frame once its history is
  // full; one that the machine holds up does so now and then.
  EXPECT_LT(slow, kFrames / 2);

  // The other misses none, unless the machine holds it up for as long as four frames, the history.
  int arrived = 0;
  for (int index = 0; index < kFrames;) {
    const Frame received = parse(running.read_line());
    ASSERT_GT(received.index, index);
    index = received.index;
    ++arrived;
    EXPECT_EQ(received.bodies, static_cast<int>(kBodies));
    EXPECT_TRUE(received.good);
  }
  EXPECT_GE(arrived, kFrames * 9 / 10);
  EXPECT_EQ(running.wait(), 0);

  // The stopped one goes on where the stream is now.
  stopped.signal(SIGCONT);
  Frame last;
  EXPECT_TRUE(eventually([&] {
    frame.frame = kFrames;
    poses.write(frame);
    last = parse(stopped.read_line());
    return last.index == kFrames;
  }));
  EXPECT_TRUE(last.good);
}

TEST(LargeFrame, OfTenThousandBodiesArrivesComplete) {
  constexpr std::size_t kBodies = 10000;
  constexpr int kFrames = 20;
  Participant participant({.domain = test_domain(), .bodies = kBodies});
  Publisher<PoseSnapshot> poses(participant, "large");
  ChildProcess reader(role("read_poses", "large", kFrames));
  ASSERT_EQ(reader.read_line(), "ready");
  ASSERT_TRUE(eventually([&] { return poses.readers() == 1; }));
  PoseSnapshot frame = sample::poses(1, kBodies);
  for (; frame.frame <= kFrames; ++frame.frame) {
    ASSERT_TRUE(poses.write(frame));
    std::this_thread::sleep_for(30ms);
  }
  for (int index = 1; index <= kFrames; ++index) {
    const Frame received = parse(reader.read_line());
    ASSERT_EQ(received.index, index);
    EXPECT_EQ(received.bodies, static_cast<int>(kBodies));
    EXPECT_TRUE(received.good);
  }
  EXPECT_EQ(reader.wait(), 0);
}

}  // namespace
}  // namespace poinsot
