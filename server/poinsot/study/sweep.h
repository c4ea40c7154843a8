// Sweep: the whole study of a scene. Reference first, then every setting up to its horizon, then
// the impact searches, in equal shares of the time budget.

#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <stop_token>
#include <string>

#include "poinsot/study/study.h"

namespace poinsot {

struct SweepOptions {
  std::uint64_t frames = 600;
  std::chrono::duration<double> budget{30};
  double wanted_error = 0;  // [m], [rad] 0: none
};

// How far the study is, 0 … 1, and what it does.
using ShowProgress = std::function<void(double, const std::string&)>;

// Throws Error if nothing in the scene moves.
StudyResult sweep(const Scene& scene, const SweepOptions& options, const ShowProgress& show,
                  std::stop_token stop);

// Of settings with the same states, the one that speaks for all: the default, the scene's own, the
// finer.
bool speaks_for(const Setting& a, const Setting& b);

}  // namespace poinsot
