#include "poinsot/presentation/living_scene.h"

#include <gtest/gtest.h>

#include "support/scene_builder.h"

namespace poinsot {
namespace {

Scene two_boxes() {
  Scene scene = test::empty_scene();
  scene.bodies = {test::box("a", Vec3(0, 0, 0)), test::box("b", Vec3(3, 0, 0))};
  return scene;
}

BodyDef box(const std::string& name) {
  return test::box(name, Vec3(9, 0, 0));
}

TEST(LivingScene, TheNextBodyTakesTheFirstAbsentPlaceInTheNextGeneration) {
  LivingScene scene(two_boxes());
  scene.remove(1);
  scene.remove(0);
  EXPECT_EQ(scene.bodies(), 0u);
  BodyDef c = box("c"), d = box("d"), e = box("e");
  EXPECT_EQ(scene.add(c), 0u);
  EXPECT_EQ(c.generation, 2u);
  EXPECT_EQ(scene.add(d), 1u);
  EXPECT_EQ(d.generation, 2u);
  EXPECT_EQ(scene.add(e), 2u);
  EXPECT_EQ(e.generation, 1u);
  EXPECT_EQ(scene.bodies(), 3u);
  scene.remove(0);
  BodyDef f = box("f");
  scene.add(f);
  EXPECT_EQ(f.generation, 3u);
}

TEST(LivingScene, KnowsTheBodiesOfTheStart) {
  LivingScene scene(two_boxes());
  EXPECT_TRUE(scene.is_original(1));
  scene.remove(1);
  EXPECT_FALSE(scene.is_original(1));
  BodyDef c = box("c"), d = box("d");
  scene.add(c);
  scene.add(d);
  EXPECT_FALSE(scene.is_original(1));
  EXPECT_FALSE(scene.is_original(2));
  scene.start_afresh();
  EXPECT_TRUE(scene.is_original(1));
}

TEST(LivingScene, WhatWasSharedIsNotChanged) {
  LivingScene scene(two_boxes());
  BodyDef c = box("c");
  scene.add(c);
  const auto before = scene.share();
  scene.remove(0);
  EXPECT_FALSE(before->bodies[0].absent);
  EXPECT_EQ(before->bodies.size(), 3u);
  const Scene* const mine = &scene.now();
  scene.remove(1);
  EXPECT_EQ(&scene.now(), mine);  // nobody has it: no copy
  EXPECT_EQ(scene.original().bodies[0].name, "a");
}

TEST(LivingScene, TheDigestIsOfAllThatCameAndWent) {
  LivingScene one(two_boxes()), two(two_boxes());
  EXPECT_EQ(one.digest(), 0u);
  BodyDef c = box("c"), heavier = box("c");
  heavier.mass_properties.mass *= 2;
  one.add(c);
  two.add(heavier);
  EXPECT_NE(one.digest(), 0u);
  EXPECT_NE(one.digest(), two.digest());
  one.start_afresh();
  EXPECT_EQ(one.digest(), 0u);
  one.add(c);
  two.start_afresh();
  two.add(c);
  EXPECT_EQ(one.digest(), two.digest());
}

TEST(LivingScene, TheRevisionChangesWithTheBodies) {
  LivingScene scene(two_boxes());
  EXPECT_EQ(scene.revision(), 1u);
  scene.start_afresh();
  EXPECT_EQ(scene.revision(), 1u);  // nothing had changed
  scene.remove(0);
  EXPECT_EQ(scene.revision(), 2u);
  scene.move_static(1, {});
  EXPECT_EQ(scene.revision(), 3u);
  scene.start_afresh();
  EXPECT_EQ(scene.revision(), 4u);
}

TEST(LivingScene, GoesThroughBytesWithItsOriginal) {
  LivingScene scene(two_boxes());
  BodyDef c = box("c");
  scene.add(c);
  ByteWriter out;
  scene.save(out);
  LivingScene other(*scene.share());
  ByteReader in(out.bytes());
  other.restore(in, scene.share());
  EXPECT_EQ(in.left(), 0u);
  EXPECT_EQ(other.digest(), scene.digest());
  EXPECT_EQ(other.original().bodies.size(), 2u);
  EXPECT_FALSE(other.is_original(2));
}

}  // namespace
}  // namespace poinsot
