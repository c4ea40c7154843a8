#include "poinsot/service/daemon.h"

#include <algorithm>
#include <random>
#include <utility>

#include "poinsot/service/run_store.h"

namespace poinsot {
namespace {

std::uint64_t random_session() {
  std::random_device random;
  const std::uint64_t high = random();
  return (high << 32 | random()) | 1;  // never 0
}

// Segments of dead processes go before the bus is joined, so that restarts do not pile them up.
BusOptions prepare_bus(const DaemonOptions& options, std::size_t bodies, const Logger& logger) {
  if (const int removed = remove_stale_segments(); removed > 0)
    logger->info("stale_segments_removed files={}", removed);
  return {.domain = options.domain,
          .lan = options.lan,
          .bodies = bodies,
          .commands_only = true,
          .partition = options.partition,
          .discovery_server = options.discovery_server};
}

}  // namespace

Daemon::Daemon(Scene scene, const DaemonOptions& options, Logger logger,
               std::function<void()> ended, const std::function<void(const Daemon&)>& before_start)
    : logger_(std::move(logger)),
      world_(options.world.empty() ? scene.world : options.world),
      session_(random_session()),
      store_(open_store(options, world_)),
      layer_(first_state(std::move(scene), options)),
      outbox_(layer_.snapshot().bodies.size(), [this] { inbox_.nudge(); }),
      clients_(options.limits),
      loop_(layer_, inbox_, outbox_, clients_, disk_, loop_options(options)),
      participant_(prepare_bus(options, layer_.snapshot().bodies.size(), logger_)),
      publisher_(participant_, world_, outbox_, session_, logger_),
      receiver_(
          participant_, world_, inbox_, outbox_, clients_, [this] { return loop_.epoch(); },
          logger_) {
  logger_->info("started world={} session={:016x} domain={} reach={} bodies={}",
                poinsot::quoted(world_), session_, options.domain, options.lan ? "lan" : "local",
                layer_.scene().bodies.size());
  if (before_start) before_start(*this);
  if (!options.trajectory.empty())
    trajectory_.emplace(options.trajectory, layer_.world(), layer_.frame_rate());
  loop_thread_ = std::jthread([this, ended = std::move(ended)](const std::stop_token& stop) {
    {
      const Stopwatch::Lap lap(elapsed_);
      loop_.run(stop);
    }
    ended();
  });
}

Daemon::~Daemon() {
  join_threads();
}

PresentationLayer Daemon::first_state(Scene scene, const DaemonOptions& options) const {
  const int threads = scene.collision.threads;  // of this run, whatever the checkpoint's had
  PresentationLayer layer(std::move(scene));
  if (!store_) return layer;
  if (const auto checkpoint = first_checkpoint(options, *store_, logger_)) {
    layer.restore(*with_threads(checkpoint, threads));
    logger_->info("restored name={} frame={} hash={:016x}", poinsot::quoted(checkpoint->name),
                  checkpoint->frame, checkpoint->state_hash);
  }
  return layer;
}

bool Daemon::is_taken() const {
  const std::vector<std::string> worlds = participant_.worlds();
  return std::binary_search(worlds.begin(), worlds.end(), world_);
}

FrameLoopOptions Daemon::loop_options(const DaemonOptions& options) {
  return {.scale = options.scale,
          .paused = options.paused,
          .frames = options.frames,
          .record = options.record,
          .autosave_ns = options.autosave.count(),
          .store = store_ ? run_store(*store_, world_, logger_) : RunStore{},
          .each_frame = [this](const PresentationLayer& layer) {
            if (trajectory_) trajectory_->write(layer.world(), layer.frame());
          }};
}

RunSummary Daemon::stop() {
  join_threads();
  if (trajectory_) trajectory_->close();
  return summarize(layer_, loop_.frames(), elapsed_.wall_s, publisher_.elapsed());
}

void Daemon::join_threads() {
  loop_thread_.request_stop();
  if (loop_thread_.joinable()) loop_thread_.join();
  receiver_.stop();
  loop_.refuse_rest();  // what came while the loop ended
  publisher_.stop();
}

}  // namespace poinsot
