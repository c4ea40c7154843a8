#include "poinsot/presentation/body_search.h"

#include <gtest/gtest.h>

#include "support/scene_builder.h"

namespace poinsot {
namespace {

Scene crates(int count) {
  Scene scene = test::empty_scene();
  for (int n = 0; n < count; ++n)
    scene.bodies.push_back(test::box("crate-" + std::to_string(n), Vec3(3 * n, 0, 0)));
  return scene;
}

TEST(BodySearch, AnIdGoesBeforeAName) {
  const World world(crates(3));
  EXPECT_EQ(find_body({2, 1}, "crate-0", world), 2);
  EXPECT_EQ(find_body({}, "crate-1", world), 1);
  EXPECT_EQ(find_body({2, 2}, "crate-0", world), std::nullopt);
  EXPECT_EQ(find_body({}, "", world), std::nullopt);
}

TEST(BodySearch, AnAbsentPlaceIsFoundByNobody) {
  Scene scene = crates(2);
  scene.bodies[1] = {};
  scene.bodies[1].absent = scene.bodies[1].is_static = true;
  const World world(scene);
  EXPECT_EQ(find_body({1, 1}, "", world), std::nullopt);
  EXPECT_EQ(find_body({}, "", world), std::nullopt);
}

TEST(BodySearch, SaysWhyAndNamesTheNearest) {
  const World world(crates(3));
  Suggestions suggestions;
  EXPECT_EQ(unknown_body({7, 1}, "crate-0", world, suggestions).reason, "no body with id 7.1");
  EXPECT_EQ(unknown_body({}, "", world, suggestions).reason,
            "no body named: give its name or its id");
  EXPECT_EQ(unknown_body({}, "crat-2", world, suggestions).reason,
            "no body 'crat-2', did you mean 'crate-2'?");
}

TEST(BodySearch, LooksForNearNamesSoOftenAndNoMore) {
  const World world(crates(3));
  Suggestions suggestions;
  for (int n = 0; n < 8; ++n) EXPECT_NE(suggestions.nearest("crat-2", world), "");
  EXPECT_EQ(suggestions.nearest("crat-2", world), "");
  Suggestions of_many;
  const World large(crates(60'000));
  EXPECT_NE(of_many.nearest("crat-2", large), "");
  EXPECT_EQ(of_many.nearest("crat-2", large), "");
}

}  // namespace
}  // namespace poinsot
