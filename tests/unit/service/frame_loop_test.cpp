#include "poinsot/service/frame_loop.h"

#include <chrono>
#include <ctime>
#include <map>
#include <memory>
#include <thread>

#include <gtest/gtest.h>

#include "support/scene_builder.h"

namespace poinsot {
namespace {

using namespace std::chrono_literals;

Scene falling_box() {
  Scene scene = test::empty_scene();
  scene.simulation.gravity = Vec3(0, 0, -9.81);
  scene.presentation.frame_rate = 100;
  scene.bodies = {test::floor(), test::box("box", Vec3(0, 0, 2))};
  return scene;
}

WrenchCommand push(std::uint64_t client, std::uint64_t seq, const Vec3& force = Vec3(1, 0, 0)) {
  WrenchCommand command;
  command.client = client;
  command.seq = seq;
  command.body_name = "box";
  command.force = force;
  command.hold = Hold::until_cleared;
  return command;
}

RunControl control(std::uint64_t client, std::uint64_t seq, ControlAction action,
                   std::uint64_t frames = 1) {
  return {.client = client, .seq = seq, .epoch = 0, .action = action, .frames = frames};
}

// A loop on its own thread, without a bus: the test stands at both ends.
class FrameLoopTest : public testing::Test {
 protected:
  void start(FrameLoopOptions options) {
    loop_ = std::make_unique<FrameLoop>(layer_, inbox_, outbox_, std::move(options));
    thread_ = std::jthread([this](const std::stop_token& stop) { loop_->run(stop); });
  }
  void TearDown() override { end(); }
  void end() {
    thread_.request_stop();
    if (thread_.joinable()) thread_.join();
  }

  // Waits for the reply to (client, seq); fails the test when none comes.
  Reply reply_to(std::uint64_t client, std::uint64_t seq) {
    const auto deadline = std::chrono::steady_clock::now() + 20s;
    std::vector<Reply> batch;
    do {
      outbox_.wait({}, 5ms);
      if (outbox_.take(batch))
        for (Reply& reply : batch) {
          ++replies_to_[{reply.client, reply.seq}];
          replies_[{reply.client, reply.seq}] = reply;
        }
      if (const auto found = replies_.extract(std::pair(client, seq))) return found.mapped();
    } while (std::chrono::steady_clock::now() < deadline);
    ADD_FAILURE() << "no reply to " << client << "." << seq;
    return {};
  }

  Reply ask(const WrenchCommand& command) {
    EXPECT_TRUE(inbox_.push(command));
    return reply_to(command.client, command.seq);
  }
  Reply ask(const RunControl& command) {
    EXPECT_TRUE(inbox_.push(command));
    return reply_to(command.client, command.seq);
  }

