// A user of the library without a bus.

#include <cstdio>

#include "poinsot/math/rotation.h"

int main() {
  const poinsot::Quat q = poinsot::from_roll_pitch_yaw({0, 0, 1});
  std::printf("%.3f\n", poinsot::angle_between(q, poinsot::Quat::Identity()));
  return 0;
}
