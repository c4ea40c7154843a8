// The loop's view of the store: what its disk worker does, and the logs.

#pragma once

#include <optional>
#include <string>

#include "poinsot/program/log.h"
#include "poinsot/runner/store.h"
#include "poinsot/service/daemon_options.h"
#include "poinsot/service/frame_loop.h"

namespace poinsot {

// The one that the options name. None: they name none and ask for none, and the environment has no
// place either. Throws Error if they ask for one.
std::optional<Store> open_store(const DaemonOptions& options, const std::string& world);

// `store` outlives what is returned.
RunStore run_store(const Store& store, const std::string& world, Logger logger);

// The checkpoint that the options begin with, if they do. Throws Error if it is not there or cannot
// be read; of the latest that cannot be read a line is logged.
std::shared_ptr<const Checkpoint> first_checkpoint(const DaemonOptions& options, const Store& store,
                                                   const Logger& logger);

}  // namespace poinsot
