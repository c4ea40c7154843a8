// Pushes and controls as JSON objects, for the command log: every member that differs from a fresh
// one, under its own name; numbers read back to the same bits, not-a-number included. Enumerations
// are words. Private to this module.

#pragma once

#include <nlohmann/json.hpp>

#include "poinsot/protocol/run_control.h"
#include "poinsot/protocol/wrench_command.h"

namespace poinsot {

nlohmann::ordered_json to_json(const WrenchCommand& command);
nlohmann::ordered_json to_json(const RunControl& control);

// These throw Error that says what is wrong: another type, a number that does not fit, a key or a
// word that is not known.
WrenchCommand wrench_from(const nlohmann::ordered_json& json);
RunControl control_from(const nlohmann::ordered_json& json);

}  // namespace poinsot
