// Hard cases D12, D15, D17, D18: what stands, what falls, and with which forces.

#include <cmath>

#include <gtest/gtest.h>

#include "support/profiles.h"
#include "support/run.h"
#include "support/scene_builder.h"

namespace poinsot {
namespace {

constexpr double kG = 9.81;
constexpr double kPi = 3.14159265358979324;

// Unit boxes of these masses on one another.
Scene tower(const std::vector<double>& masses) {
  Scene scene = test::scene(std::vector<BodyDef>(1, test::ground(0.5)));
  for (std::size_t k = 0; k < masses.size(); ++k) {
    scene.bodies.push_back(test::box("box " + std::to_string(k),
                                     {0, 0, 0.5 + static_cast<double>(k)}, Vec3(1, 1, 1),
                                     masses[k]));
    scene.bodies.back().material.friction = 0.5;
  }
  return scene;
}

struct Standing {
  double displacement = 0;  // [m] largest of any body
  double force_error = 0;   // [-] of the force between two boxes, relative to the weight above
  double penetration = 0;   // [m]
};

Standing stand(Scene scene, Profile profile, double seconds) {
  scene = test::with_profile(std::move(scene), profile);
  scene.collision.sleeping = false;
  const std::vector<BodyDef> bodies = scene.bodies;
  CollisionLayer layer(scene);
  test::run_until(layer, seconds);
  Standing result;
  std::vector<double> carried(bodies.size(), 0);  // [N] by each body from below
  std::vector<ContactForce> forces;
  layer.contact_forces(forces);
  for (const ContactForce& f : forces)
    carried[static_cast<std::size_t>(std::max(f.a, f.b))] += std::abs(f.force.z());
  double above = 0;
  for (std::size_t k = bodies.size(); k-- > 1;) {
    above += bodies[k].mass_properties.mass * kG;
    result.force_error = std::max(result.force_error, std::abs(carried[k] / above - 1));
    result.displacement = std::max(
        result.displacement,
        (Vec3(position(layer.world().y, static_cast<Eigen::Index>(k))) - bodies[k].pose.c).norm());
  }
  result.penetration = layer.report().max_penetration;
  return result;
}

std::vector<double> alternating(int n, double light, double heavy) {
  std::vector<double> masses;
  for (int k = 0; k < n; ++k) masses.push_back(k % 2 == 0 ? light : heavy);
  return masses;
}

TEST(HardStatics, TowersStandByTheWeightAboveAtAnyMassRatio) {
  struct Case {
    const char* name;
    std::vector<double> masses;
    double seconds, displacement;
  } cases[] = {
      {"ten", std::vector<double>(10, 1000), 60, 1e-6},
      {"thirty", std::vector<double>(30, 1000), 60, 1e-6},
      {"hundred", std::vector<double>(100, 1000), 5, 1e-6},
      {"heaviest on top", {1, 10, 100, 1000}, 10, 1e-6},
      {"a hundred times on top", {1, 1, 1, 1, 1, 1, 1, 1, 1, 100}, 10, 1e-6},
      {"a thousand times on top", {1, 1, 1, 1, 1, 1, 1, 1, 1, 1000}, 10, 1e-6},
      {"alternating 1:1000", alternating(30, 1, 1000), 10, 1e-5},
      {"alternating 1:10000", alternating(30, 1, 1e4), 10, 1e-4},
  };
  for (const Case& one : cases) {
    const Standing found = stand(tower(one.masses), Profile::accurate, one.seconds);
    EXPECT_LT(found.displacement, one.displacement) << one.name;
    EXPECT_LT(found.force_error, 1e-6) << one.name;
    EXPECT_LT(found.penetration, 1e-6) << one.name;
  }
}

TEST(HardStatics, FastTowersOfEqualBoxesStandToAMillimetre) {
  const Standing ten = stand(tower(std::vector<double>(10, 1000)), Profile::fast, 60);
  EXPECT_LT(ten.displacement, 3e-3);
  EXPECT_LT(ten.force_error, 1e-2);
  EXPECT_LT(ten.penetration, 1e-3);
}

// D12: n bricks of length 1, each shifted by 1/(2k) over the one below, reach out by half the
// harmonic number and no more. All shifts are `more` longer, so that none is in neutral
// equilibrium: that would fall by its rounding.
Scene overhang(int n, double more) {
  Scene scene = test::scene(std::vector<BodyDef>());
  BodyDef table = test::box("table", {-5, 0, -0.5}, {10, 10, 1});
  table.is_static = true;
  table.mass_properties = {};
  table.material.friction = 0.5;
  scene.bodies.push_back(table);
  double edge = 0;  // of what carries the brick
  for (int k = n; k >= 1; --k) {
    edge += 0.5 / k * (1 + more);
    BodyDef brick = test::box("brick " + std::to_string(k), {edge - 0.5, 0, 0.05 + 0.1 * (n - k)},
                              {1, 0.5, 0.1}, 1);
    brick.material.friction = 0.5;
    scene.bodies.push_back(brick);
  }
  return scene;
}

TEST(HardStatics, HarmonicOverhangsStandAThousandthInsideAndFallAThousandthBeyond) {
  for (const int n : {4, 10, 31}) {
    const auto sinks = [&](double more) {
      Scene scene = test::with_profile(overhang(n, more), Profile::accurate);
      const double before = scene.bodies.back().pose.c.z();
      CollisionLayer layer(scene);
      test::run_until(layer, 6);
      return before - position(layer.world().y, n).z();
    };
    EXPECT_LT(sinks(-1e-3), 1e-6) << n;
    EXPECT_GT(sinks(1e-3), 0.05) << n;
  }
}

// D15: a semicircular arch of n radial voussoirs, mean radius 1, on immovable springers.
Scene arch(int n, double thickness) {
  Scene scene = test::scene(std::vector<BodyDef>());
  const double inner = 1 - thickness / 2, outer = 1 + thickness / 2;
  for (int k = -1; k <= n; ++k) {
    const double from = kPi * k / n, to = kPi * (k + 1) / n;
    std::vector<Vec3> corners;
    for (const double angle : {from, to})
      for (const double r : {inner, outer})
        for (const double y : {-0.1, 0.1})
          corners.push_back({r * std::cos(angle), y, r * std::sin(angle)});
    BodyDef body = test::body("stone " + std::to_string(k + 1), convex_hull(corners), Vec3::Zero());
    body.material.friction = 2;  // hinges, not slips, are the question
    if (k < 0 || k == n) {
      body.is_static = true;
      body.mass_properties = {};
    }
    scene.bodies.push_back(body);
  }
  return scene;
}

TEST(HardStatics, AnArchStandsFivePercentAboveTheLeastThicknessAndFallsBelow) {
  const auto sinks = [&](double thickness) {
    const int n = 30;
    Scene scene = test::with_profile(arch(n, thickness), Profile::accurate);
    CollisionLayer layer(scene);
    test::run_until(layer, 4);
    double most = 0;
    for (Eigen::Index i = 1; i <= n; ++i) {
      const Vec3 moved = body_pose(layer.world(), i).c;
      most = std::max(most, moved.norm());
    }
    return most;
  };
  EXPECT_LT(sinks(0.1075 * 1.05), 1e-4);
  EXPECT_GT(sinks(0.1075 * 0.95), 0.1);
}

}  // namespace
}  // namespace poinsot
