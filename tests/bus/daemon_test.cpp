#include "poinsot/service/daemon.h"

#include <atomic>
#include <functional>
#include <limits>
#include <set>
#include <thread>

#include <gtest/gtest.h>

#include "poinsot/client/client.h"
#include "poinsot/wire/publisher.h"
#include "poinsot/wire/subscriber.h"
#include "support/scene_builder.h"
#include "support/test_domain.h"

namespace poinsot {
namespace {

using namespace std::chrono_literals;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Scene two_boxes(const std::string& world) {
  Scene scene = test::empty_scene(world);
  scene.simulation.gravity = Vec3(0, 0, -9.81);
  scene.bodies = {test::floor(), test::box("box", Vec3(0, 0, 5)),
                  test::box("crate", Vec3(3, 0, 1))};
  return scene;
}

std::uint64_t hash_without_clients(const Scene& scene, std::uint64_t frames,
                                   const std::vector<WrenchCommand>& commands = {}) {
  PresentationLayer layer(scene);
  std::vector<Reply> replies;
  layer.accept(commands, replies);
  while (layer.frame() < frames) layer.advance_frame();
  return layer.snapshot().state_hash;
}

// A daemon on the test's domain and a client that has found it.
class DaemonTest : public testing::Test {
 protected:
  void start(const Scene& scene, DaemonOptions options) {
    options.domain = test_domain();
    logger_->set_level(spdlog::level::off);
    daemon_.emplace(scene, options, logger_, [this] { ended_ = true; });
    client_.emplace(ClientOptions{.world = scene.world, .domain = test_domain()});
    client_->wait_for_server(kPatience);
  }

  Reply step(std::uint64_t frames) {
    const Reply reply =
        client_->control({.action = ControlAction::step, .frames = frames}, kPatience);
    EXPECT_EQ(reply.code, ResultCode::ok) << reply.message;
    return reply;
  }

