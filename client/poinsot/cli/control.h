// The run as a whole: pause, resume, step, until, scale, reset, shutdown.

#pragma once

#include <chrono>

#include "poinsot/cli/context.h"
#include "poinsot/protocol/run_control.h"

namespace poinsot {

struct ControlOptions {
  RunControl control;
  std::chrono::nanoseconds time{0};  // of until
  bool json = false;
};

void add_scale_options(CLI::App& app, ControlOptions& options);
void add_reset_options(CLI::App& app, ControlOptions& options);

Action declare_pause(CLI::App& app);
Action declare_resume(CLI::App& app);
Action declare_step(CLI::App& app);
Action declare_until(CLI::App& app);
Action declare_scale(CLI::App& app);
Action declare_reset(CLI::App& app);
Action declare_shutdown(CLI::App& app);

}  // namespace poinsot
