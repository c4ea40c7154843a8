#include "poinsot/collision/pair_motion.h"

#include <gtest/gtest.h>

#include "support/coursed_pair.h"

namespace poinsot::test {
namespace {

TEST(PairMotion, GapAlongAnAxisIsTheSeparationOfTheSupports) {
  Random random(31);
  for (int i = 0; i < 300; ++i) {
    const FlyBy f = random_fly_by(random.below(kHalfSpace), random.below(kHalfSpace), 10, random);
    const CoursedPair pair(f.a, f.b, 1, f.gravity);
    SearchWork work;
    PairMotion motion(pair.pair(), work);
    motion.go_to(random.uniform(0, 1));
    const Vec3 n = random.direction();
    EXPECT_NEAR(motion.gap_along(n),
                separation(motion.shape_a().shape, motion.pose_a(), motion.shape_b().shape,
                           motion.pose_b(), n),
                1e-13);
  }
}

TEST(PairMotion, TakesAHalfSpaceForItsSecondShape) {
  const BodyDef ball = moving(Sphere{0.5}, {0, 0, 2}, Vec3::Zero(), Vec3::Zero());
  BodyDef hill = ground();
  hill.pose = {Vec3(3, 4, 0.25), Quat(Eigen::AngleAxisd(0.5, Vec3::UnitZ()))};
  for (const bool swap : {false, true}) {
    const CoursedPair pair(swap ? hill : ball, swap ? ball : hill, 1);
    SearchWork work;
    PairMotion motion(pair.pair(), work);
    motion.go_to(0.3);
    EXPECT_EQ(motion.is_swapped(), swap);
    EXPECT_NEAR(motion.gap_along(motion.plane_normal()), 1.25, 1e-15);
    EXPECT_EQ(motion.size(), 1);
  }
}

TEST(PairMotion, BallsThatHoldTheShapesAreApartUntilTheyMeet) {
  Random random(32);
  int met = 0;
  for (int i = 0; i < 300; ++i) {
    const FlyBy f = random_fly_by(kSphere, kSphere, 10, random);
    const CoursedPair pair(f.a, f.b, 1, f.gravity);
    SearchWork work;
    PairMotion motion(pair.pair(), work);
    motion.go_to(0);
    const double x = motion.balls_apart_until(1);
    for (int k = 0; k <= 20; ++k) EXPECT_GT(pair.gap(x * k / 20), -1e-14);
    if (x == 1) continue;
    ++met;
    EXPECT_NEAR(pair.gap(x), 0, 1e-14);
  }
  EXPECT_GT(met, 50);
}

TEST(PairMotion, NothingClosesFasterThanItSays) {
  Random random(33);
  for (int i = 0; i < 300; ++i) {
    const FlyBy f =
        random_fly_by(random.below(kHalfSpace), random.below(kHalfSpace + 1), 30, random);
    const CoursedPair pair(f.a, f.b, 1, f.gravity);
    SearchWork work;
    PairMotion motion(pair.pair(), work);
    const double t = random.uniform(0.2, 0.8), h = random.log_uniform(1e-4, 0.2);
    motion.go_to(t);
    const Vec3 n = motion.has_plane() ? motion.plane_normal() : random.direction();
    const double now = motion.gap_along(n), travel = h * motion.closing_along(n, h);
    EXPECT_LE(motion.closing_along(n, h), motion.closing(h) * (1 + 1e-12));
    for (const double x : {-h, -0.5 * h, 0.5 * h, h}) {
      motion.go_to(t + x);
      EXPECT_NEAR(motion.gap_along(n), now, travel + 1e-13);
    }
  }
}

}  // namespace
}  // namespace poinsot::test
