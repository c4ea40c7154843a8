#include "poinsot/service/run_daemon.h"

#include <gtest/gtest.h>

#include "support/scene_builder.h"

namespace poinsot {
namespace {

TEST(Invitation, NamesABodyThatMovesAndAForceThatLiftsIt) {
  Scene scene = test::empty_scene();
  scene.bodies = {test::floor(), test::box("crate", Vec3(0, 0, 1), Vec3(1, 1, 1), 3.7)};
  const std::string text = invitation(scene, {});
  EXPECT_NE(text.find("poinsot watch\n"), std::string::npos) << text;
  // 1.5 · 9.81 · 3.7 = 54.4
  EXPECT_NE(text.find("poinsot push crate --force 0,0,54 --for 0.5s\n"), std::string::npos) << text;
}

TEST(Invitation, PrefersABodyOfOneShape) {
  Scene scene = test::empty_scene();
  scene.bodies = {test::box("table", Vec3(0, 0, 0)), test::box("cup", Vec3(0, 0, 2))};
  scene.bodies[0].shapes.push_back(scene.bodies[0].shapes[0]);
  EXPECT_NE(invitation(scene, {}).find("push cup "), std::string::npos);
  scene.bodies.pop_back();
  EXPECT_NE(invitation(scene, {}).find("push table "), std::string::npos);
}

TEST(Invitation, LeadsToADaemonOnAnotherDomain) {
  Scene scene = test::empty_scene();
  scene.bodies = {test::box("crate", Vec3(0, 0, 1))};
  const std::string text = invitation(scene, {.domain = 5, .lan = true});
  EXPECT_NE(text.find("watch --domain 5 --listen lan\n"), std::string::npos) << text;
  EXPECT_NE(text.find("--for 0.5s --domain 5 --listen lan\n"), std::string::npos) << text;
}

TEST(Invitation, QuotesNamesForTheShell) {
  Scene scene = test::empty_scene();
  scene.bodies = {test::box("Bob's $crate", Vec3(0, 0, 1))};
  EXPECT_NE(invitation(scene, {}).find("push 'Bob'\\''s $crate' --force"), std::string::npos);
}

TEST(Invitation, PushesNothingWhereNothingMoves) {
  Scene scene = test::empty_scene();
  scene.bodies = {test::floor()};
  EXPECT_EQ(invitation(scene, {}).find("push"), std::string::npos);
}

TEST(StatusLine, ShowsTheFiguresAndTroubleOnlyIfThereIsAny) {
  RunReport report;
  report.state = RunState::playing;
  report.epoch = 1;
  report.frame.frame = 120;
  report.frame.sim_time = 2;
  report.frame.bodies = 5;
  report.frame.contacts = 18;
  report.frame.energy_error = 1.25e-7;
  report.frame.position_error = 3e-16;
  report.frame.orientation_error = 2e-15;
  report.frame.momentum_error = 1e-14;
  report.frame.methods[static_cast<std::size_t>(Method::flight)] = 3;
  report.frame.methods[static_cast<std::size_t>(Method::taylor)] = 2;
  report.real_time_factor = 1;
  EXPECT_EQ(status_line(report),
            "frame 120  time 2.00 s  real-time factor 1  bodies 5  contacts 18  "
            "energy error 1.2e-07  local error 3e-16 m 2e-15 rad  momentum error 1e-14  "
            "flight 3, taylor 2");
  report.state = RunState::paused;
  report.epoch = 3;
  report.overruns = 7;
  report.frame.quarantined = 2;
  EXPECT_NE(status_line(report).find("  paused  epoch 3  late frames 7  frozen bodies 2"),
            std::string::npos);
}

}  // namespace
}  // namespace poinsot
