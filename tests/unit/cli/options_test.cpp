// The verbs' options, from argv to what is sent.

#include <cmath>
#include <sstream>

#include <gtest/gtest.h>

#include "poinsot/base/error.h"
#include "poinsot/cli/bodies.h"
#include "poinsot/cli/clear.h"
#include "poinsot/cli/control.h"
#include "poinsot/cli/drag.h"
#include "poinsot/cli/events.h"
#include "poinsot/cli/push.h"
#include "poinsot/cli/record.h"
#include "poinsot/cli/slots.h"
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
  EXPECT_EQ(push_error({"box"}),
            "nothing to push with: give --force x,y,z or --torque x,y,z, or --impulse x,y,z or "
            "--angular-impulse x,y,z");
  EXPECT_NE(push_error({"box", "--force", "1,0,0", "--clear"}), "accepted");
  EXPECT_NE(push_error({"box", "--force", "1,0,0", "--hold", "--for", "1s"}), "accepted");
  EXPECT_NE(push_error({"box", "--force", "1,0,0", "--at-frame", "world"}), "accepted");
  EXPECT_NE(push_error({"--force", "1,0,0"}), "accepted");
  EXPECT_NE(push_error({"box", "--force", "1,0,0", "--impulse", "1,0,0"}), "accepted");
  EXPECT_NE(push_error({"box", "--impulse", "1,0,0", "--for", "1s"}), "accepted");
  EXPECT_NE(push_error({"box", "--impulse", "1,0,0", "--hold"}), "accepted");
  EXPECT_NE(push_error({"box", "--impulse", "1,0,0", "--clear"}), "accepted");
}

TEST(PushOptions, ReadAnImpulseAndASlot) {
  const WrenchCommand command =
      push({"box", "--impulse", "1,2,3", "--angular-impulse", "4,5,6", "--slot", "7"});
  EXPECT_EQ(command.kind, WrenchKind::impulse);
  EXPECT_EQ(command.force, Vec3(1, 2, 3));
  EXPECT_EQ(command.torque, Vec3(4, 5, 6));
  EXPECT_EQ(command.hold, Hold::frame);
  EXPECT_EQ(command.slot, 7u);
}

WrenchCommand drag(const std::vector<const char*>& arguments, double mass) {
  DragOptions options;
  EXPECT_EQ(parse([&](CLI::App& app) { add_drag_options(app, options); }, arguments), "");
  return to_command(options, mass);
}

TEST(DragOptions, AreATetherUntilItIsCleared) {
  const WrenchCommand command = drag({"box", "--to", "1,2,3"}, 2);
  EXPECT_EQ(command.kind, WrenchKind::tether);
  EXPECT_EQ(command.target, Vec3(1, 2, 3));
  EXPECT_EQ(command.hold, Hold::until_cleared);
  EXPECT_EQ(command.point_frame, PointFrame::center_of_mass);
}

// x″ + 2ζω x′ + ω² x = 0 from rest at x = 1, with ζ = 1: x = (1 + ωt) exp(−ωt).
TEST(DragOptions, AreCriticallyDampedAndThereAfterTheDragTime) {
  for (const double mass : {0.1, 2.0, 500.0}) {
    const WrenchCommand command = drag({"box", "--to", "0,0,0"}, mass);
    const double omega = std::sqrt(command.stiffness / mass);
    EXPECT_NEAR(command.damping, 2 * mass * omega, 1e-12 * command.damping);
    const double left = (1 + omega * kDragTime) * std::exp(-omega * kDragTime);
    EXPECT_NEAR(left, 0.01, 1e-4) << mass;
  }
}

TEST(DragOptions, DampAGivenStiffnessCritically) {
  const WrenchCommand command = drag({"box", "--to", "0,0,0", "--stiffness", "50"}, 2);
  EXPECT_EQ(command.stiffness, 50);
  EXPECT_EQ(command.damping, 20);
  EXPECT_EQ(drag({"box", "--to", "0,0,0", "--stiffness", "50", "--damping", "0"}, 2).damping, 0);
}

TEST(DragOptions, ReplaceTheLastDragOfTheSameBodyAndOfNoOther) {
  const std::uint32_t slot = drag({"box", "--to", "0,0,0"}, 1).slot;
  EXPECT_EQ(drag({"box", "--to", "1,0,0"}, 1).slot, slot);
  EXPECT_NE(drag({"ball", "--to", "1,0,0"}, 1).slot, slot);
  EXPECT_TRUE(is_drag_slot(slot));
  EXPECT_EQ(drag({"box", "--to", "1,0,0", "--slot", "3"}, 1).slot, 3u);
}

TEST(ClearOptions, NameNoBodyForAll) {
  ClearOptions all;
  EXPECT_EQ(parse([&](CLI::App& app) { add_clear_options(app, all); }, {}), "");
  EXPECT_EQ(to_command(all).hold, Hold::clear);
  EXPECT_EQ(to_command(all).body_name, "");
  ClearOptions one;
  EXPECT_EQ(parse([&](CLI::App& app) { add_clear_options(app, one); }, {"box", "--slot", "4"}), "");
  EXPECT_EQ(to_command(one).body_name, "box");
  EXPECT_EQ(to_command(one).slot, 4u);
}

