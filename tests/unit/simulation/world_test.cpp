#include "poinsot/simulation/world.h"

#include <gtest/gtest.h>

#include "support/scene_builder.h"

namespace poinsot {
namespace {

BodyDef skewed() {
  BodyDef def = test::free_body("skewed", 2, {1, 2, 2.5});
  def.mass_properties.center_of_mass = {0.1, 0.2, 0.3};
  def.pose = {{1, 2, 3}, Quat(0.5, 0.5, -0.5, 0.5)};
  def.linear_velocity = {4, 5, 6};
  def.angular_velocity = {0.3, -0.2, 0.1};
  return def;
}

TEST(World, StateIsThatOfTheCentreOfMass) {
  const World world(test::scene({skewed()}));
  EXPECT_NEAR((position(world.y, 0) - skewed().pose * Vec3(0.1, 0.2, 0.3)).norm(), 0, 1e-15);
  EXPECT_NEAR((momentum(world.y, 0) - Vec3(8, 10, 12)).norm(), 0, 1e-15);
  EXPECT_NEAR((linear_velocity(world, 0) - Vec3(4, 5, 6)).norm(), 0, 1e-15);
  EXPECT_NEAR((angular_velocity(world, 0) - Vec3(0.3, -0.2, 0.1)).norm(), 0, 1e-15);
  const Pose pose = body_pose(world, 0);
  EXPECT_NEAR((pose.c - Vec3(1, 2, 3)).norm(), 0, 1e-15);
  EXPECT_EQ(pose.q.coeffs(), skewed().pose.q.coeffs());
}

TEST(World, FindsBodiesByHandleAndByName) {
  const World world(test::scene({test::ground(), skewed()}));
  EXPECT_EQ(world.find("skewed"), 1);
  EXPECT_EQ(world.find("nothing"), std::nullopt);
  EXPECT_EQ(world.find(BodyId{1, 1}), 1);
  EXPECT_EQ(world.find(BodyId{1, 2}), std::nullopt);  // another generation
  EXPECT_EQ(world.find(BodyId{2, 1}), std::nullopt);
  EXPECT_EQ(world.find(BodyId{}), std::nullopt);
}

TEST(World, StaticBodiesHaveNoInverseMass) {
  const World world(test::scene({test::ground(), skewed()}));
  EXPECT_FALSE(world.moves(0));
  EXPECT_EQ(world.inv_mass[0], 0);
  EXPECT_TRUE(inv_J_W(world, 0).isZero(0));
  EXPECT_TRUE(world.moves(1));
}

TEST(World, AFrozenBodyStaysAtRest) {
  World world(test::scene({skewed()}));
  world.freeze(0);
  EXPECT_FALSE(world.moves(0));
  EXPECT_TRUE(linear_velocity(world, 0).isZero(0));
  EXPECT_TRUE(angular_velocity(world, 0).isZero(0));
  EXPECT_NEAR((body_pose(world, 0).c - Vec3(1, 2, 3)).norm(), 0, 1e-15);
}

TEST(World, ABodyTakesTheLowestAbsentColumnOrANewOne) {
  World world(test::scene({test::ground(), skewed(), test::box("box", {7, 8, 9})}));
  world.held[1].in_W.force = {1, 2, 3};
  world.remove(1);
  EXPECT_TRUE(world.is_absent(1));
  EXPECT_FALSE(world.moves(1));
  EXPECT_TRUE(world.held[1].is_zero());
  EXPECT_EQ(world.names[1], "");
  EXPECT_EQ(world.find("skewed"), std::nullopt);
  EXPECT_EQ(world.find(""), std::nullopt);
  EXPECT_EQ(world.find(BodyId{1, 1}), std::nullopt);
  EXPECT_EQ(world.find("box"), 2);

  BodyDef next = skewed();
  next.name = "a";
  next.generation = 2;
  EXPECT_EQ(world.add(next), 1);
  EXPECT_EQ(world.find(BodyId{1, 2}), 1);
  next.name = "z";
  next.generation = 1;
  EXPECT_EQ(world.add(next), 3);
  EXPECT_EQ(world.size(), 4);
  for (const auto& [name, column] : {std::pair{"ground", 0}, {"a", 1}, {"box", 2}, {"z", 3}})
    EXPECT_EQ(world.find(name), column) << name;
  EXPECT_EQ(world.y.col(1), World(test::scene({skewed()})).y.col(0));
  EXPECT_EQ(world.y.col(3), world.y.col(1));
}

TEST(World, ASetStateIsThatOfTheCentreOfMassAndThaws) {
  World world(test::scene({skewed()}));
  world.freeze(0);
  const BodyDef def = skewed();
  world.set_state(0, def.pose, {def.linear_velocity, def.angular_velocity});
  EXPECT_TRUE(world.moves(0));
  EXPECT_EQ(world.y, World(test::scene({skewed()})).y);
}

}  // namespace
}  // namespace poinsot
