// Which methods moved a body during a run.

#pragma once

#include <array>
#include <vector>

#include "poinsot/protocol/frame_report.h"

namespace poinsot {

class MethodsUsed {
 public:
  void see(const FrameReport& report) {
    for (std::size_t m = 0; m < used_.size(); ++m) used_[m] = used_[m] || report.methods[m] > 0;
  }

  // Bodies that do not move are no common ground.
  bool shares_one_with(const MethodsUsed& other) const {
    for (const Method method : list())
      if (other.used_[static_cast<std::size_t>(method)]) return true;
    return false;
  }

  // Closed form throughout: no steps, and no rounding that adds up over them.
  bool only_flight() const { return list() == std::vector{Method::flight}; }

  std::vector<Method> list() const {  // without Method::none
    std::vector<Method> methods;
    for (const Named<Method>& row : kMethodNames)
      if (row.value != Method::none && used_[static_cast<std::size_t>(row.value)])
        methods.push_back(row.value);
    return methods;
  }

 private:
  std::array<bool, kMethodNames.size()> used_ = {};
};

}  // namespace poinsot