  const Logger logger_ = make_logger("test", spdlog::level::off, 0);
  std::atomic<bool> ended_ = false;
  std::optional<Daemon> daemon_;
  std::optional<Client> client_;
};

TEST_F(DaemonTest, APushChangesTheVelocityOnTheFramesThatTheReplyNames) {
  Scene scene = two_boxes("push");
  scene.simulation.gravity = Vec3::Zero();
  start(scene, {.paused = true});
  step(3);
  const Reply reply = client_->apply({.body_name = "box",
                                      .force = Vec3(6, 0, 0),
                                      .hold = Hold::duration,
                                      .duration_ns = 50'000'000,
                                      .start_frame = 5},
                                     kPatience);
  ASSERT_EQ(reply.code, ResultCode::ok) << reply.message;
  EXPECT_EQ(reply.first_frame, 5u);
  EXPECT_EQ(reply.last_frame, 7u);
  PoseSnapshot poses;
  for (std::uint64_t frame = 4; frame <= 9; ++frame) {
    step(1);
    while (poses.frame < frame) ASSERT_TRUE(client_->next_poses(poses, kPatience)) << frame;
    const double frames = std::clamp<double>(static_cast<double>(frame) - 4, 0, 3);
    EXPECT_NEAR(poses.bodies[0].linear_velocity.x(), 6.0 / 2 * frames / 60, 1e-14) << frame;
  }
}

TEST_F(DaemonTest, MalformedCommandsAreAnsweredAndLeaveTheRunUntouched) {
  const Scene scene = two_boxes("malformed");
  start(scene, {.paused = true});
  WrenchCommand good{.body_name = "box", .force = Vec3(5, 1, 0), .hold = Hold::until_cleared};
  const Reply accepted = client_->apply(good, kPatience);
  ASSERT_EQ(accepted.code, ResultCode::ok);
  good.client = accepted.client;  // part of the hash while the wrench is held
  good.seq = accepted.seq;

  const std::vector<std::pair<ResultCode, std::function<void(WrenchCommand&)>>> spoilers = {
      {ResultCode::not_found, [](auto& c) { c.body_name = "bxo"; }},
      {ResultCode::not_found, [](auto& c) { c.body_name = std::string(127, 'x'); }},
      {ResultCode::not_found,
       [](auto& c) {
         c.body = {99, 1};
       }},
      {ResultCode::not_found,
       [](auto& c) {
         c.body = {1, 7};
       }},
      {ResultCode::invalid_value, [](auto& c) { c.body_name = ""; }},
      {ResultCode::incorrect_state, [](auto& c) { c.body_name = "floor"; }},
      {ResultCode::wrong_epoch, [](auto& c) { c.epoch = 2; }},
      {ResultCode::wrong_epoch, [](auto& c) { c.epoch = UINT32_MAX; }},
      {ResultCode::too_late, [](auto& c) { c.start_frame = 1; }},
      {ResultCode::invalid_value, [](auto& c) { c.start_frame = kForever; }},
      {ResultCode::invalid_value, [](auto& c) { c.force.x() = kNaN; }},
      {ResultCode::invalid_value, [](auto& c) { c.force.z() = -HUGE_VAL; }},
      {ResultCode::invalid_value, [](auto& c) { c.force.y() = 1e300; }},
      {ResultCode::invalid_value, [](auto& c) { c.torque.x() = kNaN; }},
      {ResultCode::invalid_value, [](auto& c) { c.torque.y() = HUGE_VAL; }},
      {ResultCode::invalid_value, [](auto& c) { c.torque.z() = -1e13; }},
      {ResultCode::invalid_value,
       [](auto& c) {
         c.point_frame = PointFrame::world;
         c.point.x() = kNaN;
       }},
      {ResultCode::invalid_value,
       [](auto& c) {
         c.point_frame = PointFrame::body;
         c.point.y() = 1e10;
       }},
      {ResultCode::invalid_value, [](auto& c) { c.hold = Hold::duration; }},
      {ResultCode::invalid_value,
       [](auto& c) {
         c.hold = Hold::duration;
         c.duration_ns = INT64_MIN;
       }},
      {ResultCode::invalid_value,
       [](auto& c) {
         c.hold = Hold::duration;
         c.duration_ns = INT64_MAX;
       }},
      {ResultCode::invalid_value, [](auto& c) { c.hold = static_cast<Hold>(200); }},
      {ResultCode::invalid_value, [](auto& c) { c.axes = static_cast<Axes>(3); }},
      {ResultCode::invalid_value, [](auto& c) { c.point_frame = static_cast<PointFrame>(77); }},
  };
  std::uint64_t frame = step(2).last_frame;
  for (std::size_t n = 0; n < spoilers.size(); ++n) {
    WrenchCommand command{.body_name = "box", .force = Vec3(1, 1, 1)};
    spoilers[n].second(command);
    const Reply reply = client_->apply(command, kPatience);
    EXPECT_EQ(reply.code, spoilers[n].first) << n << ": " << reply.message;
    EXPECT_NE(reply.message, "") << n;
    frame = step(1).last_frame;
  }
  EXPECT_EQ(step(1).state_hash, hash_without_clients(scene, frame + 1, {good}));
  EXPECT_EQ(client_->report(kPatience).commands_refused, spoilers.size());
}

TEST_F(DaemonTest, ClearsAllThatAClientHoldsWhenNoBodyIsNamed) {
  Scene scene = two_boxes("clear");
  scene.simulation.gravity = Vec3::Zero();
  start(scene, {.paused = true});
  for (const char* body : {"box", "crate"})
    client_->apply({.body_name = body, .force = Vec3(6, 0, 0), .hold = Hold::until_cleared},
                   kPatience);
  step(1);
  EXPECT_EQ(client_->apply({.hold = Hold::clear}, kPatience).code, ResultCode::ok);
  step(5);
  PoseSnapshot poses;
  while (poses.frame < 6) ASSERT_TRUE(client_->next_poses(poses, kPatience));
  for (const BodyState& body : poses.bodies)
    EXPECT_NEAR(body.linear_velocity.x(), 0.05, 1e-15);  // one frame of 6 N on 2 kg
}

TEST_F(DaemonTest, WhoSendsTooMuchIsToldAndMaySendAgain) {
  DaemonOptions options;
  options.limits = {.commands_per_second = 100, .commands_at_once = 50};
  start(two_boxes("flood"), options);
  Participant participant({.domain = test_domain()});
  Publisher<WrenchCommand> wrenches(participant, "flood");
  Subscriber<Reply> replies(participant, "flood");
  ASSERT_TRUE(eventually([&] { return wrenches.readers() > 0 && replies.writers() > 0; }));
  constexpr std::uint64_t kCommands = 200;
  std::set<std::uint64_t> accepted;
  std::uint64_t limited = 0;
  EXPECT_TRUE(eventually([&] {
    for (std::uint64_t seq = 1; seq <= kCommands; ++seq)
      if (!accepted.contains(seq)) wrenches.write({.client = 3, .seq = seq, .body_name = "box"});
    std::this_thread::sleep_for(100ms);
    for (Reply reply; replies.take(reply);) {
      if (reply.client != 3) continue;
      EXPECT_TRUE(reply.code == ResultCode::rate_limited || reply.code == ResultCode::ok)
          << reply.message;
      if (reply.code == ResultCode::ok)
        accepted.insert(reply.seq);
      else
        ++limited;
    }
    return accepted.size() == kCommands;
  }));
  EXPECT_GT(limited, 0u);
  RunReport report;
  EXPECT_TRUE(eventually([&] {
    report = client_->report(kPatience);
    return report.commands_limited > 0;
  }));
}

TEST_F(DaemonTest, ALateJoinerSeesWhereAPausedRunStands) {
  start(two_boxes("late"), {.paused = true});
  step(7);
  Client late({.world = "late", .domain = test_domain()});
  late.wait_for_server(kPatience);
  PoseSnapshot poses;
  ASSERT_TRUE(late.next_poses(poses, kPatience));
  EXPECT_EQ(poses.frame, 7u);
  EXPECT_EQ(late.scene(kPatience).size(), 3u);
  EXPECT_EQ(late.report(kPatience).state, RunState::paused);
}

TEST_F(DaemonTest, StopsWithinTwoSecondsAndTheClientMeetsTheNextOne) {
  const Scene scene = two_boxes("again");
  start(scene, {});
  PoseSnapshot poses;
  ASSERT_TRUE(client_->next_poses(poses, kPatience));
  const std::uint64_t session = poses.session;
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_GT(daemon_->stop().frames, 0u);
  daemon_.reset();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, 2s);
  daemon_.emplace(scene, DaemonOptions{.domain = test_domain()}, logger_, [] {});
  EXPECT_TRUE(
      eventually([&] { return client_->next_poses(poses, 100ms) && poses.session != session; }));
}

TEST_F(DaemonTest, EndsByItselfWithTheHashOfARunWithoutABus) {
  const Scene scene = two_boxes("frames");
  start(scene, {.scale = 0, .paused = true, .frames = 100});
  client_->control({.action = ControlAction::resume}, kPatience);
  EXPECT_TRUE(eventually([&] { return ended_.load(); }));
  const RunSummary summary = daemon_->stop();
  EXPECT_EQ(summary.frames, 100u);
  EXPECT_EQ(summary.state_hash, hash_without_clients(scene, 100));
}

TEST_F(DaemonTest, TellsImpactsToThoseWhoListen) {
  Scene scene = two_boxes("impacts");
  // The crate falls 0.5 m, flat.
  start(scene, {.paused = true});
  ImpactNotice impact;
  EXPECT_FALSE(client_->next_impact(impact, 500ms));  // listens; the publisher has seen it
  step(60);
  ASSERT_TRUE(client_->next_impact(impact, kPatience));
  EXPECT_EQ(impact.epoch, 1u);
  EXPECT_EQ(impact.frame, 20u);  // √(2·0.5/g) = 0.31928 s
  EXPECT_NEAR(impact.time, std::sqrt(1 / 9.81), 1e-9);
  EXPECT_NEAR(impact.normal.z(), 1, 1e-12);
  EXPECT_NEAR(impact.a.linear_before.z(), -std::sqrt(9.81), 1e-8);
  EXPECT_GT(impact.impulse.z(), 0);
  const RunReport report = client_->report(kPatience);
  EXPECT_GE(report.frame.impacts_so_far, 1u);
  EXPECT_EQ(report.events_dropped, 0u);
}

}  // namespace
}  // namespace poinsot
