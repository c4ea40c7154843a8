// Is a command or a control possible at all? What can be said from its fields alone, without a
// world.

#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "poinsot/presentation/value_check.h"
#include "poinsot/protocol/run_control.h"
#include "poinsot/protocol/wrench_command.h"

namespace poinsot {

// The last frame that a command may name: beyond it a frame's number is no longer exact in double.
inline constexpr std::uint64_t kMaxFrame = std::uint64_t{1} << 53;

// The first fault of identity, enumerators, numbers or times; nothing if there is none.
std::optional<Refusal> check_values(const WrenchCommand& command);

// A control that was meant for another run than the one of `epoch`.
std::optional<Refusal> check_epoch(std::uint32_t meant, std::uint32_t epoch);

// The scope of a reset.
std::optional<Refusal> check_scope(const RunControl& control);

// What a set_state sets. Its quaternion may be off by what rounding to float does.
std::optional<Refusal> check_state(const RunControl& control);
inline constexpr double kUnitSlack = 1e-6;  // [-] of the norm of an orientation

// The name under which a client may save.
std::optional<Refusal> check_store_name(std::string_view name);

}  // namespace poinsot
