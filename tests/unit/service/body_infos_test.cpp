#include "poinsot/service/body_infos.h"

#include <gtest/gtest.h>

#include "support/scene_builder.h"

namespace poinsot {
namespace {

TEST(BodyInfos, DescribeEveryBodyInFileOrder) {
  Scene scene = test::empty_scene();
  scene.bodies = {test::floor("table"), test::box("box", Vec3(1, 2, 3))};
  scene.bodies[1].material = {.friction = 0.25, .restitution = 0.75};
  const World world(scene);
  const auto infos = body_infos(scene, world, 99);
  ASSERT_EQ(infos.size(), 2u);
  EXPECT_EQ(infos[0].name, "table");
  EXPECT_TRUE(infos[0].is_static);
  EXPECT_EQ(infos[1].session, 99u);
  EXPECT_EQ(infos[1].id, world.ids[1]);
  EXPECT_EQ(infos[1].index, 1u);
  EXPECT_EQ(infos[1].count, 2u);
  EXPECT_EQ(infos[1].name, "box");
  EXPECT_FALSE(infos[1].is_static);
  EXPECT_EQ(infos[1].mass_properties.mass, 2);
  EXPECT_EQ(infos[1].pose.c, Vec3(1, 2, 3));
  EXPECT_EQ(infos[1].material.friction, 0.25);
  EXPECT_EQ(infos[1].shapes.size(), 1u);
}

}  // namespace
}  // namespace poinsot
