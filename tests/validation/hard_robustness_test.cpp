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

struct Worst {
  double rise = 0;         // of the energy in a frame beyond what push-out added, relative
  double penetration = 0;  // [m] largest
};

Worst worst_of(const Scene& scene, double end) {
  CollisionLayer layer(scene);
  const double start = layer.energy();
  double before = start, pushed = 0;
  Worst worst;
  test::run_until(layer, end, [&](const CollisionLayer& now) {
    const double energy = now.energy(), added = now.report().push_out_energy;
    EXPECT_TRUE(std::isfinite(energy));
    worst.rise = std::max(worst.rise, (energy - before - (added - pushed)) / start);
    worst.penetration = std::max(worst.penetration, now.report().max_penetration);
    before = energy;
    pushed = added;
  });
  EXPECT_TRUE(std::as_const(layer).world().y.allFinite());
  EXPECT_EQ(layer.simulation().quarantined(), 0u);
  return worst;
}

// C20. A slender rod, 1 m, slides on its lower end at 63.43° from the horizontal: p = 1 + 3 cos² θ
// − 3 μ sin θ cos θ is 0.16, 0, −0.08 for μ = 1.2, 4/3, 1.4 if friction drives the end into the
// ground (speed < 0). Where it is not positive there is no finite force, but an impact without
// collision.
Scene painleve_rod(double friction, double speed, Profile profile) {
  const double theta = std::atan(2.0), length = 1, radius = 1e-3, mass = 1;
  BodyDef rod;
  rod.name = "rod";
  rod.shapes = {{Capsule{radius, length}, {}}};
  const double across = mass / 12 * length * length;
  rod.mass_properties.mass = mass;
  rod.mass_properties.J = Vec3(across, across, 1e-3).asDiagonal();
  const Vec3 along(std::cos(theta), 0, std::sin(theta));  // the lower end is towards −x
  rod.pose.q = Quat::FromTwoVectors(Vec3::UnitZ(), along);
  rod.pose.c = Vec3(0, 0, radius + length / 2 * std::sin(theta));
  rod.linear_velocity = {speed, 0, 0};
  rod.material.friction = friction;
  return test::with_profile(test::scene({test::ground(friction), rod}), profile);
}

// Contact forces act over sub-steps: with ω of some 10 rad/s and arms of 1 m each sub-step may add
// m g ω² h²/2 of energy, four of them in a frame, and leave ω² h²/2 of penetration.
double second_order(const Scene& scene) {
  const double turned = 10 * scene.collision.contact_step;
  return 0.5 * turned * turned;
}

constexpr double kSunk = 1e-6;  // [m] of a rod of 1 m

TEST(HardRobustness, PainlevesRodNeitherGainsEnergyNorSinksNorHangs) {
  Worst worst, fast;
  for (const Profile profile : test::kProfiles)
    for (const double friction : {1.2, 4.0 / 3, 1.4, 3.0})
      for (const double speed : {-5.0, 5.0}) {
        const Worst one = worst_of(painleve_rod(friction, speed, profile), 2);
        Worst& all = profile == Profile::accurate ? worst : fast;
        all.rise = std::max(all.rise, one.rise);
        all.penetration = std::max(all.penetration, one.penetration);
      }
  test::measured("rise_relative", worst.rise);
  test::measured("penetration_m", worst.penetration);
  test::measured("fast_rise_relative", fast.rise);
  test::measured("fast_penetration_m", fast.penetration);
  const double allowed = second_order(painleve_rod(1, 5, Profile::accurate));
  EXPECT_LT(worst.rise, 4 * allowed);
  EXPECT_LT(worst.penetration, kSunk);
  EXPECT_LT(fast.rise, 4 * allowed);
  EXPECT_LT(fast.penetration, 1e3 * kSunk);
}

// C21 [S]. A bar on two feet, `height` above them, slides: with large friction it jams.
Scene sliding_bar(double friction, double height, Profile profile) {
  BodyDef bar;
  bar.name = "bar";
  bar.shapes = {{Sphere{0.02}, {.c = Vec3(0.3, 0, -height)}},
                {Sphere{0.02}, {.c = Vec3(-0.3, 0, -height)}},
                {Box{{0.64, 0.1, 0.1}}, {}}};
  bar.mass_properties.mass = 1;
  bar.mass_properties.J = Vec3(0.05, 0.1, 0.1).asDiagonal();
  bar.pose.c = {0, 0, height + 0.02};
  bar.linear_velocity = {6, 0, 0};
  bar.material.friction = friction;
  return test::with_profile(test::scene({test::ground(friction), bar}), profile);
}

void expect_sound(const Scene& scene, const std::string& what) {
  const Worst one = worst_of(scene, 1.5);
  test::measured("rise_" + what, one.rise);
  test::measured("penetration_m_" + what, one.penetration);
  EXPECT_LT(one.rise, 4 * second_order(scene)) << what;
  EXPECT_LT(one.penetration, second_order(scene)) << what;
}

TEST(HardRobustness, ABarOnTwoFeetThatSlidesAndJamsStaysSound) {
  for (const double friction : {0.5, 1.5, 3.0})
    for (const double height : {0.2, 1.0}) {
      const std::string of = (height > 0.5 ? "high_" : "low_") + std::to_string(friction);
      expect_sound(sliding_bar(friction, height, Profile::accurate), of);
      expect_sound(sliding_bar(friction, height, Profile::fast), of + "_fast");
    }
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
