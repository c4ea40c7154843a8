#include "poinsot/collision/broad_phase.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "support/allocation_counter.h"
#include "support/geometry.h"

namespace poinsot::test {
namespace {

using Pairs = std::vector<ColliderPair>;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// Bodies with a collider each, or two; some static, some half-spaces. They fly about in a ball.
struct Crowd {
  std::vector<Collider> colliders;
  std::vector<bool> moves;
  std::vector<Pose> poses;
  std::vector<Vec3> velocity;

  std::size_t size() const { return colliders.size(); }
  const HalfSpace* plane(std::size_t i) const {
    return std::get_if<HalfSpace>(&colliders[i].shape);
  }

  void add(const Shape& shape, int body, bool is_moving, const Pose& pose, const Vec3& v) {
    colliders.push_back(collider(shape, body));
    moves.push_back(is_moving);
    poses.push_back(pose);
    velocity.push_back(is_moving ? v : Vec3(Vec3::Zero()));
  }
  Aabb box(std::size_t i) const { return bounds(colliders[i], poses[i]); }

  void set(BroadPhase& broad_phase, std::size_t i) const {
    const auto k = static_cast<int>(i);
    if (plane(i)) {
      const Vec3 normal = poses[i].q * plane(i)->normal;
      broad_phase.set_plane(k, normal, plane(i)->offset + normal.dot(poses[i].c));
    } else {
      broad_phase.set(k, box(i));
    }
    broad_phase.set_moves(k, moves[i]);
  }
  void set_all(BroadPhase& broad_phase) const {
    for (std::size_t i = 0; i < size(); ++i) set(broad_phase, i);
  }
  BroadPhase broad_phase() const {
    BroadPhase result(colliders);
    set_all(result);
    return result;
  }

