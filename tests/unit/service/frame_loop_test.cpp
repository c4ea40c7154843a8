#include "poinsot/service/frame_loop.h"

#include <ctime>

#include "unit/service/loop_fixture.h"

namespace poinsot {
namespace {

using namespace std::chrono_literals;

using test::control;
using test::falling_box;
using test::FrameLoopTest;
using test::hashes_without_commands;
using test::push;

TEST_F(FrameLoopTest, EndsByItselfAfterItsFrames) {
  std::vector<std::uint64_t> seen;
  start({.scale = 0, .frames = 50, .each_frame = [&](const PresentationLayer& layer) {
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
  expect(control(1, 1, static_cast<ControlAction>(99)), ResultCode::invalid_value, "action is 99");
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
  inbox_.count_refused();
  ask(control(1, 3, ControlAction::pause));
  const RunReport report = outbox_.newest_report();
  EXPECT_EQ(report.commands_refused, 2u);
  ask(control(1, 4, ControlAction::pause));
  EXPECT_EQ(outbox_.newest_report().commands_accepted, 2u);  // the push and the first pause
}

}  // namespace
}  // namespace poinsot
