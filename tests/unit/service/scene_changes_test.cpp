#include "poinsot/service/scene_changes.h"

#include <gtest/gtest.h>

#include "poinsot/presentation/presentation_layer.h"
#include "poinsot/scene/fragment.h"
#include "support/scene_builder.h"

namespace poinsot {
namespace {

Scene two_spheres() {
  return test::scene(
      {test::free_body("a", 1, Vec3(1, 1, 1)), test::free_body("b", 1, Vec3(1, 1, 1))});
}

Order spawn(const std::string& name) {
  Order order;
  order.control.action = ControlAction::spawn;
  order.fragment = std::make_shared<const std::vector<BodyDef>>(
      parse_fragment("bodies: [{name: " + name + ", shape: {sphere: 1}, density: 1, position: [" +
                     std::to_string(5 * (name[0] - 'a')) + ", 9, 9]}]"));
  return order;
}

Order remove(const std::string& name) {
  Order order;
  order.control.action = ControlAction::remove;
  order.control.body_name = name;
  return order;
}

std::vector<std::string> names(const SceneChange& change) {
  std::vector<std::string> list;
  for (const BodyInfo& body : change.added) list.push_back(body.name);
  return list;
}

TEST(SceneChanges, AtFirstAllBodiesAreNew) {
  PresentationLayer layer(two_spheres());
  SceneChanges changes;
  const SceneChange first = changes.since_last(layer);
  EXPECT_EQ(names(first), (std::vector<std::string>{"a", "b"}));
  EXPECT_TRUE(first.removed.empty());
  EXPECT_TRUE(changes.since_last(layer).empty());
  layer.advance_frame();
  EXPECT_TRUE(changes.since_last(layer).empty());
}

TEST(SceneChanges, TellWhatCameAndWent) {
  PresentationLayer layer(two_spheres());
  SceneChanges changes;
  const BodyId a = changes.since_last(layer).added[0].id;
  ASSERT_EQ(layer.obey(spawn("c")).code, ResultCode::ok);
  const SceneChange came = changes.since_last(layer);
  EXPECT_EQ(names(came), std::vector<std::string>{"c"});
  EXPECT_EQ(came.added[0].revision, layer.scene_revision());
  ASSERT_EQ(layer.obey(remove("a")).code, ResultCode::ok);
  const SceneChange went = changes.since_last(layer);
  EXPECT_TRUE(went.added.empty());
  EXPECT_EQ(went.removed, std::vector<BodyId>{a});
  // In the place of a: what was there is gone, what is there is new.
  ASSERT_EQ(layer.obey(spawn("d")).code, ResultCode::ok);
  const SceneChange again = changes.since_last(layer);
  ASSERT_EQ(names(again), std::vector<std::string>{"d"});
  EXPECT_EQ(again.added[0].id.slot, a.slot);
  EXPECT_NE(again.added[0].id.generation, a.generation);
}

// The same id may be another body in the scene of another epoch.
TEST(SceneChanges, AResetToAnotherSceneTellsAllBodiesAnew) {
  PresentationLayer layer(two_spheres());
  SceneChanges changes;
  changes.since_last(layer);
  ASSERT_EQ(layer.obey(spawn("c")).code, ResultCode::ok);
  const BodyId c = changes.since_last(layer).added[0].id;
  layer.reset();
  const SceneChange back = changes.since_last(layer);
  EXPECT_EQ(names(back), (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(back.removed, std::vector<BodyId>{c});
  layer.reset();
  EXPECT_TRUE(changes.since_last(layer).empty());
}

}  // namespace
}  // namespace poinsot
