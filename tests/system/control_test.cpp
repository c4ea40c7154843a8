// pause, step, resume, reset from the command line: the frames and the bits they lead to.

#include <gtest/gtest.h>

#include "support/test_domain.h"
#include "system/programs.h"

namespace poinsot {
namespace {

// The hash after so many frames of a run that nobody disturbs.
std::string hash_of(const std::string& scene, int frames) {
  const Ended ended = run_daemon(
      {"run", scene, "--offline", "--fast", "--frames", std::to_string(frames), "--json"});
  return Json::parse(ended.out)["state_hash"];
}

TEST(Control, StepsLeadToTheFramesAndBitsOfAnOfflineRun) {
  const Daemon daemon("push_me", {"--paused"});
  EXPECT_EQ(client_json({"status"})["frame"], 0);
  int frame = 0;
  for (const int steps : {1, 7, 52}) {
    const Json reply = client_json({"step", std::to_string(steps)});
    frame += steps;
    EXPECT_EQ(reply["frame"], frame);
    EXPECT_EQ(reply["state_hash"], hash_of("push_me", frame));
  }
  EXPECT_EQ(client_json({"status"})["state"], "paused");
}

TEST(Control, AResetGivesTheBitsOfAFreshStart) {
  const Daemon daemon("push_me", {"--paused"});
  const Json start = client_json({"status"});
  ASSERT_EQ(client({"push", "crate", "--force", "200,0,0", "--for", "5s"}).code, 0);
  const Json pushed = client_json({"step", "30"});
  EXPECT_NE(pushed["state_hash"], hash_of("push_me", 30));

  const Json reset = client_json({"reset"});
  EXPECT_EQ(reset["frame"], 0);
  EXPECT_EQ(reset["epoch"], start["epoch"].get<int>() + 1);
  EXPECT_EQ(reset["state_hash"], start["state_hash"]);
  int frame = 0;
  for (const int steps : {1, 29}) {
    frame += steps;
    EXPECT_EQ(client_json({"step", std::to_string(steps)})["state_hash"],
              hash_of("push_me", frame));
  }
}

TEST(Control, PauseStopsTheFramesAndResumeGoesOn) {
  const Daemon daemon("push_me");
  Watcher watcher;
  watcher.next();
  const Json pause = client_json({"pause"});
  const auto frame = pause["frame"].get<int>();
  EXPECT_EQ(client_json({"step", "3"})["frame"], frame + 3);
  EXPECT_EQ(client_json({"status"})["frame"], frame + 3);
  EXPECT_EQ(client_json({"resume"})["frame"], frame + 3);
  // The watcher misses none of it, and time goes on by itself.
  int seen = watcher.next()["frame"];
  while (seen < frame + 30) {
    const int next = watcher.next()["frame"];
    ASSERT_EQ(next, seen + 1);
    seen = next;
  }
  EXPECT_EQ(client_json({"status"})["state"], "playing");
}

}  // namespace
}  // namespace poinsot
