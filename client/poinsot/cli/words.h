// Small texts that several outputs share.

#pragma once

#include <string>

#include <spdlog/fmt/fmt.h>

#include "poinsot/math/types.h"

namespace poinsot {

// "(0, 0, 50)"; zero has no sign.
inline std::string vector_text(const Vec3& v) {
  return fmt::format("({:g}, {:g}, {:g})", v.x() + 0.0, v.y() + 0.0, v.z() + 0.0);
}

}  // namespace poinsot
