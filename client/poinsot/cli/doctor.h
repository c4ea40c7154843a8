// poinsot doctor: what keeps programs from meeting on the bus. A line per finding: ok, warn or
// fail, and what to do.

#pragma once

#include "poinsot/cli/context.h"

namespace poinsot {

Action declare_doctor(CLI::App& app);

}  // namespace poinsot
