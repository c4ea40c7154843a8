// Checkpoints: save, restore.

#pragma once

#include "poinsot/cli/context.h"

namespace poinsot {

Action declare_save(CLI::App& app);
Action declare_restore(CLI::App& app);

}  // namespace poinsot
