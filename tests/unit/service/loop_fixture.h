// A frame loop on a thread of its own, without a bus: the test stands at both ends.

#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "poinsot/service/frame_loop.h"
#include "support/scene_builder.h"

namespace poinsot::test {

using namespace std::chrono_literals;

inline Scene falling_box() {
  Scene scene = empty_scene();
  scene.simulation.gravity = Vec3(0, 0, -9.81);
  scene.presentation.frame_rate = 100;
  scene.bodies = {floor(), box("box", Vec3(0, 0, 2))};
  return scene;
}

inline WrenchCommand push(std::uint64_t client, std::uint64_t seq,
                          const Vec3& force = Vec3(1, 0, 0)) {
  WrenchCommand command;
  command.client = client;
  command.seq = seq;
  command.body_name = "box";
  command.force = force;
  command.hold = Hold::until_cleared;
  return command;
}

inline RunControl control(std::uint64_t client, std::uint64_t seq, ControlAction action,
                          std::uint64_t frames = 1) {
  return {.client = client, .seq = seq, .epoch = 0, .action = action, .frames = frames};
}

class FrameLoopTest : public testing::Test {
 protected:
  void start(FrameLoopOptions options) {
    disk_ = std::make_unique<DiskWorker>();  // the last one ended with its loop
    loop_ =
        std::make_unique<FrameLoop>(layer_, inbox_, outbox_, clients_, *disk_, std::move(options));
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
  Clients clients_{ClientLimits{}};
  std::unique_ptr<DiskWorker> disk_;
  std::unique_ptr<FrameLoop> loop_;
  std::jthread thread_;
  std::map<std::pair<std::uint64_t, std::uint64_t>, Reply> replies_;
  std::map<std::pair<std::uint64_t, std::uint64_t>, int> replies_to_;
};

inline std::vector<std::uint64_t> hashes_without_commands(int frames) {
  PresentationLayer layer(falling_box());
  std::vector<std::uint64_t> hashes = {layer.snapshot().state_hash};
  for (int n = 0; n < frames; ++n) {
    layer.advance_frame();
    hashes.push_back(layer.snapshot().state_hash);
  }
  return hashes;
}

}  // namespace poinsot::test
