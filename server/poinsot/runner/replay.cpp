#include "poinsot/runner/replay.h"

#include <cstdio>
#include <utility>

#include <nlohmann/json.hpp>

#include "poinsot/base/error.h"
#include "poinsot/base/stopwatch.h"
#include "poinsot/runner/hash_text.h"
#include "poinsot/runner/trajectory.h"

namespace poinsot {
namespace {

std::uint32_t later(std::uint32_t epoch, std::uint32_t epochs_later) {
  return epoch == 0 ? 0 : epoch + epochs_later;  // 0: whichever runs
}

}  // namespace

std::optional<FrameRecord> LogPlayer::advance() {
  while (std::optional<LogEntry> entry = log_.next()) {
    if (const auto* frame = std::get_if<FrameRecord>(&*entry)) {
      layer_.advance_frame();
      return *frame;
    }
    play(std::move(std::get<TurnRecord>(*entry)));
  }
  return std::nullopt;
}

void LogPlayer::play(TurnRecord turn) {
  turn.before = layer_.frame() + 1;
  turn.epoch = layer_.epoch();
  for (WrenchCommand& wrench : turn.wrenches) wrench.epoch = later(wrench.epoch, epochs_later_);
  for (Order& order : turn.orders) {
    order.control.epoch = later(order.control.epoch, epochs_later_);
    if (order.checkpoint) order.checkpoint = with_threads(order.checkpoint, threads_);
  }
  replies_.clear();
  apply_turn(turn, layer_, replies_);
  commands_ += replies_.size();
  for (const Reply& reply : replies_) refused_ += reply.code != ResultCode::ok ? 1 : 0;
  if (record_) record_->turn(std::move(turn));
}

ReplayResult replay(const std::filesystem::path& file, const ReplayOptions& options,
                    std::stop_token stop) {
  CommandLogReader log(file);
  const auto start = with_threads(log.start(), options.threads);
  PresentationLayer layer(*start->scene);
  layer.restore(*start);
  std::optional<Trajectory> trajectory;
  if (!options.trajectory.empty()) {
    trajectory.emplace(options.trajectory, layer.world(), layer.frame_rate());
    trajectory->write(layer.world(), layer.frame());
  }

  ReplayResult result;
  LogPlayer player(log, layer, options.threads);
  Elapsed elapsed;
  {
    const Stopwatch::Lap lap(elapsed);
    while (!(result.stopped = stop.stop_requested())) {
      const std::optional<FrameRecord> recorded = player.advance();
      if (!recorded) break;
      ++result.frames;
      if (trajectory) trajectory->write(layer.world(), layer.frame());
      const FrameRecord found{layer.frame(), layer.snapshot().state_hash};
      if (found.frame == recorded->frame && found.hash == recorded->hash) continue;
      result.difference = {*recorded, found, log.where()};
      break;
    }
  }
  if (trajectory) trajectory->close();
  result.commands = player.commands();
  result.refused = player.refused();
  result.cut = log.is_cut();
  result.sim_time = static_cast<double>(result.frames) / layer.frame_rate();
  result.wall_s = elapsed.wall_s;
  return result;
}

std::string to_text(const ReplayResult& r) {
  std::string text;
  if (r.difference) {
    const auto& [recorded, found, where] = *r.difference;
    text = "frame " + std::to_string(recorded.frame) + " differs (" + where + "): recorded " +
           hash_text(recorded.hash) + ", found " + hash_text(found.hash);
    if (found.frame != recorded.frame) text += " at frame " + std::to_string(found.frame);
    text += "; the " + std::to_string(r.frames - 1) + " frames before it are the same\n";
  } else {
    text = (r.stopped ? "stopped: " : "") + std::string("all ") + std::to_string(r.frames) +
           " frames have the recorded hash\n";
  }
  if (r.cut) text += "the log was cut: it has no end\n";
  char line[160];
  std::snprintf(
      line, sizeof line, "commands %llu, refused %llu; %.6g s in %.6g s (%.4g frames/s)\n",
      static_cast<unsigned long long>(r.commands), static_cast<unsigned long long>(r.refused),
      r.sim_time, r.wall_s, r.wall_s > 0 ? static_cast<double>(r.frames) / r.wall_s : 0.0);
  return text + line;
}

std::string to_json(const ReplayResult& r) {
  nlohmann::ordered_json json = {{"frames", r.frames},     {"commands", r.commands},
                                 {"refused", r.refused},   {"same", !r.difference},
                                 {"cut", r.cut},           {"stopped", r.stopped},
                                 {"sim_time", r.sim_time}, {"wall_s", r.wall_s}};
  if (r.difference)
    json["first_difference"] = {{"frame", r.difference->recorded.frame},
                                {"recorded", hash_text(r.difference->recorded.hash)},
                                {"found", hash_text(r.difference->found.hash)},
                                {"where", r.difference->where}};
  return json.dump() + '\n';
}

}  // namespace poinsot
