// Hard cases B5, B8, B14: rolling bodies against closed forms and against their own equations.
// README.md lists them all.

#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "support/measured.h"
#include "support/profiles.h"
#include "support/rolling_reference.h"
#include "support/run.h"
#include "support/scene_builder.h"

namespace poinsot {
namespace {

constexpr double kG = 9.81;  // [m/s²]

bool is_accurate(Profile profile) {
  return profile == Profile::accurate;
}

// B5. v₀ = 7 m/s, μ = 0.2: it slips for 2 v₀/(7 μ g) = 1.01936799 s and 12 v₀²/(49 μ g) =
// 6.11620795 m, then rolls with 5/7 v₀.
TEST(HardRolling, ASphereSlipsUntilItRolls) {
  for (const Profile profile : test::kProfiles) {
    BodyDef ball = test::body("ball", Sphere{0.5}, {0, 0, 0.5});
    ball.material.friction = 0.2;
    ball.linear_velocity = {7, 0, 0};
    CollisionLayer layer(test::with_profile(test::scene({test::ground(0.2), ball}), profile));
    test::run_until(layer, 1);
    const double slipping = linear_velocity(layer.world(), 1).x() - (7 - 0.2 * kG);
    test::run_until(layer, 2);
    const double slip_time = 2 * 7 / (7 * 0.2 * kG), slip_way = 12 * 49 / (49 * 0.2 * kG);
    ASSERT_NEAR(slip_time, 1.01936799, 1e-8);
    ASSERT_NEAR(slip_way, 6.11620795, 1e-8);
    const double v = linear_velocity(layer.world(), 1).x() - 5;
    const double w = angular_velocity(layer.world(), 1).y() - 10;
    const double x = position(layer.world().y, 1).x() - (slip_way + 5 * (2 - slip_time));
    const double tolerance = is_accurate(profile) ? 1e-9 : 0.02;  // relative, of v₀ and its way
    EXPECT_LT(std::abs(slipping), 7 * tolerance);
    EXPECT_LT(std::abs(v), 5 * tolerance);
    EXPECT_LT(std::abs(w), 10 * tolerance);
    EXPECT_LT(std::abs(x), 11 * tolerance);
    const std::string of = is_accurate(profile) ? "" : "fast_";
    test::measured(of + "slipping_m_s", slipping);
    test::measured(of + "v_m_s", v);
    test::measured(of + "x_m", x);
  }
}

// B8. Down 30° without slipping: a = g sin θ / (1 + J/(m r²)) = 3.50357143, 3.27, 2.4525 m/s².
TEST(HardRolling, DownAnInclineTheRollingBodiesAccelerateByTheirInertia) {
  const double theta = std::numbers::pi / 6, radius = 0.2;
  struct Case {
    const char* name;
    Shape shape;
    double J_over_mr2, acceleration;
  };
  const Case cases[] = {{"sphere", Sphere{radius}, 0.4, 3.50357143},
                        {"cylinder", Cylinder{radius, 0.3}, 0.5, 3.27},
                        {"hoop", Cylinder{radius, 0.3}, 1, 2.4525}};
  for (const Profile profile : test::kProfiles) {
    for (const Case& c : cases) {
      BodyDef body = test::body("body", c.shape, {0, 0, radius});
      body.pose.q = Quat(Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitX()));  // axis along y
      const double mr2 = body.mass_properties.mass * radius * radius;
      body.mass_properties.J(2, 2) = c.J_over_mr2 * mr2;
      if (c.J_over_mr2 == 1) body.mass_properties.J.diagonal().head<2>().setConstant(mr2);
      body.material.friction = 1;
      Scene scene = test::with_profile(test::scene({test::ground(1), body}), profile);
      scene.simulation.gravity = kG * Vec3(std::sin(theta), 0, -std::cos(theta));
      CollisionLayer layer(scene);
      test::run_until(layer, 1);
      const double exact = kG * std::sin(theta) / (1 + c.J_over_mr2);
      ASSERT_NEAR(exact, c.acceleration, 1e-8);
      const double v = linear_velocity(layer.world(), 1).x() - exact;
      const double w = angular_velocity(layer.world(), 1).y() * radius - exact;
      const double x = position(layer.world().y, 1).x() - exact / 2;
      const double tolerance = is_accurate(profile) ? 1e-10 : 0.02 * exact;
      EXPECT_LT(std::abs(v), tolerance) << c.name;
      EXPECT_LT(std::abs(w), tolerance) << c.name;
      EXPECT_LT(std::abs(x), tolerance) << c.name;
      const std::string of = (is_accurate(profile) ? "" : "fast_") + std::string(c.name);
      test::measured(of + "_v_m_s", v);
      test::measured(of + "_x_m", x);
    }
  }
}

// B8, the limit: a sphere rolls down 30° if μ > tan 30° · 2/7, else it slips: a = g (sin − μ cos).
TEST(HardRolling, DownAnInclineASphereSlipsIfFrictionIsTooSmall) {
  const double theta = std::numbers::pi / 6, limit = std::tan(theta) * 2 / 7;
  for (const double friction : {0.99 * limit, 1.01 * limit}) {
    BodyDef ball = test::body("ball", Sphere{0.2}, {0, 0, 0.2});
    ball.material.friction = friction;
    Scene scene =
        test::with_profile(test::scene({test::ground(friction), ball}), Profile::accurate);
    scene.simulation.gravity = kG * Vec3(std::sin(theta), 0, -std::cos(theta));
    CollisionLayer layer(scene);
    test::run_until(layer, 1);
    const double rolls = kG * std::sin(theta) * 5 / 7;
    const double slips = kG * (std::sin(theta) - friction * std::cos(theta));
    const double v = linear_velocity(layer.world(), 1).x();
    EXPECT_NEAR(v, friction < limit ? slips : rolls, 1e-10) << friction / limit;
    test::measured(friction < limit ? "slips" : "rolls", v - (friction < limit ? slips : rolls));
  }
}

// B14. The rattleback of Kane and Levinson: semi-axes 20, 3, 2 cm, mass centre 1 cm below the
// centre; 1 kg; J in 1e-4 kg·m²: 2, 16, 17 and −0.2 between the long axes.
test::RollingEllipsoid rattleback() {
  test::RollingEllipsoid celt;
  celt.mass = 1;
  celt.J << 2e-4, -2e-5, 0, -2e-5, 16e-4, 0, 0, 0, 17e-4;
  celt.semi_axes = {0.2, 0.03, 0.02};
  celt.centre = {0, 0, 0.01};
  celt.gravity = kG;
  return celt;
}

constexpr double kTilt = 0.5 * std::numbers::pi / 180;  // [rad] at the start

Scene spun(const test::RollingEllipsoid& celt, double spin, Profile profile) {
  BodyDef body;
  body.name = "celt";
  body.shapes = {{Ellipsoid{celt.semi_axes}, {.c = celt.centre}}};
  body.mass_properties.mass = celt.mass;
  body.mass_properties.J = celt.J;
  body.pose.q = Quat(Eigen::AngleAxisd(kTilt, Vec3::UnitX()));
  const Vec3 up = body.pose.q.conjugate() * Vec3::UnitZ(), arm = celt.arm(up);
  body.pose.c = {0, 0, -arm.dot(up)};
  const Vec3 omega(0, 0, spin);
  body.angular_velocity = body.pose.q * omega;
  body.linear_velocity = body.pose.q * Vec3(-omega.cross(arm));
  body.material.friction = 3;  // it never slips
  return test::with_profile(test::scene({test::ground(3), body}), profile);
}

// When the spin first has the other sign [s], or −1 if it does not until `end`.
double reversal_of_reference(const test::RollingEllipsoid& celt, double spin, double end) {
  const Quat q(Eigen::AngleAxisd(kTilt, Vec3::UnitX()));
  test::RollingEllipsoid::State y{{0, 0, spin}, q.conjugate() * Vec3::UnitZ()};
  const double energy = celt.energy(y), step = 2e-4;
  for (int n = 1; n * step <= end; ++n) {
    y = celt.step(y, step);
    if (y.omega.dot(y.up) * spin < 0) {
      EXPECT_NEAR(celt.energy(y) / energy, 1, 1e-7);
      return n * step;
    }
  }
  return -1;
}

double reversal(const Scene& scene, double spin, double end) {
  CollisionLayer layer(scene);
  double when = -1;
  test::run_until(layer, end, [&](const CollisionLayer& now) {
    if (when < 0 && angular_velocity(now.world(), 1).z() * spin < 0) when = now.time();
  });
  return when;
}

TEST(HardRolling, ARattlebackReversesOneSenseOfSpinOnly) {
  const test::RollingEllipsoid celt = rattleback();
  for (const Profile profile : test::kProfiles) {
    const std::string of = is_accurate(profile) ? "" : "fast_";
    const double end = 6;
    const double exact = reversal_of_reference(celt, -5, end);
    ASSERT_NEAR(exact, 4.156, 1e-2);
    ASSERT_EQ(reversal_of_reference(celt, 5, end), -1);
    const double found = reversal(spun(celt, -5, profile), -5, end);
    test::measured(of + "reversal_s", found);
    test::measured(of + "reversal_reference_s", exact);
    EXPECT_GT(found, 0);
    if (is_accurate(profile)) {
      EXPECT_NEAR(found / exact, 1, 0.1);
    }
    EXPECT_EQ(reversal(spun(celt, 5, profile), 5, end), -1);
  }
}

}  // namespace
}  // namespace poinsot
