#include "poinsot/collision/back_up.h"

#include <cmath>

#include <gtest/gtest.h>

#include "support/coursed_pair.h"

namespace poinsot::test {
namespace {

TEST(BackUp, FindsTheRootOfAFallInFewSteps) {
  const BodyDef ball = moving(Sphere{0.1}, {0, 0, 1.1}, Vec3::Zero(), Vec3::Zero());
  const CoursedPair pair(ball, ground(), 2, {0, 0, -9.81});
  SearchWork work;
  PairMotion motion(pair.pair(), work);
  motion.go_to(0);
  const NearestAxis axis = back_up(motion, 0, 2, nearest_axis(motion, Vec3::Zero()));
  EXPECT_NEAR(motion.time(), std::sqrt(2 / 9.81), 1e-15);
  EXPECT_NEAR(axis.gap, 0, motion.rounding());
  EXPECT_LE(work.poses, 12u);
}

TEST(BackUp, FindsARootOfTumblingBoxesFromDeepInside) {
  Random random(41);
  int found = 0;
  for (int i = 0; i < 100; ++i) {
    const Box box{{0.5, 0.3, 0.2}};
    const auto omega = [&] { return Vec3(random.uniform(0, 20) * random.direction()); };
    const CoursedPair pair(moving(box, {0, 0, 1}, {0, 0, -2}, omega(), random.rotation()),
                           moving(box, Vec3::Zero(), Vec3::Zero(), omega(), random.rotation()), 1);
    SearchWork work;
    PairMotion motion(pair.pair(), work);
    motion.go_to(0);
    const NearestAxis axis = back_up(motion, 0, 0.45, nearest_axis(motion, Vec3::Zero()));
    EXPECT_NEAR(axis.gap, 0, motion.rounding() + 1e-13);
    EXPECT_NEAR(pair.gap(motion.time()), 0, 1e-12);
    EXPECT_LE(work.poses, 60u);
    ++found;
  }
  EXPECT_EQ(found, 100);
}

}  // namespace
}  // namespace poinsot::test
