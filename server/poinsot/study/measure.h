// Measure: one setting against the reference, and what it costs.

#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <stop_token>

#include "poinsot/protocol/frame_report.h"
#include "poinsot/study/reference.h"

namespace poinsot {

// When a run must have ended.
struct RunLimit {
  std::chrono::steady_clock::time_point deadline;
  std::stop_token stop;
};

struct Measurement {
  Row row;                       // without the median of several runs
  std::uint64_t state_hash = 0;  // at the horizon
};

// Runs the setting once, up to the horizon. Nothing if the limit comes first, or is bound to.
std::optional<Measurement> measure(const Scene& scene, const Setting& setting,
                                   const Reference& reference, const RunLimit& limit);

// Runs the setting again, without a look at the states, until enough time is measured or the limit
// comes. Sets the row's cost and number of runs.
void measure_cost(Row& row, const Scene& scene, std::uint64_t frames, const RunLimit& limit);

// What reading the clock adds to one measurement of the layers [s of CPU]: a system call, as dear
// as the frame of a body that flies.
double clock_cost();

// The layers' CPU time per simulated second, less `clock` for each frame.
Cost cost_of(const LayerTimes& times, double simulated, std::uint64_t frames, double clock);

// The one in the middle by simulation: the dearer of the two if their number is even. Not empty.
Cost median(std::span<Cost> costs);

}  // namespace poinsot
