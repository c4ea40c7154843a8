// The command log: what is recorded of a run that is pushed about gives every hash again, and one
// number that was changed is found.

#include <fstream>

#include <gtest/gtest.h>

#include "system/free_world.h"

namespace poinsot {
namespace {

constexpr int kPushed = 13;  // first frame of the push whose number is changed

class Record : public testing::Test {
 protected:
  // 40 frames with all that a client may do to bodies.
  Record() {
    world_.start();
    FreeWorld::json({"step", "5"});
    FreeWorld::json({"record", "tape"});
    push({"probe", "--force", "1,2,3", "--at", "0.1,0,0", "--frame", "body", "--for", "0.1s"});
    push({"probe", "--impulse", "0.1,0,0.3", "--at", "0,0.1,0"});
    push({"bystander", "--torque", "0,0.01,0", "--hold", "--slot", "2"});
    step(7);
    push({"bystander", "--force", "0.25,0,0", "--from-frame", std::to_string(kPushed), "--hold"});
    FreeWorld::json({"drag", "probe", "--to", "1,0,0"});
    step(8);
    const TemporaryFile fragment(
        "newcomer.yaml",
        "bodies: [{name: newcomer, shape: {sphere: 0.1}, mass: 1, position: [0, 20, 0]}]\n");
    FreeWorld::json({"spawn", fragment.path()});
    push({"newcomer", "--force", "0,0,1", "--for", "0.2s"});
    FreeWorld::json({"save", "here"});
    step(10);
    FreeWorld::json({"set", "probe", "--velocity", "1,2,3"});
    step(5);
    FreeWorld::json({"restore", "here"});
    FreeWorld::json({"clear"});
    step(5);
    FreeWorld::json({"remove", "probe"});
    step(5);
    FreeWorld::json({"record", "--stop"});
  }

  static void push(Words arguments) {
    arguments.insert(arguments.begin(), "push");
    FreeWorld::json(arguments);
  }
  static void step(int frames) { FreeWorld::json({"step", std::to_string(frames)}); }

  std::string log() const { return (world_.directory() / "tape.log").string(); }

  std::string text() const {
    std::ostringstream text;
    text << std::ifstream(log()).rdbuf();
    return text.str();
  }

  FreeWorld world_;
};

TEST_F(Record, IsReplayedWithEveryHash) {
  const Ended replayed = run_client_alone({"replay", log()});
  EXPECT_EQ(replayed.code, 0) << replayed.out << replayed.errors;
  EXPECT_NE(replayed.out.find("all 40 frames have the recorded hash"), std::string::npos)
      << replayed.out;
  const Ended parsed = run_client_alone({"replay", log(), "--json"});
  EXPECT_EQ(parsed.code, 0);
  const Json outcome = Json::parse(parsed.out);
  EXPECT_EQ(outcome["frames"], 40);
  EXPECT_EQ(outcome["same"], true);
  EXPECT_EQ(outcome["cut"], false);
  EXPECT_EQ(outcome["refused"], 0);
}

TEST_F(Record, WithOneChangedNumberNamesTheFirstFrameThatDiffers) {
  std::string changed = text();
  const auto at = changed.find("0.25");
  ASSERT_NE(at, std::string::npos);
  changed.replace(at, 4, "0.26");
  const TemporaryFile file("changed.log", changed);
  const Ended replayed = run_client_alone({"replay", file.path()});
  EXPECT_EQ(replayed.code, 1);
  EXPECT_EQ(replayed.out.find("frame " + std::to_string(kPushed) + " differs"), 0u) << replayed.out;
  const Ended parsed = run_client_alone({"replay", file.path(), "--json"});
  EXPECT_EQ(parsed.code, 1);
  const Json outcome = Json::parse(parsed.out);
  EXPECT_EQ(outcome["same"], false);
  EXPECT_EQ(outcome["first_difference"]["frame"], kPushed);
  EXPECT_NE(outcome["first_difference"]["recorded"], outcome["first_difference"]["found"]);
}

TEST_F(Record, ThatWasCutIsReplayedUpToThere) {
  const std::string whole = text();
  const TemporaryFile file("cut.log", whole.substr(0, whole.size() - 60));
  const Ended replayed = run_client_alone({"replay", file.path(), "--json"});
  EXPECT_EQ(replayed.code, 0) << replayed.errors;
  const Json outcome = Json::parse(replayed.out);
  EXPECT_EQ(outcome["cut"], true);
  EXPECT_GE(outcome["frames"], 38);
}

TEST_F(Record, OfATakenNameOrNothingIsRefused) {
  const Ended taken = FreeWorld::run({"record", "tape"});
  EXPECT_EQ(taken.code, 1);
  EXPECT_NE(taken.errors.find("tape"), std::string::npos) << taken.errors;
  EXPECT_EQ(FreeWorld::run({"record", "--stop"}).code, 1) << "nothing is recorded";
  EXPECT_EQ(FreeWorld::run({"record"}).code, 2);
  EXPECT_EQ(FreeWorld::run({"record", "../escape"}).code, 1);
  EXPECT_EQ(run_client_alone({"replay", "/nonexistent.log"}).code, 2);
}

}  // namespace
}  // namespace poinsot
