// The verbs' options, from argv to what is sent.

#include <sstream>

#include <gtest/gtest.h>

#include "poinsot/base/error.h"
#include "poinsot/cli/events.h"
#include "poinsot/cli/push.h"
#include "poinsot/cli/verbs.h"
#include "poinsot/cli/watch.h"

namespace poinsot {
namespace {

using namespace std::chrono_literals;

template <class Add>
std::string parse(Add add, std::vector<const char*> arguments) {
  CLI::App app("a verb", "verb");
  add(app);
  arguments.insert(arguments.begin(), "verb");
  std::ostringstream out, err;
  parse_command_line(app, static_cast<int>(arguments.size()), arguments.data(), out, err);
  return err.str();
}

WrenchCommand push(const std::vector<const char*>& arguments) {
  PushOptions options;
  EXPECT_EQ(parse([&](CLI::App& app) { add_push_options(app, options); }, arguments), "");
  return to_command(options);
}

std::string push_error(const std::vector<const char*>& arguments) {
  PushOptions options;
  const std::string text = parse([&](CLI::App& app) { add_push_options(app, options); }, arguments);
  if (!text.empty()) return text;
  try {
    to_command(options);
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(PushOptions, DefaultToOneFrameAtTheCentreOfMassInWorldAxes) {
  const WrenchCommand command = push({"box", "--force", "0,0,50"});
  EXPECT_EQ(command.body_name, "box");
  EXPECT_EQ(command.force, Vec3(0, 0, 50));
  EXPECT_EQ(command.axes, Axes::world);
  EXPECT_EQ(command.point_frame, PointFrame::center_of_mass);
  EXPECT_EQ(command.hold, Hold::frame);
  EXPECT_EQ(command.start_frame, 0u);
}

TEST(PushOptions, ReadEverything) {
  const WrenchCommand command =
      push({"box", "--force", "1,2,3", "--torque", "-4,5,6", "--at", "0.1,0,0", "--at-frame",
            "world", "--frame", "body", "--for", "0.5s", "--from-frame", "600"});
  EXPECT_EQ(command.torque, Vec3(-4, 5, 6));
  EXPECT_EQ(command.axes, Axes::body);
  EXPECT_EQ(command.point, Vec3(0.1, 0, 0));
  EXPECT_EQ(command.point_frame, PointFrame::world);
  EXPECT_EQ(command.hold, Hold::duration);
  EXPECT_EQ(command.duration_ns, 500'000'000);
  EXPECT_EQ(command.start_frame, 600u);
}

TEST(PushOptions, TakeAPointInTheBodyUnlessToldOtherwise) {
  EXPECT_EQ(push({"box", "--force", "1,0,0", "--at", "0,0,0"}).point_frame, PointFrame::body);
}

TEST(PushOptions, HoldAndClear) {
  EXPECT_EQ(push({"box", "--force", "1,0,0", "--hold"}).hold, Hold::until_cleared);
  EXPECT_EQ(push({"box", "--clear"}).hold, Hold::clear);
}

TEST(PushOptions, LeaveAZeroDurationToTheServerToRefuse) {
  const WrenchCommand command = push({"box", "--force", "1,0,0", "--for", "0"});
  EXPECT_EQ(command.hold, Hold::duration);
  EXPECT_EQ(command.duration_ns, 0);
}

TEST(PushOptions, RefuseWhatSaysNothingOrTwoThings) {
  EXPECT_EQ(push_error({"box"}), "nothing to push with: give --force x,y,z or --torque x,y,z");
  EXPECT_NE(push_error({"box", "--force", "1,0,0", "--clear"}), "accepted");
  EXPECT_NE(push_error({"box", "--force", "1,0,0", "--hold", "--for", "1s"}), "accepted");
  EXPECT_NE(push_error({"box", "--force", "1,0,0", "--at-frame", "world"}), "accepted");
  EXPECT_NE(push_error({"--force", "1,0,0"}), "accepted");
}

TEST(PushOptions, SuggestTheNearestFrame) {
  EXPECT_NE(push_error({"box", "--force", "1,0,0", "--frame", "wold"})
                .find("--frame: 'wold' is not one of world, body, did you mean 'world'?"),
            std::string::npos);
}

TEST(WatchOptions, ReadSeveralBodies) {
  WatchOptions options;
  EXPECT_EQ(parse([&](CLI::App& app) { add_watch_options(app, options); },
                  {"--body", "box", "--body", "ball", "--rate", "10", "-n", "5", "--json"}),
            "");
  EXPECT_EQ(options.bodies, (std::vector<std::string>{"box", "ball"}));
  EXPECT_EQ(options.rate, 10);
  EXPECT_EQ(options.count, 5u);
  EXPECT_TRUE(options.json);
}

TEST(EventsOptions, ReadSeveralBodiesAndACount) {
  EventsOptions options;
  EXPECT_EQ(parse([&](CLI::App& app) { add_events_options(app, options); },
                  {"--body", "box", "--body", "ball", "-n", "5", "--json"}),
            "");
  EXPECT_EQ(options.bodies, (std::vector<std::string>{"box", "ball"}));
  EXPECT_EQ(options.count, 5u);
  EXPECT_TRUE(options.json);
  EXPECT_NE(parse([&](CLI::App& app) { add_events_options(app, options); }, {"-n", "0"}), "");
}

TEST(WatchOptions, RefuseARateOrACountThatShowsNothing) {
  for (const char* option : {"--rate", "-n"}) {
    WatchOptions options;
    EXPECT_NE(parse([&](CLI::App& app) { add_watch_options(app, options); }, {option, "0"}), "")
        << option;
  }
}

int run(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "poinsot");
  return run_client(static_cast<int>(arguments.size()), arguments.data());
}

TEST(Verbs, HaveHelpWithAnExample) {
  for (const Verb& verb : kVerbs) {
    testing::internal::CaptureStdout();
    EXPECT_EQ(run({std::string(verb.name).c_str(), "--help"}), 0) << verb.name;
    const std::string help = testing::internal::GetCapturedStdout();
    for (const char* text : {"Example:", "--timeout", "--world", "--domain"})
      EXPECT_NE(help.find(text), std::string::npos) << verb.name << " lacks " << text;
  }
}

TEST(Verbs, RefuseWhatTheyDoNotKnow) {
  testing::internal::CaptureStderr();
  EXPECT_EQ(run({"wacth"}), 2);
  EXPECT_NE(testing::internal::GetCapturedStderr().find("did you mean 'watch'?"),
            std::string::npos);
}

TEST(Verbs, RefuseAPushOfNothingBeforeLookingForAServer) {
  testing::internal::CaptureStderr();
  EXPECT_EQ(run({"push", "box"}), 2);
  EXPECT_NE(testing::internal::GetCapturedStderr().find("nothing to push with"), std::string::npos);
}

}  // namespace
}  // namespace poinsot
