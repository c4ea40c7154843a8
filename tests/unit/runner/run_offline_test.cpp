#include "poinsot/runner/run_offline.h"

#include <filesystem>
#include <fstream>
#include <thread>

#include <gtest/gtest.h>

#include "poinsot/base/error.h"
#include "support/scene_builder.h"
#include "support/temp_path.h"

namespace poinsot {
namespace {

Scene one_box() {
  Scene scene = test::empty_scene();
  scene.bodies = {test::floor(), test::box("box", Vec3(0, 0, 1))};
  return scene;
}

TEST(RunOffline, EndsAfterTheFramesWithTheHashOfAnyOtherRun) {
  const RunSummary summary = run_offline(one_box(), {.frames = 90, .trajectory = {}}, {});
  PresentationLayer layer(one_box());
  for (int n = 0; n < 90; ++n) layer.advance_frame();
  EXPECT_EQ(summary.frames, 90u);
  EXPECT_EQ(summary.sim_time, 1.5);
  EXPECT_EQ(summary.last.bodies, 1u);
  EXPECT_EQ(summary.state_hash, layer.snapshot().state_hash);
  EXPECT_GT(summary.wall_s, 0);
}

TEST(RunOffline, WithoutAFrameCountItRunsUntilStopped) {
  std::stop_source stop;
  std::jthread stopper([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    stop.request_stop();
  });
  const RunSummary summary = run_offline(one_box(), {}, stop.get_token());
  EXPECT_GT(summary.frames, 0u);
}

TEST(RunOffline, WritesTheTrajectoryFromFrameZero) {
  const auto file = test::temp_path("offline.csv");
  run_offline(one_box(), {.frames = 3, .trajectory = file}, {});
  std::ifstream in(file);
  int lines = 0;
  std::string last;
  for (std::string line; std::getline(in, line); last = line) ++lines;
  EXPECT_EQ(lines, 1 + 4 * 2);
  EXPECT_EQ(last.rfind("3,0.050000000000000003,box,", 0), 0u) << last;
}

TEST(RunOffline, RefusesATrajectoryThatCannotBeCreated) {
  EXPECT_THROW(run_offline(one_box(), {.frames = 1, .trajectory = "/nonexistent/x.csv"}, {}),
               Error);
}

}  // namespace
}  // namespace poinsot
