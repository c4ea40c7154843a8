#include "poinsot/runner/run_offline.h"

#include <optional>
#include <utility>

#include "poinsot/runner/trajectory.h"

namespace poinsot {

RunSummary run_offline(Scene scene, const OfflineOptions& options, std::stop_token stop) {
  PresentationLayer layer(std::move(scene));
  std::optional<Trajectory> trajectory;
  if (!options.trajectory.empty()) {
    trajectory.emplace(options.trajectory, layer.world(), layer.frame_rate());
    trajectory->write(layer.world(), 0);
  }

  Elapsed elapsed;
  {
    const Stopwatch::Lap lap(elapsed);
    while (!stop.stop_requested() && (options.frames == 0 || layer.frame() < options.frames)) {
      layer.advance_frame();
      if (trajectory) trajectory->write(layer.world(), layer.frame());
    }
  }
  if (trajectory) trajectory->close();
  return summarize(layer, layer.frame(), elapsed.wall_s, {});
}

}  // namespace poinsot