RunControl set(const std::vector<const char*>& arguments) {
  SetOptions options;
  EXPECT_EQ(parse([&](CLI::App& app) { add_set_options(app, options); }, arguments), "");
  return to_control(options);
}

TEST(SetOptions, SetWhatIsGivenAndNothingElse) {
  const RunControl control = set({"box", "--position", "1,2,3", "--velocity", "0,0,-1"});
  EXPECT_EQ(control.action, ControlAction::set_state);
  EXPECT_EQ(control.body_name, "box");
  EXPECT_TRUE(control.sets_position && control.sets_linear);
  EXPECT_FALSE(control.sets_orientation || control.sets_angular);
  EXPECT_EQ(control.position, Vec3(1, 2, 3));
  EXPECT_EQ(control.linear_velocity, Vec3(0, 0, -1));
  EXPECT_THROW(set({"box"}), Error);
}

TEST(SetOptions, TakeAnOrientationAsAQuaternionOrAsAngles) {
  const RunControl quaternion = set({"box", "--orientation", "0,0,3,4"});
  EXPECT_TRUE(quaternion.sets_orientation);
  EXPECT_EQ(quaternion.orientation.coeffs(), Eigen::Vector4d(0, 0, 0.6, 0.8));
  const RunControl angles = set({"box", "--rpy", "0,0,0.5"});
  EXPECT_TRUE(angles.sets_orientation);
  EXPECT_NEAR(angles.orientation.z(), std::sin(0.25), 1e-15);
  SetOptions options;
  EXPECT_NE(parse([&](CLI::App& app) { add_set_options(app, options); },
                  {"box", "--rpy", "0,0,1", "--orientation", "0,0,0,1"}),
            "");
}

TEST(RecordOptions, EitherNameALogOrEndIt) {
  EXPECT_EQ(to_control(RecordOptions{.name = "today"}).name, "today");
  EXPECT_EQ(to_control(RecordOptions{.name = {}, .stop = true}).name, "");
  EXPECT_THROW(to_control(RecordOptions{}), Error);
}

TEST(ResetOptions, AddUpScopes) {
  ControlOptions options;
  EXPECT_EQ(parse([&](CLI::App& app) { add_reset_options(app, options); }, {"--time", "--spawned"}),
            "");
  EXPECT_EQ(options.control.scope, 5);
}

TEST(ScaleOptions, RefuseANegativeScale) {
  ControlOptions options;
  const auto add = [&](CLI::App& app) { add_scale_options(app, options); };
  EXPECT_EQ(parse(add, {"0"}), "");
  EXPECT_EQ(parse(add, {"0.25"}), "");
  EXPECT_EQ(options.control.value, 0.25);
  EXPECT_NE(parse(add, {"--", "-1"}), "");
  EXPECT_NE(parse(add, {"1e9"}), "");
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

TEST(WatchOptions, AskTheDaemonForWhatTheyShow) {
  WatchOptions options;
  EXPECT_TRUE(to_filter(options).is_all());
  EXPECT_EQ(parse([&](CLI::App& app) { add_watch_options(app, options); },
                  {"--match", "wheel_*,box", "--rate", "10", "--deadband", "0"}),
            "");
  const PoseFilter filter = to_filter(options);
  EXPECT_EQ(filter.match, "wheel_*,box");
  EXPECT_EQ(filter.rate, 10);
  EXPECT_EQ(filter.change, 0.0);
}

int run(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "poinsot");
  return run_client(static_cast<int>(arguments.size()), arguments.data());
}

std::string output_of(const std::vector<const char*>& arguments) {
  testing::internal::CaptureStdout();
  EXPECT_EQ(run(arguments), 0) << arguments.front();
  return testing::internal::GetCapturedStdout();
}

TEST(Verbs, HaveHelpWithAnExample) {
  for (const Verb& verb : kVerbs) {
    const std::string help = output_of({std::string(verb.name).c_str(), "--help"});
    EXPECT_NE(help.find("Example:\n  "), std::string::npos) << verb.name;
    EXPECT_NE(help.find("poinsot " + std::string(verb.name)), std::string::npos) << verb.name;
    if (!verb.on_bus) continue;
    for (const char* text : {"--timeout", "--world", "--domain", "--partition", "--json"})
      EXPECT_NE(help.find(text), std::string::npos) << verb.name << " lacks " << text;
  }
}

TEST(Verbs, AreInTheManualAndInEveryShellsCompletion) {
  const std::string manual = output_of({"man"});
  for (const Verb& verb : kVerbs)
    EXPECT_NE(manual.find(".SS \\fBpoinsot\\fR \\fB" + std::string(verb.name) + "\\fR"),
              std::string::npos)
        << verb.name;
  for (const char* shell : {"bash", "zsh", "fish"}) {
    const std::string script = output_of({"completion", shell});
    for (const Verb& verb : kVerbs)
      EXPECT_NE(script.find(verb.name), std::string::npos) << shell << " " << verb.name;
    EXPECT_EQ(script.find("--peer"), std::string::npos) << "hidden";
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
