#include "poinsot/collision/contact_set.h"

#include <gtest/gtest.h>

#include "poinsot/collision/collision_layer.h"
#include "support/geometry.h"
#include "support/scene_builder.h"

namespace poinsot::test {
namespace {

constexpr double kStep = 0.005;  // [s]

// A box resting on a static floor, its lowest points `gap` above it.
Scene box_on_floor(double gap = 0) {
  Scene scene = empty_scene();
  scene.simulation.gravity = {0, 0, -9.81};
  scene.bodies = {floor(), box("box", {0, 0, 0.5 + gap})};
  return scene;
}

std::vector<Vec3> points(const ContactSet& set) {
  std::vector<Vec3> result;
  for (const Contact& c : set.contacts()) result.push_back(c.point);
  return result;
}

TEST(ContactSet, ABoxOnAFloorHasFourContactsFromFloorToBox) {
  const Scene scene = box_on_floor(1e-4);
  World world(scene);
  ContactSet set(scene, world);
  set.find(world, kStep);
  ASSERT_EQ(set.contacts().size(), 4u);
  for (const Contact& c : set.contacts()) {
    EXPECT_EQ(c.a, 0);
    EXPECT_EQ(c.b, 1);
    EXPECT_NEAR((c.normal - Vec3(0, 0, -1)).norm(), 0, 1e-15);  // from b, the box, to a
    EXPECT_NEAR(c.gap, 1e-4, 1e-15);
    EXPECT_EQ(c.normal_impulse, 0);
  }
}

TEST(ContactSet, MaterialsCombineByGeometricMeanAndMaximum) {
  Scene scene = box_on_floor();
  scene.bodies[0].material = {0.2, 0.1};
  scene.bodies[1].material = {0.8, 0.6};
  World world(scene);
  ContactSet set(scene, world);
  set.find(world, kStep);
  ASSERT_FALSE(set.contacts().empty());
  EXPECT_NEAR(set.contacts()[0].friction, 0.4, 1e-15);
  EXPECT_EQ(set.contacts()[0].restitution, 0.6);
}

TEST(ContactSet, ImpulsesFollowTheirPointsThroughMotion) {
  const Scene scene = box_on_floor();
  World world(scene);
  ContactSet set(scene, world);
  set.find(world, kStep);
  ASSERT_EQ(set.contacts().size(), 4u);
  for (std::size_t i = 0; i < 4; ++i)
    set.contacts()[i].normal_impulse = 1.0 + static_cast<double>(i);
  std::vector<Vec3> before = points(set);
  // Slides and turns, a hundred steps: every corner keeps its impulse.
  const Vec3 by(0.02, 0.01, 0);
  const Quat turn(Eigen::AngleAxisd(0.02, Vec3::UnitZ()));
  for (int step = 0; step < 100; ++step) {
    position(world.y, 1) += by;
    orientation(world.y, 1) = turn * orientation(world.y, 1);
    set.find(world, kStep);
    ASSERT_EQ(set.contacts().size(), 4u);
    const Vec3 center = position(world.y, 1);
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec3 expected = center + turn * (before[i] - (center - by));
      std::size_t nearest = 0;
      for (std::size_t k = 1; k < 4; ++k)
        if ((set.contacts()[k].point - expected).norm() <
            (set.contacts()[nearest].point - expected).norm())
          nearest = k;
      ASSERT_NEAR((set.contacts()[nearest].point - expected).norm(), 0, 1e-9);
      before[i] = set.contacts()[nearest].point;
      ASSERT_EQ(set.contacts()[nearest].normal_impulse, 1.0 + static_cast<double>(i))
          << "step " << step;
    }
  }
}

TEST(ContactSet, ImpulsesScaleWithTheStep) {
  const Scene scene = box_on_floor();
  World world(scene);
  ContactSet set(scene, world);
  set.find(world, kStep);
  for (Contact& c : set.contacts()) {
    c.normal_impulse = 2;
    c.friction_impulse = {1, 0, 0};
  }
  set.find(world, 0.5 * kStep);
  for (const Contact& c : set.contacts()) {
    EXPECT_NEAR(c.normal_impulse, 1, 1e-15);
    EXPECT_NEAR((c.friction_impulse - Vec3(0.5, 0, 0)).norm(), 0, 1e-15);
  }
}

// A box falling on a floor 1 m below it at v reaches it within h if v h + g h²/2 does.
TEST(ContactSet, BodiesMayMeetIfTheyCanReachEachOtherInTime) {
  constexpr double kFrame = 1.0 / 60;
  const auto may_meet = [](double speed, BodyDef ground_body) {
    Scene scene = empty_scene();
    BodyDef falling = box("box", {0, 0, 1.5});
    falling.linear_velocity = {0, 0, -speed};
    scene.bodies = {std::move(ground_body), falling};
    const World world(scene);
    ContactSet set(scene, world);
    return set.may_meet(world, kFrame);
  };
  EXPECT_TRUE(may_meet(61, floor()));
  EXPECT_TRUE(may_meet(61, ground()));
  // The margin of contacts, 2 % of the size, and the broad boxes of a cube are less than 5 %.
  EXPECT_FALSE(may_meet(55, floor()));
  EXPECT_FALSE(may_meet(55, ground()));
}

TEST(ContactSet, ASpinningBarMayMeetWhatItsEndReaches) {
  Scene scene = empty_scene();
  BodyDef bar = box("bar", {0, 0, 0.6}, {1, 0.1, 0.1});  // its end comes down to 0.1
  bar.angular_velocity = {0, 80, 0};
  scene.bodies = {floor(), bar};
  const World world(scene);
  ContactSet set(scene, world);
  EXPECT_TRUE(set.may_meet(world, 1.0 / 60));
}

TEST(ContactSet, AContactThatWasLostStartsAfresh) {
  const Scene scene = box_on_floor();
  World world(scene);
  ContactSet set(scene, world);
  set.find(world, kStep);
  for (Contact& c : set.contacts()) c.normal_impulse = 2;
  position(world.y, 1).z() += 1;
  set.find(world, kStep);
  EXPECT_TRUE(set.contacts().empty());
  position(world.y, 1).z() -= 1;
  set.find(world, kStep);
  ASSERT_EQ(set.contacts().size(), 4u);
  for (const Contact& c : set.contacts()) EXPECT_EQ(c.normal_impulse, 0);
}

TEST(ContactSet, ABodyMovedFarAlongKeepsNoForeignImpulse) {
  const Scene scene = box_on_floor();
  World world(scene);
  ContactSet set(scene, world);
  set.find(world, kStep);
  for (Contact& c : set.contacts()) c.normal_impulse = 2;
  // Offsets count from the box: sliding does not lose them, turning by an eighth does.
  orientation(world.y, 1) = Quat(Eigen::AngleAxisd(0.785398, Vec3::UnitZ()));
  set.find(world, kStep);
  for (const Contact& c : set.contacts()) EXPECT_EQ(c.normal_impulse, 0);
}

// The same scene with its bodies in another order has the same contacts.
TEST(ContactSet, OrderOfBodiesDoesNotMatter) {
  Random random(4);
  std::vector<BodyDef> bodies = {floor()};
  for (int k = 0; k < 12; ++k) {
    BodyDef body = box("body" + std::to_string(k), {0, 0, 0});
    body.shapes[0].shape = random_shape(k % kHalfSpace, random, 0.3);
    body.pose = {Vec3(random.uniform(-0.6, 0.6), random.uniform(-0.6, 0.6), random.uniform(0, 0.8)),
                 random.rotation()};
    bodies.push_back(body);
  }
  const auto contacts_of = [&](const std::vector<std::size_t>& order) {
    Scene scene = empty_scene();
    for (const std::size_t k : order) scene.bodies.push_back(bodies[k]);
    World world(scene);
    ContactSet set(scene, world);
    set.find(world, kStep);
    // Gap and height say enough to compare sets whatever their order.
    std::vector<std::pair<double, double>> found;
    for (const Contact& c : set.contacts()) found.emplace_back(c.gap, c.point.z());
    std::sort(found.begin(), found.end());
    return found;
  };
  std::vector<std::size_t> order(bodies.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto first = contacts_of(order);
  ASSERT_GT(first.size(), 15u);
  for (int trial = 0; trial < 5; ++trial) {
    for (std::size_t i = order.size() - 1; i > 0; --i)
      std::swap(order[i], order[static_cast<std::size_t>(random.below(static_cast<int>(i) + 1))]);
    const auto again = contacts_of(order);
    ASSERT_EQ(again.size(), first.size());
    for (std::size_t i = 0; i < first.size(); ++i) {
      EXPECT_NEAR(again[i].first, first[i].first, 1e-7);
      EXPECT_NEAR(again[i].second, first[i].second, 1e-5);
    }
  }
}

TEST(ContactSet, AFastBodyIsSeenBeforeItArrives) {
  Scene scene = empty_scene();
  scene.bodies = {floor(), box("bullet", {0, 0, 1}, Vec3(0.1, 0.1, 0.1))};
  scene.bodies[1].linear_velocity = {0, 0, -300};
  World world(scene);
  ContactSet set(scene, world);
  set.find(world, kStep);  // travels 1.5 m, is 0.95 m away
  ASSERT_EQ(set.contacts().size(), 4u);
  EXPECT_NEAR(set.contacts()[0].gap, 0.95, 1e-12);
}

// Overlaps --------------------------------------------------------------------------------------

TEST(FindOverlaps, NamesBothBodiesAndTheDepth) {
  Scene scene = empty_scene();
  scene.bodies = {floor(), box("lower", {0, 0, 0.5}), box("upper", {0.2, 0.1, 1.4})};
  scene.bodies[2].where = "scene.yaml:7:5";
  const std::vector<SceneFault> faults = find_overlaps(scene);
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].what,
            "body 'upper' overlaps 'lower' by 0.1 m; move it, or set allow_overlap: true");
  EXPECT_EQ(faults[0].where, "scene.yaml:7:5");
  EXPECT_EQ(faults[0].path, "bodies[2]");
}

