// Result codes of replies. The first five are those of ROS 2 simulation_interfaces (Result.msg);
// codes above 100 are ours.

#pragma once

#include <array>
#include <cstdint>

#include "poinsot/base/names.h"

namespace poinsot {

enum class ResultCode : std::uint8_t {
  feature_unsupported = 0,
  ok = 1,
  not_found = 2,
  incorrect_state = 3,
  operation_failed = 4,
  invalid_value = 101,   // non-finite, out of range, or an impossible combination
  inbox_full = 102,      // nothing was taken; send again later
  wrong_epoch = 103,     // meant for a run before the last reset
  too_late = 104,        // start_frame has passed
  rate_limited = 105,    // more commands than a client may send: send again later
  quota_exceeded = 106,  // the client holds as much as it may: clear some
  name_taken = 107,      // a body or checkpoint of this name is there already
};

inline constexpr std::array<Named<ResultCode>, 12> kResultCodeNames = {{
    {"FEATURE_UNSUPPORTED", ResultCode::feature_unsupported},
    {"OK", ResultCode::ok},
    {"NOT_FOUND", ResultCode::not_found},
    {"INCORRECT_STATE", ResultCode::incorrect_state},
    {"OPERATION_FAILED", ResultCode::operation_failed},
    {"INVALID_VALUE", ResultCode::invalid_value},
    {"INBOX_FULL", ResultCode::inbox_full},
    {"WRONG_EPOCH", ResultCode::wrong_epoch},
    {"TOO_LATE", ResultCode::too_late},
    {"RATE_LIMITED", ResultCode::rate_limited},
    {"QUOTA_EXCEEDED", ResultCode::quota_exceeded},
    {"NAME_TAKEN", ResultCode::name_taken},
}};

}  // namespace poinsot