  bool meet(std::size_t i, std::size_t j, const std::vector<Aabb>& boxes) const {
    if (colliders[i].body == colliders[j].body || !(moves[i] || moves[j])) return false;
    if (plane(i) && plane(j)) return false;
    if (plane(j)) return meet(j, i, boxes);
    if (!plane(i)) return boxes[i].overlaps(boxes[j]);
    const Vec3 normal = poses[i].q * plane(i)->normal;
    const Aabb& b = boxes[j];
    double lowest = kInfinity;
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 x(corner & 1 ? b.low[0] : b.high[0], corner & 2 ? b.low[1] : b.high[1],
                   corner & 4 ? b.low[2] : b.high[2]);
      lowest = std::min(lowest, normal.dot(x - poses[i].c));
    }
    return lowest <= plane(i)->offset;
  }
  Pairs brute_force() const {
    Pairs pairs;
    std::vector<Aabb> boxes(size());
    for (std::size_t i = 0; i < size(); ++i)
      if (!plane(i)) boxes[i] = box(i);
    for (std::size_t i = 0; i < size(); ++i)
      for (std::size_t j = i + 1; j < size(); ++j)
        if (meet(i, j, boxes)) pairs.push_back({static_cast<int>(i), static_cast<int>(j)});
    return pairs;
  }
  void step(std::size_t i, double h) {
    poses[i].c += h * velocity[i];
    const Vec3 out = poses[i].c.normalized();
    if (poses[i].c.norm() > 6 && out.dot(velocity[i]) > 0)
      velocity[i] -= 2 * velocity[i].dot(out) * out;
  }
};

Crowd random_crowd(std::uint64_t seed, int bodies) {
  Random random(seed);
  Crowd crowd;
  for (int k = 0; k < bodies; ++k) {
    const bool is_moving = k % 5 != 0;
    const Pose pose{random.in_box(5), random.rotation()};
    const Vec3 v = random.log_uniform(0.01, 5) * random.direction();
    const double scale = k % 11 == 0 ? 3 : 0.4;
    crowd.add(random_shape(random.below(kHalfSpace), random, scale), k, is_moving, pose, v);
    if (k % 7 == 0)  // a second shape of the same body
      crowd.add(random_shape(kBox, random, 0.3), k, is_moving, pose, v);
  }
  const Pose tilted{{0, 0, -4}, random.rotation()};
  crowd.add(HalfSpace{Vec3::UnitZ(), 0}, bodies, false, tilted, Vec3::Zero());
  crowd.add(HalfSpace{Vec3::UnitX(), -4}, bodies + 1, false, {}, Vec3::Zero());
  crowd.add(HalfSpace{-Vec3::UnitX(), -5}, bodies + 2, true, {}, {-0.2, 0, 0});
  return crowd;
}

Pairs asked(BroadPhase& broad_phase) {
  const auto pairs = broad_phase.pairs();
  return {pairs.begin(), pairs.end()};
}

TEST(BroadPhase, FindsExactlyTheOverlapsHoweverManyBoxesAreSet) {
  for (const double share : {1.0, 0.3, 0.05}) {
    Crowd crowd = random_crowd(3, 120);
    Random random(4);
    BroadPhase broad_phase = crowd.broad_phase();
    std::size_t found = 0;
    for (int step = 0; step < 300; ++step) {
      ASSERT_EQ(asked(broad_phase), crowd.brute_force()) << share << " step " << step;
      found += broad_phase.pairs().size();
      for (std::size_t i = 0; i < crowd.size(); ++i) {
        if (random.uniform(0, 1) > share) continue;
        crowd.step(i, 0.02);
        crowd.set(broad_phase, i);
      }
    }
    EXPECT_GT(found, 300u * 100);
  }
}

TEST(BroadPhase, JumpsAreFollowedAtOnce) {
  Crowd crowd = random_crowd(5, 80);
  Random random(6);
  BroadPhase broad_phase = crowd.broad_phase();
  for (int step = 0; step < 200; ++step) {
    for (std::size_t i = 0; i < crowd.size(); ++i)
      if (random.below(4) == 0) {
        crowd.poses[i] = {random.in_box(5), random.rotation()};
        crowd.set(broad_phase, i);
      }
    ASSERT_EQ(asked(broad_phase), crowd.brute_force()) << "step " << step;
  }
}

TEST(BroadPhase, HowTheBoxesCameToBeDoesNotMatter) {
  Crowd crowd = random_crowd(9, 100);
  BroadPhase followed = crowd.broad_phase();
  BroadPhase asked_rarely = crowd.broad_phase();
  for (int step = 0; step < 400; ++step) {
    for (std::size_t i = 0; i < crowd.size(); ++i) crowd.step(i, 0.01);
    crowd.set_all(followed);
    followed.pairs();
    if (step % 50 != 49) continue;
    for (std::size_t i = crowd.size(); i-- > 0;) crowd.set(asked_rarely, i);
    BroadPhase fresh = crowd.broad_phase();
    const Pairs expected = asked(fresh);
    ASSERT_EQ(asked(followed), expected);
    ASSERT_EQ(asked(asked_rarely), expected);
  }
}

TEST(BroadPhase, ThoseThatCeaseToMovePairWithMovingOnesOnly) {
  Crowd crowd = random_crowd(11, 80);
  Random random(12);
  BroadPhase broad_phase = crowd.broad_phase();
  for (int step = 0; step < 200; ++step) {
    for (int k = 0; k < 1 + step % 30; ++k) {
      const auto i = static_cast<std::size_t>(random.below(static_cast<int>(crowd.size())));
      crowd.moves[i] = !crowd.moves[i];
      broad_phase.set_moves(static_cast<int>(i), crowd.moves[i]);
    }
    ASSERT_EQ(asked(broad_phase), crowd.brute_force()) << "step " << step;
  }
  for (std::size_t i = 0; i < crowd.size(); ++i) broad_phase.set_moves(static_cast<int>(i), false);
  EXPECT_TRUE(broad_phase.pairs().empty());
}

TEST(BroadPhase, AHalfSpaceMeetsWhatReachesUnderItsPlaneWhereverThatMoves) {
  Crowd crowd;
  for (int k = 0; k < 10; ++k)
    crowd.add(Sphere{0.5}, k, true, {{0, 0, 2.0 * k}, Quat::Identity()}, Vec3::Zero());
  crowd.add(HalfSpace{Vec3::UnitZ(), 0}, 10, false, {}, Vec3::Zero());
  BroadPhase broad_phase(crowd.colliders);
  for (int i = 0; i < 10; ++i) broad_phase.set(i, crowd.box(static_cast<std::size_t>(i)));
  EXPECT_EQ(broad_phase.pairs().size(), 10u) << "until its plane is set it holds all";
  EXPECT_TRUE(broad_phase.set_plane(10, Vec3::UnitZ(), 0));
  EXPECT_EQ(asked(broad_phase), (Pairs{{0, 10}}));
  broad_phase.set_plane(10, Vec3::UnitZ(), 3.5);
  EXPECT_EQ(asked(broad_phase), (Pairs{{0, 10}, {1, 10}, {2, 10}}));
  broad_phase.set_plane(10, -Vec3::UnitZ(), -18.5);
  EXPECT_EQ(asked(broad_phase), (Pairs{{9, 10}}));
  broad_phase.set_moves(9, false);
  EXPECT_TRUE(broad_phase.pairs().empty());
  broad_phase.set_moves(10, true);
  EXPECT_EQ(asked(broad_phase), (Pairs{{9, 10}}));
}

TEST(BroadPhase, BoxesThatAreNoneMeetNothingAndAreToldOf) {
  Crowd crowd;
  for (int k = 0; k < 4; ++k) crowd.add(Sphere{1}, k, true, {}, Vec3::Zero());
  crowd.add(HalfSpace{Vec3::UnitZ(), 0}, 4, false, {}, Vec3::Zero());
  BroadPhase broad_phase = crowd.broad_phase();
  const Pairs all = asked(broad_phase);
  EXPECT_EQ(all.size(), 10u);
  const Aabb good = crowd.box(0);
  for (const double bad : {kNan, kInfinity, -kInfinity})
    for (int k = 0; k < 6; ++k) {
      Aabb box = good;
      (k < 3 ? box.low : box.high)[k % 3] = bad;
      const bool empty = k < 3 ? bad > 1 : bad < -1;
      EXPECT_EQ(broad_phase.set(1, box), empty) << bad << " " << k;
      EXPECT_EQ(broad_phase.pairs().size(), 6u) << bad << " " << k;
      EXPECT_TRUE(broad_phase.set(1, good));
      EXPECT_EQ(asked(broad_phase), all);
    }
  EXPECT_TRUE(broad_phase.set(1, Aabb{})) << "an empty box is one";
  EXPECT_EQ(broad_phase.pairs().size(), 6u);
  EXPECT_FALSE(broad_phase.set_plane(4, {0, kNan, 1}, 0));
  EXPECT_FALSE(broad_phase.set_plane(4, Vec3::UnitZ(), kInfinity));
  EXPECT_EQ(broad_phase.pairs().size(), 3u);
}

TEST(BroadPhase, AHugeGroundMeetsTheSmallBodiesThatStandOnIt) {
  Crowd crowd;
  crowd.add(Box{{1e4, 1e4, 1}}, 0, false, {{0, 0, -0.5}, Quat::Identity()}, Vec3::Zero());
  for (int k = 1; k <= 400; ++k) {
    const double z = k % 2 ? 0.005 : 1.0;  // every other one stands, the rest fly
    crowd.add(Box{{0.01, 0.01, 0.01}}, k, true,
              {{0.02 * (k % 20), 0.02 * (k / 20), z}, Quat::Identity()}, Vec3::Zero());
  }
  BroadPhase broad_phase = crowd.broad_phase();
  EXPECT_EQ(broad_phase.pairs().size(), 200u);
}

TEST(BroadPhase, SettledMotionDoesNotAllocate) {
  if (!can_count_allocations()) GTEST_SKIP() << "a sanitizer owns malloc";
  Crowd crowd = random_crowd(9, 200);
  BroadPhase broad_phase = crowd.broad_phase();
  std::size_t during = 0;
  for (int step = 0; step < 800; ++step) {  // the tree is built anew many times
    for (std::size_t i = 0; i < crowd.size(); ++i) crowd.step(i, 0.02);
    const std::size_t before = allocations();
    for (std::size_t i = 0; i < crowd.size(); ++i)
      if (step % 2 == 0 || i % 20 == 0) crowd.set(broad_phase, i);
    broad_phase.pairs();
    if (step >= 50) during += allocations() - before;
  }
  EXPECT_EQ(during, 0u);
}

TEST(BroadPhase, OneBodyOrNoneHasNoPairs) {
  Crowd crowd;
  BroadPhase empty = crowd.broad_phase();
  EXPECT_TRUE(empty.pairs().empty());
  crowd.add(Sphere{1}, 0, true, {}, Vec3::Zero());
  BroadPhase one = crowd.broad_phase();
  EXPECT_TRUE(one.pairs().empty());
  crowd.add(HalfSpace{Vec3::UnitZ(), 0}, 1, false, {}, Vec3::Zero());
  BroadPhase with_plane = crowd.broad_phase();
  EXPECT_EQ(with_plane.pairs().size(), 1u);
}

}  // namespace
}  // namespace poinsot::test
