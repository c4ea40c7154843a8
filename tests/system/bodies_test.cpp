// spawn, set and remove from the command line, as another process sees them.

#include <gtest/gtest.h>

#include "support/test_domain.h"
#include "system/free_world.h"

namespace poinsot {
namespace {

constexpr const char* kNewcomer =
    "bodies: [{name: newcomer, shape: {sphere: 0.1}, mass: 1, position: [0, 20, 0]}]\n";

class Bodies : public testing::Test {
 protected:
  Bodies() { world_.start({}); }

  // With this text as its standard input.
  static Ended spawn_from_input(const std::string& text) {
    const TemporaryFile input("fragment.yaml", text);
    ChildProcess shell("/bin/sh", {"-c", R"("$0" spawn - --world free --domain "$1" < "$2")",
                                   POINSOT_CLIENT, std::to_string(test_domain()), input.path()});
    Ended ended;
    ended.out = shell.read_rest();
    ended.code = shell.wait();
    ended.errors = shell.errors();
    return ended;
  }

  static Words names(const Json& with_bodies) {
    Words names;
    for (const Json& body : with_bodies["bodies"]) names.push_back(body["name"]);
    return names;
  }

  static Words listed() {
    const Json list = FreeWorld::json({"list"});
    return names(list);
  }

  // The first frame of a watch that shows these bodies.
  static Json frame_with(Watcher& watcher, const Words& wanted) {
    for (int frames = 0; frames < 600; ++frames) {
      const Json frame = watcher.next();
      if (names(frame) == wanted) return frame;
    }
    throw std::runtime_error("never seen: " + Json(wanted).dump());
  }

  FreeWorld world_;
};

TEST_F(Bodies, SpawnedFromStandardInputAreSeenByAWatchThatWasThereBefore) {
  Watcher watcher;
  EXPECT_EQ(names(watcher.next()), (Words{"probe", "bystander"}));
  const Ended spawned = spawn_from_input(kNewcomer);
  EXPECT_EQ(spawned.code, 0) << spawned.errors;
  const Json frame = frame_with(watcher, {"probe", "bystander", "newcomer"});
  EXPECT_EQ(frame["bodies"][2]["position"], Json({0.0, 20.0, 0.0}));
  EXPECT_EQ(listed(), (Words{"probe", "bystander", "newcomer"}));

  FreeWorld::json({"set", "newcomer", "--velocity", "0,0,3"});
  while (frame_with(watcher, {"probe", "bystander", "newcomer"})["bodies"][2]["linear_velocity"] !=
         Json({0.0, 0.0, 3.0}))
    continue;

  FreeWorld::json({"remove", "probe"});
  frame_with(watcher, {"bystander", "newcomer"});
  EXPECT_EQ(listed(), (Words{"bystander", "newcomer"}));
}

TEST_F(Bodies, OfABadFragmentAreRefusedWithTheLineAndColumnOfEveryFault) {
  struct Case {
    const char* fragment;
    Words told;
  };
  const Case cases[] = {
      {"bodies:\n  - {name: bad, shape: {sphere: -0.1}, mass: 1}\n", {":2:33: sphere radius"}},
      {"bodies:\n  - {name: bad, shape: {sphere: 0.1}, mas: 1}\n",
       {":2:5: ", ":2:39: unknown key 'mas'"}},
      {"bodies:\n  - {name: bad, shape: {sphere: 0.1}, \"m\\a\\e[2J\": 1, mass: 1}\n", {":2:39: "}},
      {"bodies:\n  - {name: bad, shape: {sphere: 0.1\n", {":3:1: YAML"}},
      {"bodies:\n  - {name: bad, shape: {mesh: {file: x.stl}}, mass: 1}\n", {":2:", "file"}},
      {"simulation: {gravity: [0, 0, 0]}\n", {":1:1: "}},
  };
  for (const Case& bad : cases) {
    const Ended ended = spawn_from_input(bad.fragment);
    EXPECT_EQ(ended.code, 1) << bad.fragment;
    EXPECT_EQ(ended.out, "") << bad.fragment;
    for (const std::string& told : bad.told)
      EXPECT_NE(ended.errors.find(told), std::string::npos) << bad.fragment << ended.errors;
  }
  EXPECT_EQ(listed(), (Words{"probe", "bystander"}));
  const Ended no_file = FreeWorld::run({"spawn", "/nonexistent/fragment.yaml"});
  EXPECT_EQ(no_file.code, 2);
  EXPECT_NE(no_file.errors.find("/nonexistent/fragment.yaml"), std::string::npos);
}

TEST_F(Bodies, HaveTheMomentumOfTheirImpulses) {
  FreeWorld::json({"push", "probe", "--impulse", "3,0,0"});
  FreeWorld::json({"push", "probe", "--impulse", "0,-1,0.5"});
  FreeWorld::json({"push", "bystander", "--angular-impulse", "0,0,0.001"});
  const Json probe = FreeWorld::state_of("probe");
  EXPECT_EQ(probe["linear_velocity"], Json({1.5, -0.5, 0.25}));
  const Json bystander = FreeWorld::state_of("bystander");
  EXPECT_EQ(bystander["linear_velocity"], Json({0.0, 0.0, 0.0}));
  const double inertia = 0.4 * 0.1 * 0.1;  // of a ball of 1 kg
  EXPECT_NEAR(bystander["angular_velocity"][2].get<double>(), 0.001 / inertia, 1e-12);
}

}  // namespace
}  // namespace poinsot
