// The shifts of the de Saxcé passes: which speed of sliding the next pass shall assume.
//
// The plain choice is the speed that the last pass has found, which divides the error by about
// 1 + 1/μ² a pass. Anderson's acceleration takes the combination of the last few passes whose
// errors cancel best instead. Sources: Anderson (1965); Walker, Ni (2011), section 2.

#pragma once

#include <array>
#include <vector>

#include "poinsot/contact/newton_problem.h"

namespace poinsot {

class ShiftAcceleration {
 public:
  void load(std::size_t points);
  // The next choice is the speeds at hand, or nothing at all: as if all points stuck.
  void restart(bool still = false);
  // Sets the shifts of points whose speeds are those of the accepted impulses.
  void choose_shifts(NewtonProblem& problem);

 private:
  static constexpr int kDepth = 5;

  struct Memory {
    std::vector<double> speed, error;  // [m/s] of points: found, and beside what was assumed
  };
  void combine();

  std::array<Memory, kDepth + 1> memory_;  // a ring
  std::vector<double> shifts_;
  int filled_ = 0, newest_ = 0;
  bool first_ = true, still_ = false;
  double last_error_ = 0;
};

}  // namespace poinsot
