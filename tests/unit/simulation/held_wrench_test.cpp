#include "poinsot/simulation/held_wrench.h"

#include <gtest/gtest.h>

namespace poinsot {
namespace {

TEST(HeldWrench, SumsForcesAtBodyPointsExactlyAtEveryOrientation) {
  const Vec3 points[] = {{1, 2, 3}, {-0.5, 0.25, 4}, {0, 0, -1}};
  const Vec3 forces[] = {{10, -3, 2}, {0.1, 7, -20}, {5, 5, 5}};
  HeldWrench held;
  held.in_B = {{1, 2, 3}, {-1, 0, 2}};
  held.in_W.torque = {0, 0, 9};
  for (int k = 0; k < 3; ++k) held.add_force_at(points[k], forces[k]);

  for (int turn = 0; turn < 20; ++turn) {
    const Mat3 R = Quat(1 + turn, 2 - turn, 0.3 * turn, -1).normalized().toRotationMatrix();
    Vec3 force = R * held.in_B.force, torque = R * held.in_B.torque + held.in_W.torque;
    for (int k = 0; k < 3; ++k) {
      force += forces[k];
      torque += (R * points[k]).cross(forces[k]);
    }
    const Wrench w = held.at(R);
    EXPECT_NEAR((w.force - force).norm(), 0, 1e-14 * force.norm());
    EXPECT_NEAR((w.torque - torque).norm(), 0, 1e-14 * 300);  // scale: Σ |p||F|
  }
}

TEST(HeldWrench, IsZeroOnlyWhenNothingIsHeld) {
  HeldWrench held;
  EXPECT_TRUE(held.is_zero());
  held.add_force_at({0, 0, 0}, {1e-300, 0, 0});
  EXPECT_FALSE(held.is_zero());
  HeldWrench couple;  // two forces that cancel still turn the body
  couple.add_force_at({1, 0, 0}, {0, 1, 0});
  couple.add_force_at({-1, 0, 0}, {0, -1, 0});
  EXPECT_TRUE(couple.in_W.force.isZero(0));
  EXPECT_FALSE(couple.is_zero());
}

}  // namespace
}  // namespace poinsot
