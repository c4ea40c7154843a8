// A daemon in the foreground: says how to reach it, then how it goes once a second, then what came
// of it.

#pragma once

#include <iosfwd>
#include <string>

#include "poinsot/program/log.h"
#include "poinsot/program/signals.h"
#include "poinsot/protocol/frame_report.h"
#include "poinsot/scene/scene.h"
#include "poinsot/service/daemon_options.h"

namespace poinsot {

// Runs until the last frame or until `signals` ask for the end. With `json` nothing is written to
// `out` but the summary, as one line. Throws Error as Daemon does, and if another daemon serves the
// world already; std::runtime_error if the trajectory could not be written.
void run_daemon(Scene scene, const DaemonOptions& options, bool json, StopSignals& signals,
                const Logger& logger, std::ostream& out);

// The commands to type in another terminal: to watch, and to push a body of this scene upwards with
// one and a half times its weight. Only the first without a body that moves.
std::string invitation(const Scene& scene, const DaemonOptions& options);

// frame, simulated time, real-time factor, bodies, contacts, energy error; and trouble, if any.
std::string status_line(const RunReport& report);

}  // namespace poinsot
