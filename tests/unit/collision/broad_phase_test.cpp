#include "poinsot/collision/broad_phase.h"

#include <set>

#include <gtest/gtest.h>

#include "support/allocation_counter.h"
#include "support/geometry.h"

namespace poinsot::test {
namespace {

// Bodies with a collider each, or two; some static, some half-spaces.
struct Crowd {
  std::vector<Collider> colliders;
  std::vector<bool> moves;
  std::vector<Pose> poses;
  std::vector<Vec3> velocity;

  void add(const Shape& shape, int body, bool is_moving, const Pose& pose, const Vec3& v) {
    colliders.push_back(collider(shape, body));
    moves.push_back(is_moving);
    poses.push_back(pose);
    velocity.push_back(is_moving ? v : Vec3(Vec3::Zero()));
  }
  std::vector<Aabb> boxes() const {
    std::vector<Aabb> result(colliders.size());
    for (std::size_t i = 0; i < colliders.size(); ++i)
      if (!std::isinf(colliders[i].size)) result[i] = bounds(colliders[i], poses[i]);
    return result;
  }
  bool may_pair(std::size_t i, std::size_t j) const {
    return colliders[i].body != colliders[j].body && (moves[i] || moves[j]);
  }
  std::set<ColliderPair> overlapping() const {
    const std::vector<Aabb> box = boxes();
    std::set<ColliderPair> pairs;
    for (std::size_t i = 0; i < box.size(); ++i)
      for (std::size_t j = i + 1; j < box.size(); ++j) {
        const bool plane = std::isinf(colliders[i].size) || std::isinf(colliders[j].size);
        if (may_pair(i, j) && (plane || box[i].overlaps(box[j])))
          pairs.insert({static_cast<int>(i), static_cast<int>(j)});
      }
    return pairs;
  }
  void step(double h) {
    for (std::size_t i = 0; i < poses.size(); ++i) {
      poses[i].c += h * velocity[i];
      if (poses[i].c.norm() > 6)
        velocity[i] -= 2 * velocity[i].dot(poses[i].c.normalized()) * poses[i].c.normalized();
    }
  }
};

Crowd random_crowd(std::uint64_t seed, int bodies) {
  Random random(seed);
  Crowd crowd;
  for (int k = 0; k < bodies; ++k) {
    const bool is_moving = k % 5 != 0;
    const Pose pose{random.in_box(5), random.rotation()};
    const Vec3 v = random.log_uniform(0.01, 5) * random.direction();
    crowd.add(random_shape(random.below(kHalfSpace), random, 0.4), k, is_moving, pose, v);
    if (k % 7 == 0)  // a second shape of the same body
      crowd.add(random_shape(kBox, random, 0.3), k, is_moving, pose, v);
  }
  crowd.add(HalfSpace{Vec3::UnitZ(), -5}, bodies, false, {}, Vec3::Zero());
  crowd.add(HalfSpace{-Vec3::UnitZ(), -5}, bodies + 1, false, {}, Vec3::Zero());
  return crowd;
}

TEST(BroadPhase, FindsEveryOverlapThroughHundredsOfSteps) {
  for (const double reach_steps : {0.0, 1.0, 4.0}) {
    Crowd crowd = random_crowd(3, 60);
    BroadPhase broad_phase(crowd.colliders, crowd.moves);
    std::vector<double> reach(crowd.colliders.size());
    const double h = 0.01;
    std::size_t found = 0, wanted = 0;
    for (int step = 0; step < 600; ++step) {
      for (std::size_t i = 0; i < reach.size(); ++i)
        reach[i] = reach_steps * h * crowd.velocity[i].norm();
      const auto pairs = broad_phase.pairs(crowd.boxes(), reach);
      ASSERT_TRUE(std::is_sorted(pairs.begin(), pairs.end()));
      ASSERT_EQ(std::adjacent_find(pairs.begin(), pairs.end()), pairs.end());
      const std::set<ColliderPair> all = crowd.overlapping();
      for (const ColliderPair& pair : all)
        ASSERT_TRUE(std::binary_search(pairs.begin(), pairs.end(), pair))
            << "step " << step << " pair " << pair.a << " " << pair.b;
      for (const ColliderPair& pair : pairs)
        ASSERT_TRUE(
            crowd.may_pair(static_cast<std::size_t>(pair.a), static_cast<std::size_t>(pair.b)));
      if (reach_steps == 0) {
        ASSERT_EQ(pairs.size(), all.size()) << "tight boxes have no idle pairs";
      }
      found += pairs.size();
      wanted += all.size();
      crowd.step(h);
    }
    EXPECT_LT(static_cast<double>(found), 2.0 * static_cast<double>(wanted));
  }
}

TEST(BroadPhase, JumpsAreFollowedAtOnce) {
  Crowd crowd = random_crowd(5, 40);
  Random random(6);
  BroadPhase broad_phase(crowd.colliders, crowd.moves);
  const std::vector<double> reach(crowd.colliders.size(), 0.5);
  for (int step = 0; step < 200; ++step) {
    for (std::size_t i = 0; i < crowd.poses.size(); ++i)
      if (crowd.moves[i] && random.below(4) == 0)
        crowd.poses[i] = {random.in_box(5), random.rotation()};
    const auto pairs = broad_phase.pairs(crowd.boxes(), reach);
    for (const ColliderPair& pair : crowd.overlapping())
      ASSERT_TRUE(std::binary_search(pairs.begin(), pairs.end(), pair)) << "step " << step;
  }
}

TEST(BroadPhase, TheSameMotionGivesTheSamePairs) {
  std::vector<std::vector<ColliderPair>> first;
  for (int run = 0; run < 2; ++run) {
    Crowd crowd = random_crowd(9, 50);
    BroadPhase broad_phase(crowd.colliders, crowd.moves);
    const std::vector<double> reach(crowd.colliders.size(), 0.05);
    for (std::size_t step = 0; step < 200; ++step) {
      const auto pairs = broad_phase.pairs(crowd.boxes(), reach);
      if (run == 0) {
        first.emplace_back(pairs.begin(), pairs.end());
      } else {
        ASSERT_TRUE(std::equal(pairs.begin(), pairs.end(), first[step].begin(), first[step].end()));
      }
      crowd.step(0.01);
    }
  }
}

TEST(BroadPhase, AHugeGroundMeetsTheSmallBodiesThatStandOnIt) {
  Crowd crowd;
  crowd.add(Box{{1e4, 1e4, 1}}, 0, false, {{0, 0, -0.5}, Quat::Identity()}, Vec3::Zero());
  for (int k = 1; k <= 400; ++k) {
    const double z = k % 2 ? 0.005 : 1.0;  // every other one stands, the rest fly
    crowd.add(Box{{0.01, 0.01, 0.01}}, k, true,
              {{0.02 * (k % 20), 0.02 * (k / 20), z}, Quat::Identity()}, Vec3::Zero());
  }
  BroadPhase broad_phase(crowd.colliders, crowd.moves);
  const std::vector<double> reach(crowd.colliders.size(), 0.001);
  const auto pairs = broad_phase.pairs(crowd.boxes(), reach);
  EXPECT_EQ(pairs.size(), 200u);
}

TEST(BroadPhase, SettledMotionDoesNotAllocate) {
  if (!can_count_allocations()) GTEST_SKIP() << "a sanitizer owns malloc";
  Crowd crowd = random_crowd(9, 200);
  for (Vec3& v : crowd.velocity) v *= 0.02;
  BroadPhase broad_phase(crowd.colliders, crowd.moves);
  const std::vector<double> reach(crowd.colliders.size(), 1e-3);
  std::size_t before = 0;
  for (int step = 0; step < 400; ++step) {
    const std::vector<Aabb> boxes = crowd.boxes();
    const std::size_t outside = allocations();
    broad_phase.pairs(boxes, reach);
    if (step >= 50) before += allocations() - outside;
    crowd.step(0.01);
  }
  EXPECT_EQ(before, 0u);
}

TEST(BroadPhase, OneBodyOrNoneHasNoPairs) {
  Crowd crowd;
  BroadPhase empty(crowd.colliders, crowd.moves);
  EXPECT_TRUE(empty.pairs({}, {}).empty());
  crowd.add(Sphere{1}, 0, true, {}, Vec3::Zero());
  BroadPhase one(crowd.colliders, crowd.moves);
  EXPECT_TRUE(one.pairs(crowd.boxes(), std::vector<double>{0.1}).empty());
  crowd.add(HalfSpace{Vec3::UnitZ(), 0}, 1, false, {}, Vec3::Zero());
  BroadPhase with_plane(crowd.colliders, crowd.moves);
  EXPECT_EQ(with_plane.pairs(crowd.boxes(), std::vector<double>{0.1, 0}).size(), 1u);
}

}  // namespace
}  // namespace poinsot::test
