// What one advance may have added to the error of a body: a bound for flights, an estimate else.

#pragma once

#include <algorithm>

namespace poinsot {

struct LocalError {
  double position = 0;     // [m]
  double orientation = 0;  // [rad]

  LocalError& operator+=(const LocalError& other) {
    position += other.position;
    orientation += other.orientation;
    return *this;
  }
  void raise_to(const LocalError& other) {
    position = std::max(position, other.position);
    orientation = std::max(orientation, other.orientation);
  }
  bool operator==(const LocalError&) const = default;

  template <class Archive>
  void archive(Archive& with) {
    with(position, orientation);
  }
};

}  // namespace poinsot
