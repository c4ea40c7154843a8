// JSON of one line, in the order in which it is written; zero has no sign.

#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "poinsot/math/types.h"

namespace poinsot {

using Json = nlohmann::ordered_json;

inline std::string json_line(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

inline Json vector_json(const Vec3& v) {
  return {v.x() + 0.0, v.y() + 0.0, v.z() + 0.0};  // −0 + 0 = 0
}

}  // namespace poinsot
