#include "poinsot/cli/format.h"

#include <algorithm>
#include <sstream>

#include <gtest/gtest.h>

#include "unit/cli/sample.h"

namespace poinsot {
namespace {

TEST(PoseLines, HaveOneFieldPerTitle) {
  std::istringstream title{std::string(kPoseLinesTitle)};
  std::string mark;
  title >> mark;  // '#'
  const std::string text = pose_lines(sample::poses(), Roster(sample::bodies(), {"box"}), 60);
  std::istringstream line(text);
  std::string name, value;
  int titles = 0, values = 0;
  while (title >> name) ++titles;
  while (line >> value) ++values;
  EXPECT_EQ(titles, values) << text;
  EXPECT_EQ(text, "12 0.2 box 0.1 -2 1e-17 0.5 -0.5 0.5 0.5 1 0 -9.81 0 0 0.333333333\n");
}

TEST(PoseLines, QuoteNamesWithSpaces) {
  EXPECT_NE(
      pose_lines(sample::poses(), Roster(sample::bodies(), {}), 60).find("12 0.2 \"big ball\" "),
      std::string::npos);
}

WrenchCommand half_a_second_up() {
  WrenchCommand command;
  command.body_name = "box";
  command.force = {0, 0, 50};
  command.hold = Hold::duration;
  return command;
}

TEST(PushText, NamesFramesTimesForceAxesAndPoint) {
  Reply reply;
  reply.first_frame = 121;
  reply.last_frame = 150;
  EXPECT_EQ(push_text(half_a_second_up(), reply, 60),
            "box: frames 121 to 150 (30 frames), 2.000 s to 2.500 s: force (0, 0, 50) N at the "
            "centre of mass, world axes\n");
}

TEST(PushText, NamesThePointAndItsFrame) {
  WrenchCommand command = half_a_second_up();
  command.torque = {0, 1, 0};
  command.axes = Axes::body;
  command.point = {0.5, 0, 0};
  command.point_frame = PointFrame::body;
  Reply reply;
  reply.first_frame = reply.last_frame = 1;
  EXPECT_EQ(push_text(command, reply, 60),
            "box: frame 1, 0.000 s to 0.017 s: force (0, 0, 50) N at the body's point (0.5, 0, 0) "
            "m, torque (0, 1, 0) N m, body axes\n");
}

TEST(PushText, SaysThatAHeldPushHasNoEnd) {
  Reply reply;
  reply.first_frame = 61;
  reply.last_frame = kForever;
  EXPECT_NE(push_text(half_a_second_up(), reply, 60).find("frames 61 until cleared (from 1.000 s)"),
            std::string::npos);
}

TEST(PushText, SaysFromWhenAClearedPushIsGone) {
  WrenchCommand command;
  command.body_name = "box";
  command.hold = Hold::clear;
  Reply reply;
  reply.first_frame = reply.last_frame = 61;
  EXPECT_EQ(push_text(command, reply, 60), "box: cleared from frame 61 on (1.000 s)\n");
}

TEST(RefusalText, GivesReasonAndCode) {
  Reply reply;
  reply.code = ResultCode::not_found;
  reply.message = "no body 'bax', did you mean 'box'?";
  EXPECT_EQ(refusal_text("push", reply),
            "poinsot: push refused: no body 'bax', did you mean 'box'? (NOT_FOUND)\n");
}

TEST(ControlText, NamesFrameTimeEpochAndHash) {
  Reply reply;
  reply.epoch = 2;
  reply.last_frame = 30;
  reply.state_hash = 0xAB;
  EXPECT_EQ(control_text("step", reply, 60),
            "step: frame 30 (0.500 s), epoch 2, state hash 00000000000000ab\n");
}

TEST(StatusText, NamesStateAndFlags) {
  RunReport report;
  report.state = RunState::playing;
  report.frame.flags = FrameFlag::overrun;
  const std::string text = status_text("push_me", report);
  EXPECT_NE(text.find("world        push_me\nstate        playing\n"), std::string::npos) << text;
  EXPECT_NE(text.find("flags        overrun\n"), std::string::npos) << text;
}

TEST(StatusText, ShowsTheErrorsAndTheMethodsThatMovedBodies) {
  RunReport report;
  report.frame.energy_error = -2e-16;
  report.frame.position_error = 3.25e-13;
  report.frame.orientation_error = 1.5e-12;
  report.frame.momentum_error = 2e-15;
  report.frame.methods[static_cast<std::size_t>(Method::flight)] = 998;
  report.frame.methods[static_cast<std::size_t>(Method::taylor)] = 2;
  report.frame.flags = FrameFlag::stiff;
  const std::string text = status_text("push_me", report);
  EXPECT_NE(text.find("error -2e-16, push-out 0 J\n"
                      "local error  3.25e-13 m, 1.5e-12 rad\n"
                      "momentum     error 2e-15\n"
                      "methods      flight 998, taylor 2\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("flags        stiff\n"), std::string::npos) << text;
}

TEST(StatusText, CountsIslandsSearchesImpactsAndSleepers) {
  RunReport report;
  report.frame.bodies = 9;
  report.frame.asleep = 4;
  report.frame.islands = 2;
  report.frame.restarts = 1;
  report.frame.impact_searches = 12;
  report.frame.soft_bodies = 5;
  report.frame.direct_bodies = 2;
  report.frame.solver_iterations = 31;
  report.frame.unconverged = 1;
  report.frame.contact_residual = 2.5e-4;
  report.frame.impacts = 3;
  report.frame.impacts_so_far = 40;
  report.frame.flags = FrameFlag::crowded;
  report.events_dropped = 5;
  const std::string text = status_text("push_me", report);
  for (const char* line :
       {"bodies       9 moving, 4 asleep, 0 quarantined\n",
        "islands      2, 1 restarts, 12 impact searches\n",
        "solvers      5 bodies soft_step, 2 convex_newton in 31 iterations, 1 unconverged, "
        "residual 0.00025 m/s\n",
        "impacts      3, 40 in all\n", "dropped 0 snapshots, 5 events\n", "flags        crowded\n"})
    EXPECT_NE(text.find(line), std::string::npos) << text;
}

TEST(ImpactLine, HasAsManyWordsAsItsTitle) {
  const std::string text = impact_line(sample::impact(), "ball", "table");
  EXPECT_EQ(text.substr(0, 22), "28 0.45 ball table 0.5");
  const auto words = [](std::string_view line) {
    return std::count(line.begin(), line.end(), ' ') + 1;
  };
  EXPECT_EQ(words(text), words(kImpactLinesTitle) - 1);  // the # is a word
  // A name with a space is quoted, and stays one column for who reads quotes.
  EXPECT_NE(impact_line(sample::impact(), "big ball", "table").find("\"big ball\" table "),
            std::string::npos);
}

TEST(StatusText, ShowsNoMethodWhereNothingHasMoved) {
  EXPECT_NE(status_text("push_me", {}).find("methods      none yet\n"), std::string::npos);
}

TEST(StatusText, ShowsPaceLatenessClientsAndRecording) {
  RunReport report;
  report.time_scale = 2;
  report.real_time_factor_window = 1.5;
  report.lateness = {1e-5, 2e-4, 3e-3};
  report.recording = "today";
  report.held_wrenches = 4;
  report.clients = {{.client = 0xAB, .held = 3, .accepted = 20, .refused = 2, .limited = 1},
                    {.client = 0xCD, .alive = false}};
  const std::string text = status_text("push_me", report);
  for (const char* line :
       {"1.500 over the last seconds, 2 asked for\n",
        "lateness     p50 0.010, p99 0.200, max 3.000 ms; 0 overruns\n", "recording    today\n",
        "held         4\n", "00000000000000ab alive         3         20          2          1\n",
        "00000000000000cd gone "})
    EXPECT_NE(text.find(line), std::string::npos) << line << text;
  report.time_scale = 0;
  EXPECT_NE(status_text("push_me", report).find("as fast as it can"), std::string::npos);
}

TEST(ImpactLine, HasNoNegativeZeros) {
  ImpactNotice impact = sample::impact();
  impact.point = {-0.0, 1, -0.0};
  EXPECT_NE(impact_line(impact, "a", "b").find(" a b 0 1 0 "), std::string::npos);
}

TEST(ContactLines, HaveAsManyWordsAsTheirTitleAndTheBodiesThatAreShown) {
  ContactSnapshot contacts;
  contacts.session = 7;
  contacts.frame = 30;
  contacts.contacts = {{sample::kBox, sample::kTable, {1, 2, 3}, {0, 0, 1}, {-0.0, 0, 9.81}},
                       {sample::kBall, sample::kTable, {4, 5, 6}, {0, 0, 1}, {0, 0, 2}}};
  const std::string one = contact_lines(contacts, Roster(sample::bodies(), {"box"}), 60);
  EXPECT_EQ(one, "30 0.5 box table 1 2 3 0 0 1 0 0 9.81\n");
  const std::string all = contact_lines(contacts, Roster(sample::bodies(), {}), 60);
  EXPECT_EQ(std::count(all.begin(), all.end(), '\n'), 2);
  EXPECT_EQ(std::count(kContactLinesTitle.begin(), kContactLinesTitle.end(), ' '),
            std::count(one.begin(), one.end(), ' ') + 1);
}

TEST(PushText, NamesAnImpulseAndATether) {
  Reply reply;
  reply.first_frame = reply.last_frame = 1;
  WrenchCommand impulse;
  impulse.body_name = "box";
  impulse.kind = WrenchKind::impulse;
  impulse.force = {0, 0, 2};
  EXPECT_EQ(push_text(impulse, reply, 60),
            "box: frame 1, 0.000 s to 0.017 s: impulse (0, 0, 2) N s at the centre of mass, world "
            "axes\n");
  WrenchCommand tether;
  tether.body_name = "box";
  tether.kind = WrenchKind::tether;
  tether.target = {0, 0, 1};
  tether.stiffness = 50;
  tether.damping = 20;
  reply.last_frame = kForever;
  EXPECT_EQ(push_text(tether, reply, 60),
            "box: frames 1 until cleared (from 0.000 s): tether to (0, 0, 1) m, 50 N/m, 20 N s/m, "
            "at the centre of mass\n");
}

TEST(ListText, GivesNameMassAndShapeOfEachBody) {
  const std::string text = list_text("push_me", {}, sample::bodies());
  EXPECT_NE(text.find("3 bodies\n"), std::string::npos) << text;
  EXPECT_NE(text.find("  table                static       box\n"), std::string::npos) << text;
  EXPECT_NE(text.find("  big ball             0.25 kg      sphere\n"), std::string::npos) << text;
}

}  // namespace
}  // namespace poinsot
