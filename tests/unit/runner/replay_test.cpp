#include "poinsot/runner/replay.h"

#include <fstream>
#include <map>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "poinsot/base/error.h"
#include "poinsot/runner/checkpoint_file.h"
#include "poinsot/runner/run_offline.h"
#include "support/recorded_run.h"
#include "support/temp_path.h"

namespace poinsot {
namespace {

using test::boxes;
using test::order;
using test::push;
using test::RecordedRun;
using test::remove;
using test::replayed;
using test::spawn;

std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

TEST(Replay, AllFramesHaveTheRecordedHash) {
  const auto file = test::temp_path("pushed.log");
  RecordedRun run(boxes());
  run.record(file);
  run.frames(30);
  run.tell(push("box1", Vec3(30, 1, 0)));
  run.frames(30);
  run.tell(push("nobody", Vec3(1, 0, 0)));  // is refused, then and now
  run.frames(60);
  ASSERT_TRUE(run.stop_recording());

  const ReplayResult result = replayed(file);
  EXPECT_FALSE(result.difference) << to_text(result);
  EXPECT_EQ(result.frames, 120u);
  EXPECT_EQ(result.commands, 2u);
  EXPECT_EQ(result.refused, 1u);
  EXPECT_EQ(result.sim_time, 2);
  EXPECT_EQ(to_text(result).rfind("all 120 frames have the recorded hash\n", 0), 0u);
}

TEST(Replay, NamesTheFirstFrameThatDiffers) {
  const auto file = test::temp_path("altered.log");
  RecordedRun run(boxes());
  run.record(file);
  run.frames(30);
  run.tell(push("box1", Vec3(30, 1, 0)));
  run.frames(30);
  ASSERT_TRUE(run.stop_recording());
  std::string text = text_of(file);
  const std::size_t at = text.find("[30.0,1.0,0.0]");
  ASSERT_NE(at, std::string::npos);
  text.replace(at + 1, 4, "30.000000000000004");
  std::ofstream(file, std::ios::binary) << text;

  const ReplayResult result = replayed(file);
  ASSERT_TRUE(result.difference);
  EXPECT_EQ(result.difference->recorded.frame, 31u);
  EXPECT_EQ(result.difference->found.frame, 31u);
  EXPECT_NE(result.difference->found.hash, result.difference->recorded.hash);
  EXPECT_EQ(result.difference->where, file.string() + ":33");
  EXPECT_EQ(result.frames, 31u);
  const std::string said = to_text(result);
  EXPECT_EQ(said.rfind("frame 31 differs (" + file.string() + ":33): recorded ", 0), 0u) << said;
  EXPECT_NE(said.find("the 30 frames before it are the same"), std::string::npos) << said;
}

TEST(Replay, BeginsInTheMiddleOfARun) {
  const auto file = test::temp_path("middle.log");
  RecordedRun run(boxes());
  run.tell(push("box0", Vec3(5, 0, 2)));
  run.frames(20);
  run.tell(spawn("bodies: [{name: ball, density: 10, shape: {sphere: 0.4}, position: [0, 3, 1]}]"));
  run.tell(order(ControlAction::save, "kept"));
  run.frames(20);
  run.tell(order(ControlAction::reset));
  run.frames(20);
  run.tell(spawn("bodies: [{name: ball, density: 10, shape: {sphere: 0.4}, position: [0, 4, 1]}]"));
  run.tell(push("ball", Vec3(1, 2, 3)));
  run.frames(10);
  run.record(file);
  WrenchCommand to_this_epoch = push("ball", Vec3(1, -2, 3));
  to_this_epoch.epoch = run.layer().epoch();
  run.tell(to_this_epoch);
  run.frames(10);
  run.tell(order(ControlAction::restore, "kept"));  // saved before the log began
  run.frames(10);
  run.tell(order(ControlAction::reset));  // to the scene without the ball
  run.frames(10);
  run.tell(push("ball", Vec3(1, 2, 3)));
  run.turn();
  run.frames(10);
  ASSERT_TRUE(run.stop_recording());

  const ReplayResult result = replayed(file);
  EXPECT_FALSE(result.difference) << to_text(result);
  EXPECT_EQ(result.frames, 40u);
  EXPECT_EQ(result.refused, 1u);
}

TEST(Replay, OfACutLogGoesAsFarAsItDoes) {
  const auto file = test::temp_path("cut_replay.log");
  RecordedRun run(boxes());
  run.record(file);
  run.frames(30);
  ASSERT_TRUE(run.stop_recording());
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - 60);
  const ReplayResult result = replayed(file);
  EXPECT_FALSE(result.difference);
  EXPECT_EQ(result.frames, 28u);
  EXPECT_TRUE(result.cut);
  EXPECT_NE(to_text(result).find("the log was cut: it has no end\n"), std::string::npos);
}

TEST(Replay, SaysItInJson) {
  ReplayResult result;
  result.frames = 7;
  result.difference = {{6, 1}, {6, 0xff}, "a.log:8"};
  EXPECT_EQ(to_json(result),
            R"({"frames":7,"commands":0,"refused":0,"same":false,"cut":false,"stopped":false,)"
            R"("sim_time":0.0,"wall_s":0.0,"first_difference":{"frame":6,)"
            R"("recorded":"0000000000000001","found":"00000000000000ff","where":"a.log:8"}})"
            "\n");
}

TEST(Replay, WritesTheTrajectoryOfBodiesThatComeAndGo) {
  const auto file = test::temp_path("come_and_go.log"), table = test::temp_path("come_and_go.csv");
  RecordedRun run(boxes());
  run.record(file);
  run.tell(remove("box3"));
  run.frames(1);
  run.tell(spawn("bodies: [{name: 'a, b', static: true}, {name: c, static: true}]"));
  run.frames(1);
  ASSERT_TRUE(run.stop_recording());
  ASSERT_FALSE(replayed(file, {.threads = 0, .trajectory = table}).difference);
  std::ifstream in(table);
  std::map<std::string, std::string> bodies;  // of each frame
  for (std::string line; std::getline(in, line);) {
    const std::size_t name = line.find(',', line.find(',') + 1) + 1;
    const std::size_t end = line.find(line[name] == '"' ? "\"," : ",", name);
    bodies[line.substr(0, line.find(','))] += line.substr(name, end - name) + " ";
  }
  EXPECT_EQ(bodies["0"], "ground box0 box1 box2 box3 ");
  EXPECT_EQ(bodies["1"], "ground box0 box1 box2 ");
  EXPECT_EQ(bodies["2"], "ground box0 box1 box2 \"a, b c ");
}

// Offline ----------------------------------------------------------------------------------------

TEST(RunOffline, RecordsALogThatReplays) {
  const auto file = test::temp_path("offline.log");
  const RunSummary summary = run_offline(boxes(), {.frames = 90, .record = file}, {});
  const ReplayResult result = replayed(file);
  EXPECT_FALSE(result.difference) << to_text(result);
  EXPECT_EQ(result.frames, 90u);
  EXPECT_EQ(summary.frames, 90u);
}

TEST(RunOffline, DoesWhatALogSaysAndRecordsItAgain) {
  const auto file = test::temp_path("told.log"), again = test::temp_path("again.log");
  RecordedRun run(boxes());
  run.record(file);
  run.frames(10);
  run.tell(push("box2", Vec3(10, 0, 40)));
  run.frames(50);
  ASSERT_TRUE(run.stop_recording());

  const RunSummary summary = run_offline(boxes(), {.commands = file, .record = again}, {});
  EXPECT_EQ(summary.frames, 60u);
  EXPECT_EQ(summary.state_hash, run.layer().snapshot().state_hash);
  EXPECT_FALSE(replayed(again).difference);
  EXPECT_EQ(replayed(again).commands, 1u);
  // Frames beyond the log, and fewer than it has.
  EXPECT_EQ(run_offline(boxes(), {.frames = 100, .commands = file}, {}).frames, 100u);
  EXPECT_EQ(run_offline(boxes(), {.frames = 5, .commands = file}, {}).frames, 5u);
}

TEST(RunOffline, RefusesALogThatBeginsLater) {
  const auto file = test::temp_path("later.log");
  RecordedRun run(boxes());
  run.frames(3);
  run.record(file);
  run.frames(3);
  ASSERT_TRUE(run.stop_recording());
  EXPECT_THROW(run_offline(boxes(), {.commands = file}, {}), Error);
}

TEST(RunOffline, RefusesALogThatCannotBeCreated) {
  EXPECT_THROW(run_offline(boxes(), {.frames = 1, .record = "/proc/none/x.log"}, {}), Error);
}

}  // namespace
}  // namespace poinsot
