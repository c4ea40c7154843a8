// What a client may ask of the loop beyond pause, step and reset.

#include <limits>

#include "unit/service/loop_fixture.h"

namespace poinsot {
namespace {

using namespace std::chrono_literals;
using test::control;
using test::hashes_without_commands;
using test::push;

class FrameLoopOrders : public test::FrameLoopTest {
 protected:
  static RunControl with_value(std::uint64_t client, std::uint64_t seq, ControlAction action,
                               double value) {
    RunControl result = control(client, seq, action);
    result.value = value;
    return result;
  }
  static RunControl lock_step(std::uint64_t client, std::uint64_t seq,
                              std::chrono::nanoseconds timeout) {
    RunControl result = control(client, seq, ControlAction::lock_step);
    result.timeout_ns = timeout.count();
    return result;
  }
  // What the receiver does when a client is gone.
  void lose(std::uint64_t client) {
    inbox_.push_own(Order{.control = control(client, kOwnSeq, ControlAction::release)});
  }
};

// run_until ---------------------------------------------------------------------------------------

TEST_F(FrameLoopOrders, RunUntilStopsAtTheFirstFrameAtOrAfterTheTime) {
  start({.scale = 0, .paused = true});
  const Reply reply = ask(with_value(1, 1, ControlAction::run_until, 0.251));  // at 100 Hz
  EXPECT_EQ(reply.code, ResultCode::ok) << reply.message;
  EXPECT_EQ(reply.last_frame, 26u);
  EXPECT_EQ(reply.state_hash, hashes_without_commands(26).back());
  EXPECT_EQ(outbox_.newest_report().state, RunState::paused);
  // A time that is a frame's up to rounding is that frame.
  EXPECT_EQ(ask(with_value(1, 2, ControlAction::run_until, 0.1 + 0.2)).last_frame, 30u);
}

TEST_F(FrameLoopOrders, RunUntilIsPaced) {
  start({.paused = true});
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(ask(with_value(1, 1, ControlAction::run_until, 0.1)).last_frame, 10u);
  EXPECT_GE(std::chrono::steady_clock::now() - begin, 90ms);  // the first frame is due at once
}

TEST_F(FrameLoopOrders, RunUntilATimeThatHasPassedPausesAtOnce) {
  start({});
  ask(control(1, 1, ControlAction::pause));
  ask(control(1, 2, ControlAction::step, 20));
  ask(control(1, 3, ControlAction::resume));
  const Reply reply = ask(with_value(1, 4, ControlAction::run_until, 0.1));
  EXPECT_EQ(reply.code, ResultCode::ok);
  EXPECT_GE(reply.last_frame, 20u);
  EXPECT_EQ(ask(control(1, 5, ControlAction::pause)).last_frame, reply.last_frame);
}

TEST_F(FrameLoopOrders, APauseEndsARunUntilEarlyAndASecondOneIsRefused) {
  start({});
  inbox_.push(with_value(1, 1, ControlAction::run_until, 1e6));
  const Reply second = ask(with_value(1, 2, ControlAction::run_until, 5));
  EXPECT_EQ(second.code, ResultCode::incorrect_state);
  EXPECT_EQ(second.message, "a run_until is under way until frame 100000000");
  const Reply pause = ask(control(2, 1, ControlAction::pause));
  const Reply run = reply_to(1, 1);
  EXPECT_EQ(run.code, ResultCode::operation_failed);
  EXPECT_EQ(run.message, "ended early by pause");
  EXPECT_EQ(run.last_frame, pause.last_frame);
}

// scale -------------------------------------------------------------------------------------------

TEST_F(FrameLoopOrders, AScaleChangesThePaceWithoutDebt) {
  start({});
  EXPECT_EQ(ask(with_value(1, 1, ControlAction::scale, 1e-3)).code, ResultCode::ok);
  const std::uint64_t slow = ask(with_value(1, 2, ControlAction::scale, 1e-3)).last_frame;
  std::this_thread::sleep_for(300ms);  // 0.03 frames
  const Reply fast =
      ask(with_value(1, 3, ControlAction::scale, 20));  // answered though none is due
  EXPECT_EQ(fast.last_frame, slow);
  EXPECT_EQ(outbox_.newest_report().time_scale, 20);
  const auto begin = std::chrono::steady_clock::now();
  const Reply later = ask(with_value(1, 4, ControlAction::run_until,
                                     1e-2 * static_cast<double>(fast.last_frame + 400)));
  // 400 frames of 0.5 ms: none of those that the slow time did not need is made up for.
  EXPECT_GE(std::chrono::steady_clock::now() - begin, 150ms);
  EXPECT_EQ(later.last_frame, fast.last_frame + 400);
}

TEST_F(FrameLoopOrders, ScaleZeroIsAsFastAsItCan) {
  start({});
  ask(with_value(1, 1, ControlAction::scale, 0));
  const auto begin = std::chrono::steady_clock::now();
  const Reply reply = ask(with_value(1, 2, ControlAction::run_until, 100));  // simulated seconds
  EXPECT_EQ(reply.last_frame, 10'000u);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, 20s);
}

TEST_F(FrameLoopOrders, ValuesOutOfRangeAreRefusedWithTheReason) {
  start({.paused = true});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::uint64_t seq = 0;
  for (const double value : {-1.0, 1e-7, 1e7, nan, HUGE_VAL})
    EXPECT_EQ(ask(with_value(1, ++seq, ControlAction::scale, value)).code,
              ResultCode::invalid_value)
        << value;
  for (const double value : {-1.0, 2e9, nan, HUGE_VAL})
    EXPECT_EQ(ask(with_value(1, ++seq, ControlAction::run_until, value)).code,
              ResultCode::invalid_value)
        << value;
  EXPECT_EQ(ask(lock_step(1, ++seq, -1ns)).code, ResultCode::invalid_value);
  EXPECT_EQ(ask(lock_step(1, ++seq, 2h)).code, ResultCode::invalid_value);
}

// lock step ---------------------------------------------------------------------------------------

TEST_F(FrameLoopOrders, InLockStepEveryFrameWaitsForEveryMember) {
  start({.scale = 0, .paused = true});
  ask(lock_step(1, 1, 1h));
  ask(lock_step(2, 1, 1h));
  ask(control(9, 1, ControlAction::resume));
  for (std::uint64_t frame = 1; frame <= 50; ++frame) {
    inbox_.push(control(1, 1 + frame, ControlAction::advance));
    const Reply second = ask(control(2, 1 + frame, ControlAction::advance));
    EXPECT_EQ(second.code, ResultCode::ok) << second.message;
    EXPECT_EQ(second.last_frame, frame);  // answered when the frame is done
    EXPECT_EQ(second.state_hash, reply_to(1, 1 + frame).state_hash);
  }
  EXPECT_EQ(ask(control(9, 2, ControlAction::pause)).state_hash,
            hashes_without_commands(50).back());
  EXPECT_EQ(outbox_.newest_report().late_inputs, 0u);
}

TEST_F(FrameLoopOrders, APushBeforeAnAdvanceActsInItsFrame) {
  start({.scale = 0, .paused = true});
  ask(lock_step(1, 1, 1h));
  ask(control(9, 1, ControlAction::resume));
  for (std::uint64_t n = 0; n < 20; ++n) {
    inbox_.push(push(1, 2 + 2 * n));
    EXPECT_EQ(ask(control(1, 3 + 2 * n, ControlAction::advance)).last_frame, n + 1);
    EXPECT_EQ(reply_to(1, 2 + 2 * n).first_frame, n + 1);
  }
}

TEST_F(FrameLoopOrders, AnInputThatDoesNotComeIsWaitedForAsLongAsSaidAndCounted) {
  inbox_.push(lock_step(1, 1, 30ms));
  start({.scale = 0, .frames = 3});
  EXPECT_EQ(reply_to(1, 1).code, ResultCode::ok);
  thread_.join();  // it goes on without
  const RunReport report = outbox_.newest_report();
  EXPECT_EQ(report.frame.frame, 3u);
  EXPECT_EQ(report.late_inputs, 3u);
}

TEST_F(FrameLoopOrders, TheNextReportSaysThatAnInputWasLate) {
  start({.scale = 0, .paused = true});
  ask(lock_step(1, 1, 5ms));
  ask(control(9, 1, ControlAction::step, 2));
  EXPECT_TRUE(has_flag(outbox_.newest_report().frame.flags, FrameFlag::input_late));
  EXPECT_EQ(outbox_.newest_report().late_inputs, 2u);
}

TEST_F(FrameLoopOrders, WaitingForAnInputBlocksNothingElse) {
  start({});
  ask(lock_step(1, 1, 1h));
  EXPECT_EQ(ask(push(2, 1)).code, ResultCode::ok);
  const Reply pause = ask(control(2, 2, ControlAction::pause));
  EXPECT_EQ(pause.code, ResultCode::ok);
  ask(control(1, 2, ControlAction::resume));
  EXPECT_EQ(ask(control(1, 3, ControlAction::advance)).last_frame, pause.last_frame + 1);
  // It waits, but owes nothing: no deadline was missed.
  std::this_thread::sleep_for(50ms);
  ask(control(2, 3, ControlAction::pause));
  EXPECT_EQ(outbox_.newest_report().overruns, 0u);
}

TEST_F(FrameLoopOrders, PausedStaysPausedAndTheInputIsKept) {
  start({.scale = 0, .paused = true});
  ask(lock_step(1, 1, 1h));
  inbox_.push(control(1, 2, ControlAction::advance));
  EXPECT_EQ(ask(control(2, 1, ControlAction::pause)).last_frame, 0u);
  EXPECT_EQ(ask(control(1, 3, ControlAction::advance)).code, ResultCode::incorrect_state);
  inbox_.push(control(1, 2, ControlAction::advance));  // sent again: not answered twice
  ask(control(2, 2, ControlAction::resume));
  EXPECT_EQ(reply_to(1, 2).last_frame, 1u);
  ask(control(2, 3, ControlAction::pause));
  EXPECT_EQ(replies_to_.at({1, 2}), 1);
}

TEST_F(FrameLoopOrders, AMemberThatIsGoneIsNoLongerWaitedFor) {
  start({.scale = 0, .paused = true});
  ask(lock_step(1, 1, 1h));
  ask(lock_step(2, 1, 1h));
  ask(control(9, 1, ControlAction::resume));
  lose(2);
  EXPECT_EQ(ask(control(1, 2, ControlAction::advance)).last_frame, 1u);
  lose(1);
  std::this_thread::sleep_for(20ms);
  EXPECT_GT(ask(control(9, 2, ControlAction::pause)).last_frame, 1u);
  EXPECT_EQ(outbox_.newest_report().late_inputs, 0u);
}

TEST_F(FrameLoopOrders, OnlyMembersMayAdvance) {
  start({.paused = true});
  EXPECT_EQ(ask(control(1, 1, ControlAction::advance)).code, ResultCode::incorrect_state);
  ask(lock_step(1, 2, 1h));
  inbox_.push(control(1, 3, ControlAction::advance));
  EXPECT_EQ(ask(lock_step(1, 4, 0ns)).code, ResultCode::ok);  // leaves
  EXPECT_EQ(reply_to(1, 3).code, ResultCode::operation_failed);
  EXPECT_EQ(ask(control(1, 5, ControlAction::advance)).code, ResultCode::incorrect_state);
}

TEST_F(FrameLoopOrders, AResetAnswersAnInputThatWaitsAndTheMemberStays) {
  start({.paused = true});
  ask(lock_step(1, 1, 1h));
  inbox_.push(control(1, 2, ControlAction::advance));
  ask(control(2, 1, ControlAction::reset));
  EXPECT_EQ(reply_to(1, 2).message, "ended early by reset");
  inbox_.push(control(1, 3, ControlAction::advance));
  EXPECT_EQ(ask(control(2, 2, ControlAction::step)).last_frame, 1u);
}

// the end -----------------------------------------------------------------------------------------

TEST_F(FrameLoopOrders, ShutdownIsAnsweredAndEndsTheRun) {
  start({.paused = true});
  const Reply reply = ask(control(1, 1, ControlAction::shutdown));
  EXPECT_EQ(reply.code, ResultCode::ok);
  thread_.join();
  EXPECT_EQ(outbox_.newest_report().state, RunState::quitting);
}

TEST_F(FrameLoopOrders, TheEndAnswersWhatIsUnderWay) {
  start({.paused = true});
  ask(lock_step(1, 1, 1h));
  inbox_.push(control(1, 2, ControlAction::advance));
  ask(control(2, 1, ControlAction::pause));
  end();
  EXPECT_EQ(reply_to(1, 2).message, "the daemon ends");
}

TEST_F(FrameLoopOrders, WithoutAPlaceOnDiskALogIsRefused) {
  start({.paused = true});
  RunControl record = control(1, 1, ControlAction::record);
  record.name = "log";
  EXPECT_EQ(ask(record).code, ResultCode::operation_failed);
  EXPECT_EQ(ask(control(1, 2, ControlAction::record)).code, ResultCode::incorrect_state);
}

TEST_F(FrameLoopOrders, TheReportTellsPaceAndClients) {
  clients_.admit(7, {1}, 1, SteadyTime::now());
  start({});
  ask(push(7, 1));
  std::this_thread::sleep_for(400ms);
  ask(lock_step(7, 2, 1h));
  const RunReport report = outbox_.newest_report();
  EXPECT_NEAR(report.real_time_factor, 1, 0.5);
  EXPECT_NEAR(report.real_time_factor_window, 1, 0.5);
  EXPECT_GT(report.frame_time.max, 0);
  EXPECT_GE(report.lateness.max, report.lateness.p50);
  EXPECT_EQ(report.scene_bodies, 2u);
  EXPECT_EQ(report.held_wrenches, 1u);
  ASSERT_EQ(report.clients.size(), 1u);
  EXPECT_EQ(report.clients[0].client, 7u);
  EXPECT_TRUE(report.clients[0].alive);
  EXPECT_TRUE(report.clients[0].lock_step);
  EXPECT_EQ(report.clients[0].accepted, 1u);  // the report is made before the reply counts
}

TEST_F(FrameLoopOrders, AResetThatIsRefusedDoesNotEndTheStepUnderWay) {
  start({.paused = true});
  inbox_.push(control(1, 1, ControlAction::step, kMaxStepFrames));
  RunControl reset = control(2, 1, ControlAction::reset);
  reset.scope = 0x80;
  EXPECT_EQ(ask(reset).code, ResultCode::invalid_value);
  EXPECT_EQ(ask(control(2, 2, ControlAction::step)).code, ResultCode::incorrect_state);
}

TEST_F(FrameLoopOrders, WhatComesAfterTheReleaseOfALostClientIsHeld) {
  ASSERT_TRUE(inbox_.push(push(1, 1)));
  lose(1);
  ASSERT_TRUE(inbox_.push(push(1, 2)));
  start({.paused = true});
  reply_to(1, 2);
  ask(control(2, 1, ControlAction::pause));
  EXPECT_EQ(outbox_.newest_report().held_wrenches, 1u);
}

TEST_F(FrameLoopOrders, ReportsGoOnWhileAnInputIsWaitedFor) {
  start({});
  ask(lock_step(1, 1, 60s));
  std::this_thread::sleep_for(50ms);  // it waits by now
  RunReport report;
  outbox_.take(report);
  const auto deadline = std::chrono::steady_clock::now() + 20s;
  bool told = false;
  while (!told && std::chrono::steady_clock::now() < deadline) {
    std::this_thread::sleep_for(5ms);
    told = outbox_.take(report);
  }
  EXPECT_TRUE(told);
}

TEST_F(FrameLoopOrders, WhatComesWhileTheRunEndsIsAnswered) {
  start({.paused = true});
  ask(control(1, 1, ControlAction::shutdown));
  thread_.join();
  inbox_.push(control(1, 2, ControlAction::step));
  inbox_.push(push(1, 3));
  loop_->refuse_rest();
  EXPECT_EQ(reply_to(1, 2).code, ResultCode::operation_failed);
  EXPECT_EQ(reply_to(1, 3).code, ResultCode::operation_failed);
}

}  // namespace
}  // namespace poinsot
