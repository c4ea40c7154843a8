// Checkpoints that outlive the daemon: kill -9, a new daemon, and the run goes on with the same
// bits.

#include <csignal>
#include <fstream>
#include <stdexcept>

#include <gtest/gtest.h>

#include "support/test_domain.h"
#include "system/free_world.h"

namespace poinsot {
namespace {

std::string hash_after(int frames) {
  return FreeWorld::json({"step", std::to_string(frames)})["state_hash"];
}

// Something that a run has to remember: a push that goes on, one that has not begun, a drag.
void disturb() {
  FreeWorld::json({"push", "probe", "--force", "1,2,3", "--at", "0.1,0,0", "--hold"});
  FreeWorld::json({"push", "probe", "--torque", "0,0.1,0", "--from-frame", "30", "--for", "1s"});
  FreeWorld::json({"drag", "bystander", "--to", "49,1,0"});
}

TEST(Checkpoint, OnDiskGoesOnAfterAKillWithTheSameHash) {
  FreeWorld world;
  world.start();
  disturb();
  FreeWorld::json({"step", "20"});
  EXPECT_EQ(FreeWorld::json({"save", "middle", "--disk"})["frame"], 20);
  const std::string after_middle = hash_after(25);
  const Json last = FreeWorld::json({"save", "--disk"});
  const std::string after_last = hash_after(25);
  world.kill();

  world.start({"--paused", "--restore", "middle"});
  EXPECT_EQ(FreeWorld::json({"status"})["frame"], 20);
  EXPECT_EQ(hash_after(25), after_middle);
  world.kill();

  world.start({"--paused", "--restore", "latest"});
  EXPECT_EQ(FreeWorld::json({"status"})["frame"], 45);
  EXPECT_EQ(FreeWorld::json({"pushes"})["held"].size(), 3u);
  EXPECT_EQ(hash_after(25), after_last);
  // By name over the bus too, in the new daemon's memory or not.
  EXPECT_EQ(FreeWorld::json({"restore", "middle"})["frame"], 20);
  EXPECT_EQ(hash_after(25), after_middle);
}

TEST(Checkpoint, ThatIsDamagedIsPassedOverForTheOneBefore) {
  FreeWorld world;
  world.start();
  FreeWorld::json({"step", "3"});
  FreeWorld::json({"save", "good", "--disk"});
  FreeWorld::json({"step", "4"});
  FreeWorld::json({"save", "damaged", "--disk"});
  world.kill();
  const auto file = world.directory() / "damaged.checkpoint";
  std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);

  world.start({"--paused", "--restore", "latest"});
  EXPECT_EQ(FreeWorld::json({"status"})["frame"], 3);
  const Ended refused = FreeWorld::run({"restore", "damaged"});
  EXPECT_EQ(refused.code, 1);
  EXPECT_NE(refused.errors.find("damaged"), std::string::npos) << refused.errors;
  world.kill();

  // Who asks for that one by name gets no other.
  const Ended ended = run_daemon({"run", world.scene(), "--domain", std::to_string(test_domain()),
                                  "--data", world.data(), "--restore", "damaged"});
  EXPECT_NE(ended.code, 0);
  EXPECT_NE(ended.errors.find("damaged"), std::string::npos) << ended.errors;
}

TEST(Checkpoint, IsKeptWhereTheEnvironmentSays) {
  const test::TempDirectory directory;
  ASSERT_EQ(setenv("POINSOT_DATA_DIR", directory.path().c_str(), 1), 0);
  const TemporaryFile scene("other.yaml",
                            "world: other\nbodies: [{name: a, shape: {sphere: 0.1}, mass: 1}]\n");
  const Daemon daemon(scene.path(), {"--paused"});
  unsetenv("POINSOT_DATA_DIR");
  client_json({"save", "here", "--disk"});
  EXPECT_TRUE(std::filesystem::is_regular_file(directory.path() / "other" / "here.checkpoint"));
}

pid_t child_of(pid_t parent) {
  const std::string process = std::to_string(parent);
  std::ifstream children("/proc/" + process + "/task/" + process + "/children");
  pid_t child = 0;
  if (!(children >> child)) throw std::runtime_error("no child of " + process);
  return child;
}

TEST(Supervisor, BringsAKilledDaemonBackToWhereItWasSaved) {
  FreeWorld world;
  world.start({"--supervise", "--autosave", "100ms"});
  FreeWorld::json({"push", "probe", "--force", "1,0,0", "--hold"});
  Watcher watcher;
  while (watcher.next()["frame"] < 60) continue;
  const Json before = FreeWorld::json({"status"});
  kill(child_of(world.daemon().id()), SIGKILL);

  Json after = before;
  ASSERT_TRUE(eventually([&] {
    const Ended status = FreeWorld::run({"status", "--json"});
    if (status.code == 0) after = Json::parse(status.out);
    return after["session"] != before["session"];
  }));
  EXPECT_GT(after["frame"], 30);
  // As if nothing had happened: the push of frame f has given f − first + 1 frames of velocity.
  const Json held = FreeWorld::json({"pushes"})["held"].at(0);
  const Json frame = FreeWorld::json({"watch", "-n", "1", "--body", "probe"});
  const double frames = frame["frame"].get<double>() - held["first_frame"].get<double>() + 1;
  EXPECT_NEAR(frame["bodies"][0]["linear_velocity"][0].get<double>(), frames / 60 / 2,
              1e-12 * frames);

  // Told to end, it ends with its child, and well.
  const pid_t child = child_of(world.daemon().id());
  FreeWorld::json({"shutdown"});
  EXPECT_EQ(world.daemon().wait(), 0);
  EXPECT_NE(kill(child, 0), 0);
}

}  // namespace
}  // namespace poinsot
