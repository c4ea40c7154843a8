// Stacks: standing for a minute, statics of the contact forces, no energy from nowhere.

#include <gtest/gtest.h>

#include "support/run.h"
#include "support/scene_builder.h"

namespace poinsot {
namespace {

Scene tower(int count) {
  std::vector<BodyDef> bodies = {test::ground()};
  for (int i = 0; i < count; ++i)
    bodies.push_back(test::body("box" + std::to_string(i), Box{{1, 1, 1}}, {0, 0, 0.5 + i}));
  return test::scene(std::move(bodies));
}

double largest_displacement(const CollisionLayer& layer, const StateArray& start) {
  return (layer.world().y - start).topRows<3>().colwise().norm().maxCoeff();
}

TEST(Stacking, ATowerOfTenBoxesStandsForAMinute) {
  CollisionLayer layer(tower(10));
  const StateArray start = layer.world().y;
  test::run_until(layer, 1);
  // Forces are found to 1e-10 m/s of every sub-step.
  EXPECT_LT(largest_displacement(layer, start), 1e-9);
  test::run_until(layer, 30);
  const StateArray settled = layer.world().y;
  test::run_until(layer, 60);
  EXPECT_LT(largest_displacement(layer, start), 1e-9);
  EXPECT_EQ(largest_displacement(layer, settled), 0);  // asleep
  EXPECT_LT(layer.report().max_penetration, 1e-9);
  for (Eigen::Index i = 1; i < layer.world().size(); ++i)
    EXPECT_EQ(linear_velocity(layer.world(), i).norm(), 0);
  EXPECT_LT(std::abs(layer.energy_error()), 1e-12);
}

TEST(Stacking, ARestingBodyDoesNotMoveAtAll) {
  CollisionLayer layer(tower(1));
  test::run_until(layer, 10);
  const Eigen::Matrix<double, 13, 1> settled = layer.world().y.col(1);
  test::run_until(layer, 20);
  EXPECT_NEAR((layer.world().y.col(1) - settled).head<7>().norm(), 0, 1e-12);
}

TEST(Stacking, ACylinderCarriesABox) {
  BodyDef drum = test::body("drum", Cylinder{0.3, 1}, {0, 0, 0.5});
  BodyDef lid = test::body("lid", Box{{1, 1, 0.2}}, {0, 0, 1.1});
  CollisionLayer layer(test::scene({test::ground(), drum, lid}));
  const StateArray start = layer.world().y;
  test::run_until(layer, 10);
  EXPECT_LT(largest_displacement(layer, start), 1e-9);
}

TEST(Stacking, OverlapsArePushedOutAtBoundedSpeedWithoutKineticEnergy) {
  Scene scene = tower(2);
  scene.bodies[2].pose.c.z() = 1.3;  // 0.2 m into the box below
  scene.allow_overlap = true;
  CollisionLayer layer(scene);
  double last = 1.3, fastest = 0;
  test::run_until(layer, 5, [&](const CollisionLayer& now) {
    const double z = position(now.world().y, 2).z();
    fastest = std::max(fastest, (z - last) * test::kFrameRate);
    last = z;
  });
  EXPECT_GT(last, 1.5 - 1e-3);
  EXPECT_LT(last, 1.5 + 1e-4);
  EXPECT_LE(fastest, scene.collision.push_out_speed * 1.05);
  // Bounded by what lifting out the penetration takes.
  EXPECT_LT(layer.report().push_out_energy, 1000 * 9.81 * 0.2 * 1.1);
}

TEST(Stacking, APileComesToRestWithoutExploding) {
  std::vector<BodyDef> bodies = {test::ground()};
  for (int i = 0; i < 60; ++i) {
    BodyDef box = test::body("box" + std::to_string(i), Box{{0.5, 0.4, 0.3}},
                             {0.5 * (i % 4), 0.5 * (i / 4 % 4), 0.5 + 0.6 * (i / 16)});
    box.pose.q = Quat(1, 0.05 * (i % 3), 0.04 * (i % 5), 0.03 * (i % 7)).normalized();
    bodies.push_back(box);
  }
  CollisionLayer layer(test::scene(std::move(bodies)));
  const double start = layer.energy();
  test::run_until(layer, 8,
                  [&](const CollisionLayer& now) { ASSERT_LT(now.energy(), start * 1.001); });
  double fastest = 0;
  for (Eigen::Index i = 1; i < layer.world().size(); ++i)
    fastest = std::max(fastest, linear_velocity(layer.world(), i).norm());
  EXPECT_LT(fastest, 1e-6);
  EXPECT_LT(layer.report().max_penetration, 1e-7);
}

}  // namespace
}  // namespace poinsot
