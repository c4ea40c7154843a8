// poinsot status: how the run goes.

#pragma once

#include "poinsot/cli/context.h"

namespace poinsot {

Action declare_status(CLI::App& app);

}  // namespace poinsot
