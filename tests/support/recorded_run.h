// A run whose commands and hashes are recorded in a log, for tests of the log and its replay.

#pragma once

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "poinsot/runner/command_log.h"
#include "poinsot/runner/replay.h"
#include "poinsot/scene/fragment.h"
#include "support/scene_builder.h"

namespace poinsot::test {

// What a frame loop does, without pace.
class RecordedRun {
 public:
  explicit RecordedRun(Scene scene) : layer_(std::move(scene)) {}

  PresentationLayer& layer() { return layer_; }

  void record(const std::filesystem::path& file) {
    log_.emplace(
        LogStart{.file = file, .world = "arena", .checkpoint = layer_.make_checkpoint("")});
  }
  bool stop_recording() { return log_->close(); }

  void tell(WrenchCommand wrench) {
    wrench.seq = ++seq_;
    wrenches_.push_back(std::move(wrench));
  }
  void tell(Order order) {
    order.control.seq = ++seq_;
    if (order.control.action == ControlAction::spawn && !order.fragment)
      order.fragment =
          std::make_shared<const std::vector<BodyDef>>(parse_fragment(order.control.text));
    orders_.push_back(std::move(order));
  }
  // A turn of the loop; the replies to what was told before it.
  const std::vector<Reply>& turn() {
    replies_.clear();
    if (wrenches_.empty() && orders_.empty()) return replies_;
    TurnRecord turn{layer_.frame() + 1, layer_.epoch(), {}, {}};
    std::swap(turn.wrenches, wrenches_);
    std::swap(turn.orders, orders_);
    const auto by_key = [](const auto& a, const auto& b) { return a.client < b.client; };
    std::ranges::stable_sort(turn.wrenches, by_key);  // seq grows already
    std::ranges::stable_sort(turn.orders, by_key, &Order::control);
    apply_turn(turn, layer_, replies_);
    if (log_) log_->turn(std::move(turn));
    return replies_;
  }
  void frames(int count = 1) {
    for (int n = 0; n < count; ++n) {
      turn();
      layer_.advance_frame();
      if (log_) log_->frame(layer_.frame(), layer_.snapshot().state_hash);
    }
  }

 private:
  PresentationLayer layer_;
  std::optional<CommandLogWriter> log_;
  std::uint64_t seq_ = 0;
  std::vector<WrenchCommand> wrenches_;
  std::vector<Order> orders_;
  std::vector<Reply> replies_;
};

inline Order order(ControlAction action, std::string name = {}) {
  Order result;
  result.control.client = 1;
  result.control.action = action;
  result.control.name = std::move(name);
  return result;
}

inline Order spawn(const std::string& text) {
  Order result = order(ControlAction::spawn);
  result.control.text = text;
  return result;
}

inline Order remove(const std::string& body) {
  Order result = order(ControlAction::remove);
  result.control.body_name = body;
  return result;
}

inline WrenchCommand push(const std::string& body, const Vec3& force,
                          Hold hold = Hold::until_cleared) {
  return {.client = 1, .body_name = body, .force = force, .hold = hold};
}

inline Scene boxes() {
  Scene scene = test::scene({ground(0.5, 0.2)});
  for (int k = 0; k < 4; ++k)
    scene.bodies.push_back(box("box" + std::to_string(k), Vec3(1.5 * k, 0, 0.7 + 0.2 * k)));
  return scene;
}

inline ReplayResult replayed(const std::filesystem::path& file, const ReplayOptions& options = {}) {
  return replay(file, options, {});
}

}  // namespace poinsot::test
