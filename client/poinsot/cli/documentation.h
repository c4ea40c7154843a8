// What the tool says of itself: completion, man.

#pragma once

#include "poinsot/cli/context.h"

namespace poinsot {

Action declare_completion(CLI::App& app);
Action declare_man(CLI::App& app);

}  // namespace poinsot
