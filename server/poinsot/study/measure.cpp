#include "poinsot/study/measure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "poinsot/presentation/presentation_layer.h"
#include "poinsot/study/methods_used.h"
#include "poinsot/study/settings.h"

namespace poinsot {
namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

constexpr double kEnough = 0.1;         // [s] of measured wall time
constexpr std::size_t kFewestRuns = 3;  // of which a median is worth its name
constexpr double kSettled = 0.02;       // [s] before a forecast is made
constexpr double kForecastSlack = 2;    // [-] the rest of a run may be cheaper than its start

// Ends runs that are late, and those that would be.
class Patience {
 public:
  explicit Patience(const RunLimit& limit) : limit_(limit) {}

  bool ends(std::uint64_t frame, std::uint64_t frames) const {
    if (limit_.stop.stop_requested()) return true;
    const Clock::time_point now = Clock::now();
    if (now > limit_.deadline) return true;
    const double elapsed = Seconds(now - start_).count();
    if (elapsed < kSettled || frame == 0) return false;
    const double rest = elapsed * static_cast<double>(frames - frame) / static_cast<double>(frame);
    return rest > kForecastSlack * Seconds(limit_.deadline - now).count();
  }

 private:
  const RunLimit& limit_;
  Clock::time_point start_ = Clock::now();
};

Cost cost_of(const PresentationLayer& layer, double clock) {
  return cost_of(layer.times(), layer.time(), layer.frame(), clock);
}

// A number that is none is as bad as can be.
double magnitude(double x) {
  return std::isnan(x) ? INFINITY : std::abs(x);
}

}  // namespace

std::optional<Measurement> measure(const Scene& scene, const Setting& setting,
                                   const Reference& reference, const RunLimit& limit) {
  const Patience patience(limit);
  PresentationLayer layer(with(scene, setting));
  MethodsUsed used;
  Measurement result;
  Row& row = result.row;
  row.setting = setting;
  while (layer.frame() < reference.frames) {
    if (patience.ends(layer.frame(), reference.frames)) return std::nullopt;
    layer.advance_frame();
    const FrameReport& report = layer.report();
    used.see(report);
    row.energy_error = std::max(row.energy_error, magnitude(report.energy_error));
    row.momentum_error = std::max(row.momentum_error, magnitude(report.momentum_error));
    if (layer.frame() % reference.stride != 0 && layer.frame() != reference.frames) continue;
    const std::uint64_t kept = (layer.frame() + reference.stride - 1) / reference.stride;
    row.measured = largest(row.measured, reference.path.distance(kept, layer.snapshot()));
  }
  row.methods = used.list();
  row.quarantined = layer.report().quarantined;
  row.cost = cost_of(layer, clock_cost());
  row.runs = 1;
  result.state_hash = layer.snapshot().state_hash;
  return result;
}

void measure_cost(Row& row, const Scene& scene, std::uint64_t frames, const RunLimit& limit) {
  const Scene changed = with(scene, row.setting);
  std::vector<Cost> costs;
  double measured = 0;  // [s]
  while (measured < kEnough || costs.size() < kFewestRuns) {
    const Patience patience(limit);
    const double clock = clock_cost();
    const Clock::time_point start = Clock::now();
    PresentationLayer layer(changed);
    while (layer.frame() < frames) {
      if (patience.ends(layer.frame(), frames)) break;
      layer.advance_frame();
    }
    if (layer.frame() < frames) break;
    costs.push_back(cost_of(layer, clock));
    measured += Seconds(Clock::now() - start).count();
  }
  if (costs.empty()) return;
  row.cost = median(costs);
  row.runs = static_cast<std::uint32_t>(costs.size());
}

double clock_cost() {
  std::array<double, 65> readings;
  for (double& reading : readings) {
    Elapsed empty;
    { const Stopwatch::Lap lap(empty); }
    reading = empty.cpu_s;
  }
  const auto middle = readings.begin() + readings.size() / 2;
  std::nth_element(readings.begin(), middle, readings.end());
  return *middle;
}

// The layers share a frame's CPU time, and so the clock's, as they shared its wall time.
Cost cost_of(const LayerTimes& times, double simulated, std::uint64_t frames, double clock) {
  const double measured = times.simulation.cpu_s + times.collision.cpu_s + times.contact.cpu_s;
  if (measured <= 0) return {};
  const double own = std::max(0.0, measured - static_cast<double>(frames) * clock);
  const double scale = own / measured / simulated;
  return {scale * times.simulation.cpu_s, scale * times.collision.cpu_s,
          scale * times.contact.cpu_s};
}

Cost median(std::span<Cost> costs) {
  const auto middle = costs.begin() + static_cast<std::ptrdiff_t>(costs.size() / 2);
  std::nth_element(costs.begin(), middle, costs.end(),
                   [](const Cost& a, const Cost& b) { return a.simulation < b.simulation; });
  return *middle;
}

}  // namespace poinsot
