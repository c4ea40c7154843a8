// What a client asks of the loop that has to do with the disk.

#include <filesystem>
#include <future>

#include "poinsot/runner/replay.h"
#include "poinsot/service/run_store.h"
#include "support/temp_path.h"
#include "unit/service/loop_fixture.h"

namespace poinsot {
namespace {

using namespace std::chrono_literals;
using test::control;
using test::push;

class FrameLoopDisk : public test::FrameLoopTest {
 protected:
  // A store of its own for each test.
  FrameLoopOptions on_disk(FrameLoopOptions options) {
    options.store = run_store(store_, "test", logger_);
    return options;
  }
  static RunControl named(std::uint64_t client, std::uint64_t seq, ControlAction action,
                          const std::string& name) {
    RunControl result = control(client, seq, action);
    result.name = name;
    return result;
  }
  static RunControl save(std::uint64_t client, std::uint64_t seq, const std::string& name) {
    RunControl result = named(client, seq, ControlAction::save, name);
    result.on_disk = true;
    return result;
  }
  void begin_again() {
    end();
    layer_ = PresentationLayer(test::falling_box());
  }

  const test::TempDirectory directory_;
  const Store store_{directory_.path(), "test"};
  const Logger logger_ = make_logger("test", spdlog::level::off, 0);
};

TEST_F(FrameLoopDisk, ASaveOnDiskIsAnsweredWhenItIsThere) {
  start(on_disk({.paused = true}));
  ask(control(1, 1, ControlAction::step, 20));
  const Reply reply = ask(save(1, 2, "here"));
  EXPECT_EQ(reply.code, ResultCode::ok) << reply.message;
  const auto checkpoint = store_.load("here");
  EXPECT_EQ(checkpoint->frame, 20u);
  EXPECT_EQ(checkpoint->state_hash, reply.state_hash);
}

TEST_F(FrameLoopDisk, ASaveSentAgainWhileTheDiskIsSlowIsAnsweredOnce) {
  std::promise<void> disk;
  FrameLoopOptions options = on_disk({.paused = true});
  options.store.write = [&](const Checkpoint&) { disk.get_future().wait(); };
  start(std::move(options));
  inbox_.push(save(1, 1, "slow"));
  for (int n = 0; n < 3; ++n) {
    EXPECT_EQ(ask(control(2, 1 + static_cast<std::uint64_t>(n), ControlAction::step)).code,
              ResultCode::ok);  // nobody waits for it
    inbox_.push(save(1, 1, "slow"));
  }
  ask(control(2, 8, ControlAction::step));  // the last one has been taken: the disk is still slow
  disk.set_value();
  EXPECT_EQ(reply_to(1, 1).code, ResultCode::ok);
  ask(control(2, 9, ControlAction::pause));
  EXPECT_EQ(replies_to_.at({1, 1}), 1);
}

TEST_F(FrameLoopDisk, ADiskThatFailsIsTheReplysReasonAndTheRunGoesOn) {
  FrameLoopOptions options = on_disk({.paused = true});
  options.store.write = [](const Checkpoint&) { throw std::runtime_error("the disk is full"); };
  start(std::move(options));
  const Reply reply = ask(save(1, 1, "full"));
  EXPECT_EQ(reply.code, ResultCode::operation_failed);
  EXPECT_EQ(reply.message, "the disk is full");
  EXPECT_EQ(ask(control(1, 2, ControlAction::step)).code, ResultCode::ok);
}

TEST_F(FrameLoopDisk, WhatIsNotInMemoryIsRestoredFromDisk) {
  start(on_disk({.paused = true}));
  ask(push(1, 1));
  ask(control(1, 2, ControlAction::step, 20));
  ask(save(1, 3, "here"));
  const std::uint64_t onward = ask(control(1, 4, ControlAction::step, 30)).state_hash;
  begin_again();
  start(on_disk({.paused = true}));
  const Reply reply = ask(named(2, 1, ControlAction::restore, "here"));
  EXPECT_EQ(reply.code, ResultCode::ok) << reply.message;
  EXPECT_EQ(reply.last_frame, 20u);
  EXPECT_EQ(reply.epoch, loop_->epoch());
  EXPECT_EQ(ask(control(2, 2, ControlAction::step, 30)).state_hash, onward);
}

TEST_F(FrameLoopDisk, ACheckpointThatIsNowhereFailsAndTheStepUnderWayGoesOn) {
  start(on_disk({.paused = true}));
  inbox_.push(control(1, 1, ControlAction::step, kMaxStepFrames));
  const Reply reply = ask(named(2, 1, ControlAction::restore, "nowhere"));
  EXPECT_EQ(reply.code, ResultCode::operation_failed);
  EXPECT_NE(reply.message.find("nowhere"), std::string::npos) << reply.message;
  EXPECT_EQ(ask(control(2, 2, ControlAction::step)).code, ResultCode::incorrect_state);
}

TEST_F(FrameLoopDisk, ALogOfARunReproducesEveryHash) {
  start(on_disk({.scale = 0, .paused = true}));
  ask(control(1, 1, ControlAction::step, 5));
  EXPECT_EQ(ask(named(1, 2, ControlAction::record, "log")).code, ResultCode::ok);
  EXPECT_EQ(outbox_.newest_report().recording, "log");
  ask(push(1, 3));
  ask(control(1, 4, ControlAction::step, 10));
  RunControl saved = named(1, 5, ControlAction::save, "mark");
  ask(saved);
  ask(push(2, 1, Vec3(0, 30, 0)));
  ask(control(1, 6, ControlAction::step, 10));
  ask(named(1, 7, ControlAction::restore, "mark"));  // from memory
  ask(control(1, 8, ControlAction::step, 10));
  inbox_.push_own(Order{.control = control(1, kOwnSeq, ControlAction::release)});
  ask(control(3, 1, ControlAction::step, 10));
  ask(control(3, 2, ControlAction::reset));
  ask(control(3, 3, ControlAction::step, 10));
  const Reply done = ask(named(1, 9, ControlAction::record, ""));
  EXPECT_EQ(done.code, ResultCode::ok) << done.message;
  EXPECT_EQ(outbox_.newest_report().recording, "");
  const ReplayResult result = replay(store_.log_file("log"), {}, {});
  EXPECT_FALSE(result.difference);
  EXPECT_EQ(result.frames, 50u);
}

TEST_F(FrameLoopDisk, ALogThatIsThereIsNotWrittenOver) {
  start(on_disk({.paused = true}));
  ask(named(1, 1, ControlAction::record, "log"));
  EXPECT_EQ(ask(named(1, 2, ControlAction::record, "other")).code, ResultCode::incorrect_state);
  ask(named(1, 3, ControlAction::record, ""));
  const Reply again = ask(named(1, 4, ControlAction::record, "log"));
  EXPECT_EQ(again.code, ResultCode::operation_failed);
  EXPECT_NE(again.message, "");
  EXPECT_EQ(ask(named(1, 5, ControlAction::record, "../log")).code, ResultCode::invalid_value);
  EXPECT_EQ(ask(control(1, 6, ControlAction::step)).code, ResultCode::ok);
}

TEST_F(FrameLoopDisk, ARunThatEndsClosesItsLog) {
  start(on_disk({.scale = 0, .frames = 100, .record = "log"}));
  thread_.join();
  const ReplayResult result = replay(store_.log_file("log"), {}, {});
  EXPECT_FALSE(result.difference);
  EXPECT_EQ(result.frames, 100u);
}

TEST_F(FrameLoopDisk, AutosavesAreMadeAtTheStartAndAsOftenAsSaidAndThreeAreKept) {
  start(on_disk({.autosave_ns = 20'000'000}));
  std::this_thread::sleep_for(300ms);
  ask(control(1, 1, ControlAction::pause));
  end();
  const auto files = store_.checkpoints();
  ASSERT_EQ(files.size(), 3u);
  for (const StoredFile& file : files) EXPECT_TRUE(file.name.starts_with("auto-")) << file.name;
  EXPECT_GT(store_.load(files[0].name)->frame, store_.load(files[2].name)->frame);
}

TEST_F(FrameLoopDisk, APausedRunIsSavedOnceWhenItHasChanged) {
  int saves = 0;
  FrameLoopOptions options = on_disk({.paused = true, .autosave_ns = 20'000'000});
  options.store.autosave = [&](const Checkpoint&) { ++saves; };
  start(std::move(options));
  std::this_thread::sleep_for(100ms);
  EXPECT_EQ(ask(push(1, 1)).code, ResultCode::ok);  // is held: another state
  std::this_thread::sleep_for(100ms);
  end();
  EXPECT_EQ(saves, 2);
}

TEST_F(FrameLoopDisk, ARecordNameThatIsNoNameDoesNotEndTheRun) {
  start(on_disk({.paused = true, .record = "a/b"}));
  EXPECT_EQ(ask(control(1, 1, ControlAction::step)).code, ResultCode::ok);
  EXPECT_EQ(outbox_.newest_report().recording, "");
  EXPECT_THROW(open_store({.record = "a/b"}, "test"), Error);
}

TEST_F(FrameLoopDisk, AutosavesDoNotPileUpOnASlowDisk) {
  std::promise<void> disk;
  std::atomic<int> saves = 0;
  FrameLoopOptions options = on_disk({.scale = 0, .autosave_ns = 1'000'000});
  options.store.autosave = [&, hangs = disk.get_future().share()](const Checkpoint&) {
    hangs.wait();
    ++saves;
  };
  start(std::move(options));
  std::this_thread::sleep_for(100ms);
  ask(control(1, 1, ControlAction::shutdown));  // none is begun from here on
  disk.set_value();
  end();
  EXPECT_EQ(saves, 1);
}

TEST_F(FrameLoopDisk, ALogIsNeitherBegunNorEndedWhileTheDiskHasNoRoom) {
  start(on_disk({.paused = true}));
  ask(named(1, 1, ControlAction::record, "log"));
  std::promise<void> begun, disk;
  disk_->post([&] {
    begun.set_value();
    disk.get_future().wait();
  });
  begun.get_future().wait();
  while (disk_->has_room()) disk_->post([] {});
  EXPECT_EQ(ask(named(1, 2, ControlAction::record, "")).code, ResultCode::operation_failed);
  EXPECT_EQ(outbox_.newest_report().recording, "log");
  EXPECT_EQ(ask(control(1, 3, ControlAction::step)).code, ResultCode::ok);
  disk.set_value();
}

TEST_F(FrameLoopDisk, ARestoreOfAnotherFrameRateIsPacedByIt) {
  Scene slow = test::falling_box();
  slow.presentation.frame_rate = 20;
  store_.save(*PresentationLayer(slow).make_checkpoint("slow"));
  start(on_disk({.paused = true}));
  ASSERT_EQ(ask(named(1, 1, ControlAction::restore, "slow")).code, ResultCode::ok);
  RunControl until = control(1, 2, ControlAction::run_until);
  until.value = 0.3;
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(ask(until).last_frame, 6u);
  EXPECT_GE(std::chrono::steady_clock::now() - begin, 240ms);  // the first frame is due at once
}

}  // namespace
}  // namespace poinsot
