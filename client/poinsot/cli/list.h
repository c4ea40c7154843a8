// poinsot list: the daemons on the domain and their bodies.

#pragma once

#include "poinsot/cli/context.h"

namespace poinsot {

Action declare_list(CLI::App& app);

}  // namespace poinsot
