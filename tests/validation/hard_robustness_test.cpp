// Hard cases C20, C21, F11: what has no good answer in rigid mechanics, and crowds. README.md lists
// them all.

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "support/measured.h"
#include "support/profiles.h"
#include "support/run.h"
#include "support/scene_builder.h"

namespace poinsot {
namespace {

// Runs to `end`; the energy may not rise from frame to frame but for what push-out is told to have
// added and for rounding of the first energy. Returns the largest rise beyond that, relative.
double largest_rise(CollisionLayer& layer, double end) {
  const double start = std::abs(layer.energy());
  double before = layer.energy(), pushed = 0, rise = 0;
  test::run_until(layer, end, [&](const CollisionLayer& now) {
    const double energy = now.energy(), added = now.report().push_out_energy;
    EXPECT_TRUE(std::isfinite(energy));
    rise = std::max(rise, (energy - before - (added - pushed)) / start);
    before = energy;
    pushed = added;
  });
  EXPECT_TRUE(std::as_const(layer).world().y.allFinite());
  EXPECT_EQ(layer.simulation().quarantined(), 0u);
  return rise;
}

// C20. A slender rod, 1 m, slides on its lower end at 63.43° from the horizontal: p =
// 1 + 3 cos² θ − 3 μ sin θ cos θ is 0.16, 0, −0.08 for μ = 1.2, 4/3, 1.4. Negative: pressing brings
// the end down faster, and only an impact without collision ends it.
Scene painleve_rod(double friction, double speed, Profile profile) {
  const double theta = std::atan(2.0), length = 1, radius = 1e-3, mass = 1;
  BodyDef rod;
  rod.name = "rod";
  rod.shapes = {{Capsule{radius, length}, {}}};
  rod.mass_properties.mass = mass;
  rod.mass_properties.J =
      Vec3(mass / 12 * length * length, mass / 12 * length * length, 1e-3).asDiagonal();
  // Its axis in the plane of x and z, the lower end towards −x.
  const Vec3 along(std::cos(theta), 0, std::sin(theta));
  rod.pose.q = Quat::FromTwoVectors(Vec3::UnitZ(), along);
  rod.pose.c = Vec3(0, 0, radius + length / 2 * std::sin(theta));
  rod.linear_velocity = {speed, 0, 0};
  rod.material.friction = friction;
  return test::with_profile(test::scene({test::ground(friction), rod}), profile);
}

TEST(HardRobustness, PainlevesRodNeitherGainsEnergyNorHangs) {
  double rise = 0;
  for (const Profile profile : test::kProfiles)
    for (const double friction : {1.2, 4.0 / 3, 1.4, 3.0})
      for (const double speed : {-5.0, 5.0}) {
        CollisionLayer layer(painleve_rod(friction, speed, profile));
        rise = std::max(rise, largest_rise(layer, 2));
      }
  test::measured("rise_relative", rise);
  EXPECT_LT(rise, 1e-9);
}

// C21 [S]. A plank on two feet with large friction: sliding on, it jams and topples or hops.
TEST(HardRobustness, ASlenderBodyOnTwoFeetThatJamsNeitherGainsEnergyNorHangs) {
  double rise = 0;
  for (const Profile profile : test::kProfiles)
    for (const double friction : {0.5, 1.5, 3.0})
      for (const double height : {0.2, 1.0}) {
        BodyDef body;
        body.name = "plank";
        body.shapes = {{Sphere{0.02}, {.c = Vec3(0.3, 0, -height)}},
                       {Sphere{0.02}, {.c = Vec3(-0.3, 0, -height)}}};
        body.mass_properties.mass = 1;
        body.mass_properties.J = Vec3(0.05, 0.1, 0.1).asDiagonal();
        body.pose.c = {0, 0, height + 0.02};
        body.linear_velocity = {6, 0, 0};
        body.material.friction = friction;
        CollisionLayer layer(
            test::with_profile(test::scene({test::ground(friction), body}), profile));
        rise = std::max(rise, largest_rise(layer, 2));
      }
  test::measured("rise_relative", rise);
  EXPECT_LT(rise, 1e-9);
}

// F11, shorter: a pile of 10 × 10 × 10 boxes falls for two seconds, by one thread and by two.
Scene pile(int threads) {
  std::vector<BodyDef> bodies{test::ground()};
  for (int n = 0; n < 1000; ++n) {
    const int x = n % 10, y = n / 10 % 10, z = n / 100;
    bodies.push_back(
        test::body("box" + std::to_string(n), Box{{0.5, 0.5, 0.5}},
                   {0.6 * x + 0.01 * (n % 7), 0.6 * y + 0.01 * (n % 5), 0.3 + 0.6 * z}));
  }
  Scene scene = test::with_profile(test::scene(std::move(bodies)), Profile::fast);
  scene.collision.threads = threads;
  return scene;
}

std::uint64_t fingerprint(const CollisionLayer& layer) {
  Hash64 hash;
  hash.add({layer.world().y.data(), static_cast<std::size_t>(layer.world().y.size())});
  layer.hash_into(hash);
  return hash.value();
}

TEST(HardRobustness, APileOfAThousandBoxesIsTheSameByOneThreadAndByTwo) {
  CollisionLayer one(pile(1)), two(pile(2));
  const double start = one.energy();
  for (int n = 1; n <= 60; ++n) {
    one.advance_to(n / 60.0);
    two.advance_to(n / 60.0);
    ASSERT_LT(one.energy(), start * (1 + 1e-9)) << n;
    ASSERT_EQ(fingerprint(one), fingerprint(two)) << n;
  }
  test::measured("penetration_m", one.report().max_penetration);
  EXPECT_EQ(one.simulation().quarantined(), 0u);
}

}  // namespace
}  // namespace poinsot
