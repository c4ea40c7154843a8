// Is a wrench command possible at all? What can be said from its fields alone, without a world.

#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "poinsot/protocol/result.h"
#include "poinsot/protocol/wrench_command.h"

namespace poinsot {

// Why a command is not taken: the code and the reason in words, with the value received.
struct Refusal {
  ResultCode code = ResultCode::invalid_value;
  std::string reason;
};

// The last frame that a command may name: beyond it a frame's number is no longer exact in double.
inline constexpr std::uint64_t kMaxFrame = std::uint64_t{1} << 53;

// The first fault of identity, enumerators, numbers or times; nothing if there is none.
std::optional<Refusal> check_values(const WrenchCommand& command);

}  // namespace poinsot
