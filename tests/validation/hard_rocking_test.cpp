// Hard cases D9, D11: bodies that turn about an edge which friction alone holds.

#include <cmath>

#include <gtest/gtest.h>

#include "support/profiles.h"
#include "support/run.h"
#include "support/scene_builder.h"

namespace poinsot {
namespace {

constexpr double kG = 9.81;
constexpr double kB = 0.1, kH = 0.3;  // [m] half sizes
const double kAlpha = std::atan2(kB, kH);
const double kP2 = 3 * kG / (4 * std::hypot(kB, kH));  // [1/s²]

// A block that leans on one edge, turned by `theta` about y.
Scene leaning(const Vec3& size, double theta) {
  BodyDef block = test::body("block", Box{size}, Vec3::Zero());
  block.pose.q = Quat(std::cos(theta / 2), 0, std::sin(theta / 2), 0);
  block.pose.c = -(block.pose.q * Vec3(0.5 * size.x(), 0, -0.5 * size.z()));
  block.material.friction = 2;
  Scene scene = test::with_profile(test::scene({test::ground(2), block}), Profile::accurate);
  scene.collision.sleeping = false;
  return scene;
}

// The time in which θ″ = −p² sin(α − θ) leads from rest at θ0 to 0, by the substitution θ = θ0 −
// s², which takes the root out, and Simpson's rule.
double fall_time(double theta) {
  constexpr int kParts = 2000;
  const double end = std::sqrt(theta), ds = end / kParts;
  const auto f = [&](double s) {
    // cos(α−θ0) − cos(α−θ) = 2 sin(α − θ0 + s²/2) sin(s²/2)
    const double half = 0.5 * s * s;
    const double sine = s > 0 ? std::sin(half) / half : 1.0;
    return 2 / std::sqrt(2 * kP2 * std::sin(kAlpha - theta + half) * sine);
  };
  double sum = 0;
  for (int k = 0; k < kParts; ++k)
    sum += ds / 6 * (f(k * ds) + 4 * f((k + 0.5) * ds) + f((k + 1) * ds));
  return sum;
}

struct Rocked {
  double time = 0, ratio = 0;  // [s] of the first impact; [-] of angular velocities there
};
Rocked rock(double step) {
  Scene scene = leaning({2 * kB, 2 * kB, 2 * kH}, 0.5 * kAlpha);
  scene.collision.contact_step = step;
  CollisionLayer layer(scene);
  Rocked first;
  test::run_until(layer, 0.4, [&](const CollisionLayer& now) {
    if (first.time > 0 || now.impacts().empty()) return;
    const ImpactEvent& impact = now.impacts().front();
    first = {impact.time, impact.w_a_after.y() / impact.w_a_before.y()};
  });
  return first;
}

// The pivot is held by stepped contacts, whose error is of second order in the step.
TEST(HardRocking, ABlockRocksInTheTimeOfTheQuadratureToSecondOrder) {
  const double exact = fall_time(0.5 * kAlpha);
  EXPECT_NEAR(4 * exact, 1.09211091, 0.01 * 1.09211091);  // linearised
  const Rocked coarse = rock(1.0 / 240), fine = rock(1.0 / 480), finest = rock(1.0 / 960);
  EXPECT_NEAR(coarse.time, exact, 3e-5 * exact);
  EXPECT_NEAR((coarse.time - exact) / (fine.time - exact), 4, 0.4);
  EXPECT_NEAR((fine.time - exact) / (finest.time - exact), 4, 0.4);
}

TEST(HardRocking, AnImpactOnTheOtherEdgeLeavesHousnersPartOfTheSpin) {
  const double sine = std::sin(kAlpha), expected = 1 - 1.5 * sine * sine;
  const double coarse = rock(1.0 / 240).ratio - expected;
  EXPECT_LT(std::abs(coarse), 1e-4);
  EXPECT_LT(std::abs(rock(1.0 / 960).ratio - expected), 1e-5);
}

// D11: a rod of length L at φ from the horizontal, held by friction at its foot, starts with
// 3 g cos φ / 2L: its tip is faster than what falls freely if cos φ > 2/3.
TEST(HardRocking, TheTipOfAFallingRodOutrunsFreeFallBelowTheKnownAngle) {
  constexpr double kLength = 1, kThin = 1e-3;
  for (const double degrees : {30.0, 47.0, 49.5, 60.0}) {
    const double phi = degrees * 3.14159265358979324 / 180;
    Scene scene = leaning({kThin, 0.1, kLength}, 0.5 * 3.14159265358979324 - phi);
    CollisionLayer layer(scene);
    layer.advance_to(1.0 / 960);
    const double acceleration = angular_velocity(layer.world(), 1).y() * 960;
    // The section shifts the centre and adds to the inertia, both by its part of the length; the
    // angle changes by ½ α t² in the time that is looked at.
    EXPECT_NEAR(acceleration, 1.5 * kG * std::cos(phi) / kLength, 3 * kThin * kG) << degrees;
    EXPECT_EQ(acceleration * kLength > kG, degrees < 48.19) << degrees;
  }
}

}  // namespace
}  // namespace poinsot
