// What a reader asks of the streams, and gets: thinned out, only what moved, contacts, measured.

#include <chrono>

#include <gtest/gtest.h>

#include "system/free_world.h"

namespace poinsot {
namespace {

using Clock = std::chrono::steady_clock;

class Streams : public testing::Test {
 protected:
  Streams() { world_.start({}); }
  FreeWorld world_;
};

TEST_F(Streams, OfFewFramesASecondAreWholeFrames) {
  constexpr int kFrames = 5;
  constexpr double kRate = 2;  // [Hz]
  const auto start = Clock::now();
  Watcher watcher({"--rate", std::to_string(kRate), "-n", std::to_string(kFrames)});
  int last = -1;
  for (int i = 0; i < kFrames; ++i) {
    const Json frame = watcher.next();
    EXPECT_EQ(frame["bodies"].size(), 2u);
    EXPECT_GT(frame["frame"], last);
    last = frame["frame"];
  }
  EXPECT_EQ(watcher.wait(), 0);
  // The first may come between two periods, and the second early after it.
  EXPECT_GE(Clock::now() - start, std::chrono::duration<double>((kFrames - 2) / kRate));
}

TEST_F(Streams, WithADeadbandTellOnlyWhatMovedByMore) {
  constexpr double kBand = 0.01;  // [m]
  Watcher watcher({"--deadband", std::to_string(kBand)});
  const Json first = watcher.next();
  ASSERT_EQ(first["bodies"].size(), 2u) << "who comes gets all";
  EXPECT_FALSE(first.contains("complete"));
  // Less than half of the band in a frame.
  FreeWorld::json({"set", "probe", "--velocity", "0.27,0,0"});
  double last = first["bodies"][0]["position"][0];
  for (int i = 0; i < 10; ++i) {
    const Json frame = watcher.next();
    EXPECT_EQ(frame["complete"], false);
    ASSERT_EQ(frame["bodies"].size(), 1u) << frame;
    EXPECT_EQ(frame["bodies"][0]["name"], "probe");
    const double x = frame["bodies"][0]["position"][0];
    EXPECT_GT(x - last, kBand);
    last = x;
  }
}

TEST_F(Streams, ThatMatchAPatternFollowSpawnedBodies) {
  Watcher watcher({"--match", "by*,new?"});
  EXPECT_EQ(watcher.next()["bodies"].size(), 1u);
  const TemporaryFile fragment(
      "new.yaml",
      "bodies: [{name: new1, shape: {sphere: 0.1}, mass: 1, position: [0, 20, 0]}, {name: new10, "
      "shape: {sphere: 0.1}, mass: 1, position: [0, 30, 0]}]\n");
  FreeWorld::json({"spawn", fragment.path()});
  Json bodies;
  for (int frames = 0; frames < 600 && bodies.size() < 2; ++frames)
    bodies = watcher.next()["bodies"];
  ASSERT_EQ(bodies.size(), 2u);
  EXPECT_EQ(bodies[0]["name"], "bystander");
  EXPECT_EQ(bodies[1]["name"], "new1");
}

TEST_F(Streams, AreMeasuredByTopic) {
  for (const std::string topic : {"poses", "report"}) {
    const Json rate = FreeWorld::json({"hz", topic, "-n", "1"});
    EXPECT_EQ(rate["topic"], topic);
    EXPECT_GT(rate["samples"], 0) << topic;
    EXPECT_GE(rate["period"]["max"], rate["period"]["p50"]) << topic;
  }
  const Json none = FreeWorld::json({"hz", "events", "-n", "1"});
  EXPECT_EQ(none["samples"], 0) << "nothing hits anything";
  const Json age = FreeWorld::json({"delay", "-n", "10"});
  EXPECT_EQ(age["frames"], 10);
  EXPECT_GT(age["age"]["p50"], 0.0);
  EXPECT_GE(age["age"]["max"], age["age"]["p99"]);
  const Json seen = FreeWorld::json({"delay", "--push", "probe", "-n", "2"});
  EXPECT_EQ(seen["pushes"], 2);
  EXPECT_GE(seen["frames"]["p50"], 1.0);
  EXPECT_EQ(FreeWorld::run({"delay", "--push", "prob", "-n", "2"}).code, 2);
}

TEST_F(Streams, OfContactsAreThereWithoutContacts) {
  const Json frame = FreeWorld::json({"contacts", "-n", "1"});
  EXPECT_EQ(frame["contacts"], Json::array());
  EXPECT_EQ(frame["left_out"], 0);
}

TEST_F(Streams, AtAnotherScaleGoOnAtOnceFromWhereTheyAre) {
  FreeWorld::json({"scale", "2"});
  EXPECT_EQ(FreeWorld::json({"status"})["time_scale"], 2.0);
  FreeWorld::json({"pause"});
  const int frame = FreeWorld::json({"step", "7"})["frame"];
  const std::string time = std::to_string((frame + 30) / 60.0 - 0.001) + "s";
  EXPECT_EQ(FreeWorld::json({"until", time})["frame"], frame + 30);
  EXPECT_EQ(FreeWorld::json({"status"})["state"], "paused");
  // A time that has passed is reached.
  EXPECT_EQ(FreeWorld::json({"until", "0s"})["frame"], frame + 30);
}

}  // namespace
}  // namespace poinsot
