// poinsot pause, resume, step, reset: the run as a whole.

#pragma once

#include "poinsot/cli/context.h"

namespace poinsot {

Action declare_pause(CLI::App& app);
Action declare_resume(CLI::App& app);
Action declare_step(CLI::App& app);
Action declare_reset(CLI::App& app);

}  // namespace poinsot