  PresentationLayer layer_{falling_box()};
  CommandInbox inbox_;
  Outbox outbox_{1};
  std::unique_ptr<FrameLoop> loop_;
  std::jthread thread_;
  std::map<std::pair<std::uint64_t, std::uint64_t>, Reply> replies_;
  std::map<std::pair<std::uint64_t, std::uint64_t>, int> replies_to_;
};

std::vector<std::uint64_t> hashes_without_commands(int frames) {
  PresentationLayer layer(falling_box());
  std::vector<std::uint64_t> hashes = {layer.snapshot().state_hash};
  for (int n = 0; n < frames; ++n) {
    layer.advance_frame();
    hashes.push_back(layer.snapshot().state_hash);
  }
  return hashes;
}

TEST_F(FrameLoopTest, EndsByItselfAfterItsFrames) {
  std::vector<std::uint64_t> seen;
  start({.fast = true, .frames = 50, .each_frame = [&](const PresentationLayer& layer) {
           seen.push_back(layer.snapshot().state_hash);
         }});
  thread_.join();
  EXPECT_EQ(loop_->frames(), 50u);
  EXPECT_EQ(seen, hashes_without_commands(50));
  EXPECT_EQ(outbox_.newest_report().state, RunState::quitting);
  EXPECT_EQ(outbox_.newest_report().frame.frame, 50u);
}

TEST_F(FrameLoopTest, PacesFramesInRealTime) {
  const auto begin = std::chrono::steady_clock::now();
  start({.frames = 30});  // at 100 Hz
  thread_.join();
  const double wall =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  EXPECT_GE(wall, 0.3 - 1e-3);
}

TEST_F(FrameLoopTest, AStopEndsAPacedRunInTheMiddleOfALongFrame) {
  Scene slow = falling_box();
  slow.presentation.frame_rate = 0.01;
  slow.collision.contact_step = 1;
  layer_ = PresentationLayer(slow);
  start({});
  std::this_thread::sleep_for(20ms);
  const auto begin = std::chrono::steady_clock::now();
  end();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, 2s);
  EXPECT_EQ(loop_->frames(), 0u);
}

TEST_F(FrameLoopTest, StepReturnsWhenItsFramesAreDoneWithFrameAndHash) {
  start({.paused = true});
  const Reply reply = ask(control(1, 1, ControlAction::step, 25));
  EXPECT_EQ(reply.code, ResultCode::ok) << reply.message;
  EXPECT_EQ(reply.last_frame, 25u);
  EXPECT_EQ(reply.state_hash, hashes_without_commands(25).back());
  std::this_thread::sleep_for(50ms);
  EXPECT_EQ(ask(control(1, 2, ControlAction::pause)).last_frame, 25u);  // it stayed there
}

TEST_F(FrameLoopTest, PauseHoldsAndResumeGoesOn) {
  start({});
  const Reply paused = ask(control(1, 1, ControlAction::pause));
  EXPECT_EQ(paused.code, ResultCode::ok);
  std::this_thread::sleep_for(60ms);
  const Reply resumed = ask(control(1, 2, ControlAction::resume));
  EXPECT_EQ(resumed.last_frame, paused.last_frame);
  std::this_thread::sleep_for(60ms);
  EXPECT_GT(ask(control(1, 3, ControlAction::pause)).last_frame, paused.last_frame);
  EXPECT_EQ(outbox_.newest_report().state, RunState::paused);
}

TEST_F(FrameLoopTest, CostsNothingWhilePaused) {
  start({.paused = true});
  ask(control(1, 1, ControlAction::pause));
  clockid_t clock;
  ASSERT_EQ(pthread_getcpuclockid(thread_.native_handle(), &clock), 0);
  const auto cpu = [&] {
    timespec t{};
    clock_gettime(clock, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  };
  const double before = cpu();
  std::this_thread::sleep_for(300ms);
  EXPECT_LT(cpu() - before, 0.003);  // [s] one percent
}

TEST_F(FrameLoopTest, RepliesAtAcceptanceWhilePaused) {
  start({.paused = true});
  const Reply reply = ask(push(1, 1));
  EXPECT_EQ(reply.code, ResultCode::ok);
  EXPECT_EQ(reply.first_frame, 1u);
  EXPECT_EQ(reply.last_frame, kForever);
  ask(control(1, 2, ControlAction::step, 1));
  // 1 N on 2 kg for 1/100 s
  PoseSnapshot snapshot;
  ASSERT_TRUE(outbox_.take(snapshot));
  EXPECT_NEAR(snapshot.bodies[0].linear_velocity.x(), 0.005, 1e-15);
}

TEST_F(FrameLoopTest, TheSameCommandAgainGetsTheSameReplyAndActsOnce) {
  start({.paused = true});
  const Reply first = ask(push(1, 1));
  ask(control(1, 2, ControlAction::step, 10));
  const Reply again = ask(push(1, 1));
  EXPECT_EQ(again.first_frame, first.first_frame);
  EXPECT_EQ(again.code, first.code);
  const Reply step_again = ask(control(1, 2, ControlAction::step, 10));
  EXPECT_EQ(step_again.last_frame, 10u);
  ask(control(1, 3, ControlAction::step, 10));
  PoseSnapshot snapshot;
  ASSERT_TRUE(outbox_.take(snapshot));
  EXPECT_EQ(snapshot.frame, 20u);
  EXPECT_NEAR(snapshot.bodies[0].linear_velocity.x(), 0.1, 1e-14);  // once 1 N on 2 kg for 0.2 s
}

TEST_F(FrameLoopTest, AStepSentAgainWhileItRunsIsAnsweredOnce) {
  start({.paused = true});
  const RunControl step = control(1, 1, ControlAction::step, 3'000);
  inbox_.push(step);
  for (int n = 0; n < 5; ++n) inbox_.push(step);
  EXPECT_EQ(reply_to(1, 1).last_frame, 3'000u);
  ask(control(1, 2, ControlAction::pause));
  EXPECT_EQ(replies_to_.at({1, 1}), 1);
}

TEST_F(FrameLoopTest, ResetBeginsTheNextEpochWithTheHashesOfAFreshStart) {
  start({.paused = true});
  ask(push(1, 1));
  ask(control(1, 2, ControlAction::step, 30));
  const Reply reset = ask(control(1, 3, ControlAction::reset));
  EXPECT_EQ(reset.code, ResultCode::ok);
  EXPECT_EQ(reset.epoch, 2u);
  EXPECT_EQ(reset.last_frame, 0u);
  EXPECT_EQ(reset.state_hash, hashes_without_commands(0).back());
  EXPECT_EQ(loop_->epoch(), 2u);
  const Reply step = ask(control(1, 4, ControlAction::step, 40));
  EXPECT_EQ(step.state_hash, hashes_without_commands(40).back());
  WrenchCommand old = push(1, 5);
  old.epoch = 1;
  EXPECT_EQ(ask(old).code, ResultCode::wrong_epoch);
}

TEST_F(FrameLoopTest, APauseEndsAStepEarlyAndBothAreAnswered) {
  start({.paused = true});
  inbox_.push(control(1, 1, ControlAction::step, kMaxStepFrames));
  std::this_thread::sleep_for(10ms);
  const Reply pause = ask(control(2, 1, ControlAction::pause));
  EXPECT_EQ(pause.code, ResultCode::ok);
  const Reply step = reply_to(1, 1);
  EXPECT_EQ(step.code, ResultCode::operation_failed);
  EXPECT_EQ(step.message, "ended early by pause");
  EXPECT_EQ(step.last_frame, pause.last_frame);
}

TEST_F(FrameLoopTest, AnswersAPendingStepWhenTheRunEnds) {
  start({.paused = true});
  inbox_.push(control(1, 1, ControlAction::step, kMaxStepFrames));
  std::this_thread::sleep_for(10ms);
  end();
  EXPECT_EQ(reply_to(1, 1).code, ResultCode::operation_failed);
}

TEST_F(FrameLoopTest, ControlsThatMakeNoSenseAreRefusedWithTheReason) {
  start({.paused = true});
  const auto expect = [&](RunControl command, ResultCode code, const std::string& reason) {
    const Reply reply = ask(command);
    EXPECT_EQ(reply.code, code) << reply.message;
    EXPECT_NE(reply.message.find(reason), std::string::npos) << reply.message;
  };
  expect(control(1, 0, ControlAction::pause), ResultCode::invalid_value, "seq is 0");
  expect(control(1, 1, static_cast<ControlAction>(9)), ResultCode::invalid_value, "action is 9");
  expect(control(1, 2, ControlAction::step, 0), ResultCode::invalid_value, "frames is 0");
  expect(control(1, 3, ControlAction::step, kMaxStepFrames + 1), ResultCode::invalid_value,
         "1000000001");
  RunControl old = control(1, 4, ControlAction::reset);
  old.epoch = 7;
  expect(old, ResultCode::wrong_epoch, "meant for epoch 7; epoch 1 runs");
  ask(control(1, 5, ControlAction::resume));
  expect(control(1, 6, ControlAction::step), ResultCode::incorrect_state, "pause it first");
}

TEST_F(FrameLoopTest, ASecondStepIsRefusedWhileOneRuns) {
  start({.paused = true});
  inbox_.push(control(1, 1, ControlAction::step, kMaxStepFrames));
  const Reply second = ask(control(2, 1, ControlAction::step, 5));
  EXPECT_EQ(second.code, ResultCode::incorrect_state);
  EXPECT_NE(second.message.find("under way until frame 1000000000"), std::string::npos);
}

TEST_F(FrameLoopTest, APushSentBeforeAResetDoesNotReachTheNextEpoch) {
  // Both in one batch, the reset first to arrive: (client, seq) decides.
  inbox_.push(control(1, 2, ControlAction::reset));
  inbox_.push(push(1, 1, Vec3(100, 0, 0)));
  start({.paused = true});
  EXPECT_EQ(reply_to(1, 1).epoch, 1u);
  EXPECT_EQ(reply_to(1, 2).epoch, 2u);
  EXPECT_EQ(ask(control(1, 3, ControlAction::step, 30)).state_hash,
            hashes_without_commands(30).back());
}

TEST_F(FrameLoopTest, OrderOfArrivalWithinAFrameDoesNotMatter) {
  std::vector<WrenchCommand> commands;
  for (std::uint64_t client = 1; client <= 4; ++client)
    for (std::uint64_t seq = 1; seq <= 4; ++seq)
      commands.push_back(push(client, seq, Vec3(0.1 * static_cast<double>(client), 1e-9, 1e5)));
  for (const auto& command : commands) inbox_.push(command);
  start({.paused = true});
  const std::uint64_t forwards = ask(control(9, 1, ControlAction::step, 20)).state_hash;
  end();

  layer_ = PresentationLayer(falling_box());
  for (auto command = commands.rbegin(); command != commands.rend(); ++command)
    inbox_.push(*command);
  start({.paused = true});
  EXPECT_EQ(ask(control(9, 2, ControlAction::step, 20)).state_hash, forwards);
  EXPECT_NE(forwards, hashes_without_commands(20).back());
}

TEST_F(FrameLoopTest, ReportsAMethodForEachDynamicBody) {
  start({.paused = true});
  ask(control(1, 1, ControlAction::step, 2));
  EXPECT_EQ(outbox_.newest_report().body_methods.size(), 1u);  // the floor is static
}

TEST_F(FrameLoopTest, CountsAcceptedAndRefusedCommands) {
  start({.paused = true});
  ask(push(1, 1));
  WrenchCommand bad = push(1, 2);
  bad.body_name = "bxo";
  EXPECT_EQ(ask(bad).code, ResultCode::not_found);
  ask(bad);  // again: answered, not counted again
  inbox_.count_malformed();
  ask(control(1, 3, ControlAction::pause));
  const RunReport report = outbox_.newest_report();
  EXPECT_EQ(report.commands_refused, 2u);
  ask(control(1, 4, ControlAction::pause));
  EXPECT_EQ(outbox_.newest_report().commands_accepted, 2u);  // the push and the first pause
}

}  // namespace
}  // namespace poinsot