TEST(FindOverlaps, TouchingIsNoOverlap) {
  Scene scene = empty_scene();
  scene.bodies = {floor(), box("lower", {0, 0, 0.5}), box("upper", {0.2, 0.1, 1.5})};
  EXPECT_TRUE(find_overlaps(scene).empty());
}

TEST(FindOverlaps, StaticBodiesMayOverlapEachOther) {
  Scene scene = empty_scene();
  scene.bodies = {floor("one"), floor("two")};
  EXPECT_TRUE(find_overlaps(scene).empty());
}

TEST(FindOverlaps, APairThatDoesNotCollideMayOverlap) {
  Scene scene = empty_scene();
  scene.bodies = {floor(), box("lower", {0, 0, 0.5}), box("upper", {0.2, 0.1, 1.4})};
  ASSERT_EQ(find_overlaps(scene).size(), 1u);
  PairDef pair;
  pair.a = "upper";
  pair.b = "lower";
  pair.collide = false;
  scene.pairs = {pair};
  EXPECT_TRUE(find_overlaps(scene).empty());
}

TEST(FindOverlaps, AKinematicBodyMayOverlapWhatForcesDoNotMove) {
  Scene scene = empty_scene();
  BodyDef belt = box("belt", {0, 0, 0.4});
  belt.is_kinematic = true;
  belt.mass_properties = {};
  scene.bodies = {floor(), belt};
  EXPECT_TRUE(find_overlaps(scene).empty());
  scene.bodies.push_back(box("load", {0, 0, 1.3}));
  const std::vector<SceneFault> faults = find_overlaps(scene);
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].what,
            "body 'load' overlaps 'belt' by 0.1 m; move it, or set allow_overlap: true");
}

TEST(FindOverlaps, HalfSpacesCount) {
  Scene scene = empty_scene();
  BodyDef ground;
  ground.name = "ground";
  ground.is_static = true;
  ground.shapes.push_back({HalfSpace{Vec3::UnitZ(), 0}, {}});
  scene.bodies = {box("box", {0, 0, 0.3}), ground};
  const std::vector<SceneFault> faults = find_overlaps(scene);
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_NE(faults[0].what.find("by 0.2 m"), std::string::npos) << faults[0].what;
}

TEST(FindOverlaps, ABodyOfSeveralShapesIsNamedOnceWithItsDeepest) {
  Scene scene = empty_scene();
  BodyDef pair = box("pair", {0, 0, 0.4});
  pair.shapes.push_back({Box{{1, 1, 1}}, {{2, 0, -0.2}, Quat::Identity()}});
  scene.bodies = {floor(), pair};
  const std::vector<SceneFault> faults = find_overlaps(scene);
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_NE(faults[0].what.find("by 0.3 m"), std::string::npos) << faults[0].what;
}

}  // namespace
}  // namespace poinsot::test
