// `poinsotd study SCENE`: its options, and what it does with them.

#pragma once

#include <chrono>
#include <cstdint>
#include <iosfwd>
#include <string>

#include "poinsot/program/options.h"
#include "poinsot/program/signals.h"
#include "poinsot/scene/scene.h"

namespace poinsot {

struct StudyOptions {
  std::uint64_t frames = 0;  // 0: by the time
  std::chrono::nanoseconds time{std::chrono::seconds(10)};
  std::chrono::nanoseconds budget{std::chrono::seconds(30)};
  double error = 0;  // 0: none is wanted
  std::string csv;
  std::string svg;
  bool json = false;
};

void add_study_options(CLI::App& app, StudyOptions& options);

// Studies the scene until done or a stop signal, writes the result to `out` and to the files asked
// for. Throws Error for bad input (nothing moves, a file that cannot be created, no gnuplot),
// std::runtime_error if no reference exists.
void run_study(const Scene& scene, const StudyOptions& options, StopSignals& signals,
               std::ostream& out);

}  // namespace poinsot
