// The counts of FrameReport::methods in words: "flight 998, taylor 2".

#pragma once

#include <string>

#include "poinsot/protocol/frame_report.h"

namespace poinsot {

// Those that moved a body, in the order of kMethodNames; empty if there are none.
inline std::string methods_text(const FrameReport& report) {
  std::string text;
  for (const Named<Method>& row : kMethodNames) {
    const std::uint32_t bodies = report.methods[static_cast<std::size_t>(row.value)];
    if (bodies == 0 || row.value == Method::none) continue;
    text.append(text.empty() ? "" : ", ")
        .append(row.name)
        .append(" ")
        .append(std::to_string(bodies));
  }
  return text;
}

}  // namespace poinsot
