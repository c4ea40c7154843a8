// What other processes see of a run: list, watch, status; and which daemon they see.

#include <chrono>

#include <gtest/gtest.h>

#include "support/test_domain.h"
#include "system/programs.h"

namespace poinsot {
namespace {

Words keys(const Json& object) {
  Words keys;
  for (const auto& [key, value] : object.items()) keys.push_back(key);
  return keys;
}

TEST(Watch, StreamsEveryFrameWithoutAGap) {
  constexpr int kFrames = 300;
  const Daemon daemon("push_me");
  Watcher watcher({"-n", std::to_string(kFrames)});
  const Json first = watcher.next();
  EXPECT_EQ(keys(first), (Words{"frame", "time", "bodies"}));
  ASSERT_EQ(first["bodies"].size(), 11u);
  for (const Json& body : first["bodies"]) {
    EXPECT_EQ(keys(body),
              (Words{"name", "position", "orientation", "linear_velocity", "angular_velocity"}));
    EXPECT_EQ(keys(body["orientation"]), (Words{"x", "y", "z", "w"}));
    for (const char* key : {"position", "linear_velocity", "angular_velocity"})
      EXPECT_EQ(body[key].size(), 3u);
  }
  const auto start = first["frame"].get<int>();
  for (int i = 1; i < kFrames; ++i) {
    const Json frame = watcher.next();
    ASSERT_EQ(frame["frame"], start + i);
    ASSERT_EQ(frame["time"], (start + i) / 60.0);
  }
  EXPECT_EQ(watcher.read_line(), "");
  EXPECT_EQ(watcher.wait(), 0);
  EXPECT_EQ(watcher.errors(), "");
}

TEST(Watch, ShowsTheBodiesThatWereAskedFor) {
  const Daemon daemon("push_me");
  Watcher watcher({"-n", "2", "--body", "ball", "--body", "crate"});
  const Json bodies = watcher.next()["bodies"];
  ASSERT_EQ(bodies.size(), 2u);
  EXPECT_EQ(bodies[0]["name"], "ball");
  EXPECT_EQ(bodies[1]["name"], "crate");
  const Ended unknown = client({"watch", "-n", "1", "--body", "bal"});
  EXPECT_EQ(unknown.code, 2);
  EXPECT_NE(unknown.errors.find("'ball'"), std::string::npos) << unknown.errors;
}

TEST(List, NamesTheWorldAndAllItsBodies) {
  const Daemon daemon("push_me");
  const Json list = client_json({"list"});
  EXPECT_EQ(keys(list), (Words{"world", "state", "frame", "time", "frame_rate", "bodies"}));
  EXPECT_EQ(list["world"], "push_me");
  ASSERT_EQ(list["bodies"].size(), 12u);
  EXPECT_EQ(list["bodies"][0]["name"], "floor");
  EXPECT_EQ(list["bodies"][0]["static"], true);
  EXPECT_EQ(list["bodies"][1]["name"], "table");
  const std::string text = client({"list"}).out;
  for (const char* word : {"push_me", "table", "big_ball"})
    EXPECT_NE(text.find(word), std::string::npos) << text;
}

TEST(Status, TellsHowTheRunGoes) {
  const Daemon daemon("tower", {"--paused"});
  const Json status = client_json({"status"});
  EXPECT_EQ(status["world"], "tower");
  EXPECT_EQ(status["body_methods"].size(), status["bodies"].get<std::size_t>());
  for (const Json& body : status["body_methods"]) EXPECT_TRUE(body.contains("name")) << body;
  EXPECT_EQ(status["state"], "paused");
  EXPECT_EQ(status["frame"], 0);
  EXPECT_EQ(status["frame_rate"], 60.0);
  EXPECT_EQ(keys(status["cpu_s"]),
            (Words{"presentation", "collision", "contact", "simulation", "publishing"}));
  EXPECT_NE(client({"status"}).out.find("paused"), std::string::npos);
}

TEST(Client, SaysSoWhenNoServerAnswers) {
  for (const char* verb : {"list", "watch", "status", "pause"}) {
    const Ended ended =
        run_client_alone({verb, "--domain", std::to_string(test_domain()), "--timeout", "0.3s"});
    EXPECT_EQ(ended.code, 1) << verb;
    EXPECT_EQ(ended.out, "") << verb;
    EXPECT_NE(ended.errors.find("poinsotd run"), std::string::npos) << verb << ended.errors;
  }
}

TEST(Client, ChoosesBetweenTwoWorldsOnlyWhenToldWhich) {
  const Daemon left("tennis_racket", {"--world", "left", "--paused"});
  const Daemon right("push_me", {"--world", "right", "--paused"});
  const std::string worlds = client({"list"}).out;
  EXPECT_NE(worlds.find("left: "), std::string::npos) << worlds;
  EXPECT_NE(worlds.find("right: "), std::string::npos) << worlds;

  const Ended undecided = client({"step", "5"});
  EXPECT_EQ(undecided.code, 1);
  for (const char* word : {"left", "right", "--world"})
    EXPECT_NE(undecided.errors.find(word), std::string::npos) << undecided.errors;

  EXPECT_EQ(client_json({"step", "5", "--world", "left"})["frame"], 5);
  EXPECT_EQ(client_json({"status", "--world", "left"})["frame"], 5);
  EXPECT_EQ(client_json({"status", "--world", "right"})["frame"], 0);
}

}  // namespace
}  // namespace poinsot
