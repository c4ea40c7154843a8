#include "poinsot/collision/impact_search.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "poinsot/scene/strategies.h"
#include "poinsot/simulation/simulation_layer.h"
#include "support/allocation_counter.h"
#include "support/coursed_pair.h"

namespace poinsot::test {
namespace {

constexpr double kGravity = 9.81;
// Of times of the order of a second, from coordinates of the order of a metre at 1 m/s and more.
constexpr double kTimeRounding = 1e-14;

using Search = SearchResult (*)(const CoursePair&, const SearchSpan&, SearchMemory&, SearchWork&);
Search search_of(ImpactSearchKind kind) {
  if (kind == ImpactSearchKind::backtracking) return search_backtracking;
  return kind == ImpactSearchKind::continuous ? search_continuous : search_conservative;
}

SearchResult search(ImpactSearchKind kind, const CoursedPair& pair, SearchWork& work) {
  SearchMemory memory;
  return search_of(kind)(pair.pair(), pair.span(), memory, work);
}

class EverySearch : public testing::TestWithParam<ImpactSearchKind> {
 protected:
  SearchResult find(const BodyDef& a, const BodyDef& b, double end = 1,
                    const Vec3& gravity = Vec3::Zero()) {
    const CoursedPair pair(a, b, end, gravity);
    return search(GetParam(), pair, work_);
  }
  // Clearances [m] of passes that it decides, either way.
  std::vector<double> grazes() const {
    if (GetParam() == ImpactSearchKind::conservative) return {1e-6, -1e-6, 1e-9, -1e-9};
    if (GetParam() == ImpactSearchKind::continuous) return {1e-6, -1e-6};
    return {};
  }
  SearchWork work_;
};
INSTANTIATE_TEST_SUITE_P(ImpactSearch, EverySearch,
                         testing::Values(ImpactSearchKind::conservative,
                                         ImpactSearchKind::backtracking,
                                         ImpactSearchKind::continuous),
                         [](const auto& p) {
                           return std::string(
                               poinsot::name_of<ImpactSearchKind>(kImpactSearchNames, p.param));
                         });

BodyDef ball(double radius, const Vec3& at, const Vec3& v = Vec3::Zero()) {
  return moving(Sphere{radius}, at, v, Vec3::Zero());
}

BodyDef plate(double thickness) {
  BodyDef def = floor();
  def.shapes[0].shape = Box{{thickness, 1, 1}};
  def.pose.c.setZero();
  return def;
}

BodyDef cube(const Vec3& at, const Vec3& v, const Vec3& omega = Vec3::Zero(),
             const Quat& q = Quat::Identity()) {
  return moving(Box{{1, 1, 1}}, at, v, omega, q);
}

TEST_P(EverySearch, ABallThrownAtTheGroundMeetsItAtTheRootOfItsParabola) {
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const double radius = random.uniform(0.05, 0.5), height = random.uniform(0.01, 1.5);
    const Vec3 v = random.in_box(3);
    const double root = (v.z() + std::sqrt(v.z() * v.z() + 2 * kGravity * height)) / kGravity;
    const SearchResult r =
        find(ball(radius, {0, 0, height + radius}, v), ground(), 2, {0, 0, -kGravity});
    ASSERT_EQ(r.meeting, Meeting::impact);
    EXPECT_NEAR(r.time, root, kTimeRounding);
    EXPECT_EQ(r.normal, Vec3::UnitZ());
    EXPECT_NEAR((r.point - root * Vec3(v.x(), v.y(), 0)).norm(), 0, 1e-13);
  }
}

TEST_P(EverySearch, ABallSeesTheGroundFromEitherSideOfThePair) {
  const BodyDef falling = ball(0.1, {0, 0, 1});
  const SearchResult r = find(ground(), falling, 1, {0, 0, -kGravity});
  ASSERT_EQ(r.meeting, Meeting::impact);
  EXPECT_NEAR(r.time, std::sqrt(2 * 0.9 / kGravity), kTimeRounding);
  EXPECT_EQ(r.normal, -Vec3::UnitZ());
}

TEST_P(EverySearch, CrossedEdgesMeetWhereTheyCross) {
  const double quarter = std::numbers::pi / 4, diagonal = std::sqrt(0.5);
  const Quat along_x(Eigen::AngleAxisd(quarter, Vec3::UnitX()));
  const Quat along_y(Eigen::AngleAxisd(quarter, Vec3::UnitY()));
  const double gap = 0.75, v = 3;
  const SearchResult r =
      find(cube({0.2, 0.1, 2 * diagonal + gap}, {0, 0, -v}, Vec3::Zero(), along_x),
           cube(Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), along_y));
  ASSERT_EQ(r.meeting, Meeting::impact);
  EXPECT_NEAR(r.time, gap / v, 1e-12);
  EXPECT_NEAR((r.normal - Vec3::UnitZ()).norm(), 0, 1e-9);
  EXPECT_NEAR((r.point - Vec3(0, 0.1, diagonal)).norm(), 0, 1e-9);
}

TEST_P(EverySearch, ABulletDoesNotPassAThinPlate) {
  for (const double thickness : {1e-3, 5e-3, 0.05}) {
    for (int phase = 0; phase < 20; ++phase) {
      const double distance = 3 + 0.37 * phase, radius = 0.005, v = 1000;
      const SearchResult r =
          find(ball(radius, {-distance, 0.1, 0.2}, {v, 0, 0}), plate(thickness), 1.0 / 60);
      ASSERT_EQ(r.meeting, Meeting::impact);
      EXPECT_NEAR(r.time, (distance - radius - 0.5 * thickness) / v, 1e-12);
    }
  }
}

TEST_P(EverySearch, BallsThatGrazeMeetIfTheirPathsSaySo) {
  const double R = 0.2, v = 1;  // sum of the radii
  for (const double clearance : grazes()) {
    const double pass = R + clearance;
    const SearchResult r = find(ball(0.1, {-0.5, pass, 0}, {v, 0, 0}), ball(0.1, Vec3::Zero()));
    if (clearance > 0) {
      EXPECT_EQ(r.meeting, Meeting::none);
    } else {
      ASSERT_EQ(r.meeting, Meeting::impact);
      EXPECT_NEAR(r.time, (0.5 - std::sqrt((R - pass) * (R + pass))) / v, 1e-8);
    }
  }
}

TEST_P(EverySearch, ABallThrownUpToACeilingMeetsItIfItsParabolaSaysSo) {
  BodyDef ceiling = ground();
  ceiling.shapes[0].shape = HalfSpace{-Vec3::UnitZ(), -1.1};  // z ≥ 1.1
  for (const double clearance : grazes()) {
    const double rise = 1 - clearance;
    const double v = std::sqrt(2 * kGravity * rise);
    const SearchResult r =
        find(ball(0.1, Vec3::Zero(), {0.3, 0, v}), ceiling, 1, {0, 0, -kGravity});
    if (clearance > 0) {
      EXPECT_EQ(r.meeting, Meeting::none);
    } else {
      ASSERT_EQ(r.meeting, Meeting::impact);
      EXPECT_NEAR(r.time, (v - std::sqrt(v * v - 2 * kGravity)) / kGravity, 1e-8);
    }
  }
}

TEST_P(EverySearch, ASpinningPaddleMeetsABallAtItsAngle) {
  // A kinematic bar along x, turning about z at 2 rad/s; a ball at rest beside it, at y.
  BodyDef bar = floor("bar");
  bar.is_static = false;
  bar.is_kinematic = true;
  bar.shapes[0].shape = Box{{4, 0.2, 0.2}};
  bar.pose.c.setZero();
  bar.angular_velocity = {0, 0, 2};
  const SearchResult r = find(bar, ball(0.1, {1, 0.8, 0}));
  ASSERT_EQ(r.meeting, Meeting::impact);
  // The side of the bar is 0.1 from its axis, the ball's surface 0.1 from its centre.
  const double angle = std::atan2(0.8, 1.0) - std::asin(0.2 / std::hypot(1, 0.8));
  EXPECT_NEAR(r.time, angle / 2, 1e-12);
}

TEST_P(EverySearch, WhatApproachesInTouchMeetsAtOnce) {
  const SearchResult r = find(cube({0, 0, 0.5}, {0, 0, -1e-3}), floor(), 1, {0, 0, -kGravity});
  EXPECT_EQ(r.meeting, Meeting::impact);
  EXPECT_EQ(r.time, 0);
}

TEST_P(EverySearch, WhatLeavesComesBackAsItMust) {
  // v = 1e-4 m/s rises by 5e-10 m: more than touch.
  for (const double v : {3.0, 0.1, 1e-4}) {
    const SearchResult r = find(ball(0.5, {0, 0, 0.5}, {0, 0, v}), ground(), 1, {0, 0, -kGravity});
    ASSERT_EQ(r.meeting, Meeting::impact);
    EXPECT_NEAR(r.time, 2 * v / kGravity, 2e-15 / v);  // coordinates of 0.5 m
    const SearchResult box = find(cube({0, 0, 0.5}, {0.1, 0, v}), floor(), 1, {0, 0, -kGravity});
    ASSERT_EQ(box.meeting, Meeting::impact);
    EXPECT_NEAR(box.time, 2 * v / kGravity, 2e-14 / v);  // coordinates of 10 m
  }
}

TEST_P(EverySearch, WhatIsPressedTogetherRests) {
  const Vec3 g(0, 0, -kGravity), still = Vec3::Zero();
  EXPECT_EQ(find(ball(0.5, {0, 0, 0.5}), ground(), 1, g).meeting, Meeting::resting);
  EXPECT_EQ(find(ball(0.5, {0, 0, 0.5}, {3, 0, 0}), ground(), 1, g).meeting, Meeting::resting);
  EXPECT_EQ(find(cube({0, 0, 0.5}, still), ground(), 1, g).meeting, Meeting::resting);
  EXPECT_EQ(find(cube({0, 0, 0.5}, {5, 0, 0}), floor(), 1, g).meeting, Meeting::resting);
  EXPECT_EQ(find(cube({0, 0, 0.5}, {0, 0, 1e-7}), floor(), 1, g).meeting, Meeting::resting);
  EXPECT_EQ(find(cube({0, 0, 0.5}, still), floor(), 1, g).time, 0);
}

TEST_P(EverySearch, WhatTouchesWithoutPressingMeetsNothing) {
  const Vec3 g(0, 0, -kGravity), still = Vec3::Zero();
  EXPECT_EQ(find(ball(0.5, {0, 0, 0.5}), ball(0.5, {0, 0, -0.5})).meeting, Meeting::none);
  EXPECT_EQ(find(ball(0.5, {0, 0, 0.5}), ball(0.5, {0, 0, -0.5}), 1, g).meeting, Meeting::none);
  EXPECT_EQ(find(cube({0, 0, 0.5}, still), cube({0, 0, -0.5}, still), 1, g).meeting, Meeting::none);
  EXPECT_EQ(find(ball(0.5, {0, 0, 0.5}, {1, 0, 0}), ball(0.5, {0, 0, -0.5})).meeting,
            Meeting::none);
}

TEST_P(EverySearch, WhatOverlapsAndPartsIsLetOut) {
  EXPECT_EQ(find(cube({0, 0, 0.9}, {0, 0, 1}), cube(Vec3::Zero(), Vec3::Zero())).meeting,
            Meeting::none);
}

TEST_P(EverySearch, AbsurdInputEndsInBoundedWork) {
  find(cube({0, 0, 1.2}, {0, 0, -0.01}, {1e6, 1, 0}), cube(Vec3::Zero(), Vec3::Zero()));
  find(cube({1e5, 1e5, 2}, {0, 0, -3}, {1, 2, 3}), cube({1e5, 1e5, 0}, Vec3::Zero()));
  find(cube(Vec3::Zero(), Vec3::Zero()), cube(Vec3::Zero(), Vec3::Zero()));
  find(ball(1, Vec3::Zero()), ball(1, Vec3::Zero()));
  find(moving(Box{{1e-4, 1, 1}}, {0.5, 0, 0}, {-1e4, 0, 0}, {300, 0, 0}), plate(1e-6));
  EXPECT_LE(work_.poses, 5 * (kMostPoses + 200));
}

TEST_P(EverySearch, ABallFarFromTheOriginMeetsTheBoxItAimsAt) {
  const Vec3 far(1e5, -1e5, 1e5);
  const SearchResult r = find(ball(0.5, far + Vec3(0, 0, 2), {0, 0, -2}), cube(far, Vec3::Zero()));
  ASSERT_EQ(r.meeting, Meeting::impact);
  EXPECT_NEAR(r.time, 0.5, 4e-16 * far.norm());  // an ulp of the coordinates
}

TEST_P(EverySearch, NeverAllocates) {
  if (!can_count_allocations()) GTEST_SKIP() << "a sanitizer owns malloc";
  Random random(5);
  const FlyBy f = random_fly_by(kConvex, kCylinder, 10, random);
  const CoursedPair pair(f.a, f.b, 1, f.gravity);
  search(GetParam(), pair, work_);  // thread-local buffers of the narrow phase
  const std::size_t before = allocations();
  search(GetParam(), pair, work_);
  EXPECT_EQ(allocations(), before);
}

// Against dense sampling: what is found, is found right.
struct Tally {
  int hits = 0, missed = 0, late = 0, false_alarms = 0, unsure = 0;
  double depth = 0, worst_time = 0;  // [m] [s]
  SearchWork work;

  void add(ImpactSearchKind kind, const CoursedPair& pair, double dt, double time_tolerance) {
    if (pair.gap(0) <= 1e-6) return;
    const Sampled truth = dense_samples(pair, dt);
    const SearchResult r = search(kind, pair, work);
    unsure += r.meeting == Meeting::unsure;
    if (r.meeting == Meeting::impact) {
      ++hits;
      const double gap = pair.gap(r.time);
      depth = std::max(depth, -gap);
      // The reference may miss a root in a shallow dip; it is one if the gap is 0 there.
      if (!truth.meets) false_alarms += gap > 1e-9;
      if (truth.meets) late += r.time > *truth.meets + time_tolerance;
      if (truth.meets) worst_time = std::max(worst_time, std::abs(r.time - *truth.meets));
    } else if (r.meeting != Meeting::unsure) {
      missed += truth.meets.has_value();
    }
  }
};

class FlyBys : public testing::TestWithParam<std::tuple<int, int>> {};
INSTANTIATE_TEST_SUITE_P(ImpactSearch, FlyBys,
                         testing::Combine(testing::Range<int>(kSphere, kHalfSpace),
                                          testing::Range<int>(kSphere, kHalfSpace + 1)),
                         [](const auto& p) {
                           return name_of(std::get<0>(p.param)) + "_" +
                                  name_of(std::get<1>(p.param));
                         });

TEST_P(FlyBys, TheOneSidedSearchMissesNoFlyBy) {
  const auto [kind_a, kind_b] = GetParam();
  Random random(100 + static_cast<std::uint64_t>(10 * kind_a + kind_b));
  Tally tally;
  for (int i = 0; i < 40; ++i) {
    const FlyBy f = random_fly_by(kind_a, kind_b, i % 4 == 0 ? 300 : 10, random);
    tally.add(ImpactSearchKind::conservative, CoursedPair(f.a, f.b, 1, f.gravity), 2e-4, 1e-8);
  }
  EXPECT_GT(tally.hits, 10);
  EXPECT_EQ(tally.missed, 0);
  EXPECT_EQ(tally.late, 0);
  EXPECT_EQ(tally.false_alarms, 0);
  EXPECT_EQ(tally.unsure, 0);
  EXPECT_LT(tally.depth, 1e-9);  // what the narrow phase knows of curved shapes that touch
}

TEST(ConservativeSearch, SeesTheFirstDipOfASpinningRod) {
  Random random(2);
  Tally tally;
  for (int i = 0; i < 100; ++i) {
    const double spin = random.uniform(20, 150);
    const Quat q(Eigen::AngleAxisd(random.uniform(0, 3), Vec3::UnitX()));
    // Its centre turns back inside its reach of half a metre and a little.
    const double lowest = random.uniform(0.3, 0.505), v = random.uniform(1, 3);
    const BodyDef rod = moving(Capsule{0.02, 1}, {0, 0, lowest + 0.4}, {0, 0, -v},
                               Vec3(spin, random.uniform(-1, 1), 0), q);
    tally.add(ImpactSearchKind::conservative,
              CoursedPair(rod, ground(), 1, {0, 0, 0.5 * v * v / 0.4}), 1e-5, 1e-9);
  }
  EXPECT_GT(tally.hits, 50);
  EXPECT_EQ(tally.missed + tally.late + tally.false_alarms + tally.unsure, 0);
  EXPECT_LT(tally.depth, 1e-14);
}

TEST(ConservativeSearch, FollowsAFastSpinningBoxToTheGroundInFewPoses) {
  Random random(3);
  Tally tally;
  for (int i = 0; i < 100; ++i) {
    const BodyDef box = moving(Box{{0.5, 0.3, 0.1}}, {0, 0, 0.6}, random.in_box(1),
                               random.uniform(50, 300) * random.direction(), random.rotation());
    tally.add(ImpactSearchKind::conservative, CoursedPair(box, ground(), 1, {0, 0, -kGravity}),
              1e-5, 1e-9);
  }
  EXPECT_GT(tally.hits, 95);
  EXPECT_EQ(tally.missed + tally.late + tally.false_alarms + tally.unsure, 0);
  EXPECT_LT(tally.depth, 1e-14);
  EXPECT_LT(static_cast<double>(tally.work.poses), 60.0 * static_cast<double>(tally.work.searches));
}

TEST(ConservativeSearch, IsNeverLateForTwoTumblingBoxes) {
  Random random(4);
  Tally tally;
  for (int i = 0; i < 100; ++i) {
    const auto omega = [&] { return Vec3(random.uniform(0, 80) * random.direction()); };
    const BodyDef a = moving(Box{{0.5, 0.3, 0.1}}, {0, 0, 0.8},
                             Vec3(random.uniform(-0.5, 0.5), 0, -3), omega(), random.rotation());
    const BodyDef b =
        moving(Box{{0.4, 0.4, 0.2}}, Vec3::Zero(), Vec3::Zero(), omega(), random.rotation());
    tally.add(ImpactSearchKind::conservative, CoursedPair(a, b, 1), 2.5e-5, 1e-7);
  }
  EXPECT_GT(tally.hits, 50);
  EXPECT_EQ(tally.missed + tally.late + tally.false_alarms + tally.unsure, 0);
  EXPECT_LT(tally.depth, 1e-12);
}

TEST(ConservativeSearch, ABouncingBallIsTimedRightDownToItsRest) {
  const double height = 10, e = 0.8;
  double v = std::sqrt(2 * kGravity * height), exact = v / kGravity, t = 0, z = height;
  double up = 0;  // [m/s] after the last bounce
  SearchMemory memory;
  SearchWork work;
  int bounces = 0;
  for (;; ++bounces) {
    const CoursedPair pair(ball(0.1, {0, 0, z + 0.1}, {0, 0, up}), ground(), 15, {0, 0, -kGravity});
    const SearchResult r = search_conservative(pair.pair(), pair.span(), memory, work);
    if (r.meeting != Meeting::impact) {
      EXPECT_EQ(r.meeting, Meeting::resting);
      break;
    }
    t += r.time;
    EXPECT_NEAR(t, exact, 1e-10);
    v *= e;
    exact += 2 * v / kGravity;
    up = v;
    z = 0;
  }
  EXPECT_LT(v, 8e-5);
  EXPECT_LT(work.poses, 4 * work.searches);
}

TEST(ConservativeSearch, ExchangedPairsMeetAtTheSameTimeWithTheOppositeNormal) {
  Random random(6);
  for (int i = 0; i < 100; ++i) {
    const FlyBy f =
        random_fly_by(random.below(kHalfSpace), random.below(kHalfSpace + 1), 30, random);
    SearchWork work;
    const SearchResult r =
        search(ImpactSearchKind::conservative, CoursedPair(f.a, f.b, 1, f.gravity), work);
    const SearchResult s =
        search(ImpactSearchKind::conservative, CoursedPair(f.b, f.a, 1, f.gravity), work);
    EXPECT_EQ(r.meeting, s.meeting);
    EXPECT_NEAR(r.time, s.time, 1e-9);
    if (r.meeting == Meeting::impact) {
      EXPECT_LT((r.normal + s.normal).norm(), 1e-4);
    }
  }
}

TEST(BacktrackingSearch, MissesAPassBetweenItsSamples) {
  SearchWork work;
  // They touch for 1.3e-3 s; samples here are 0.1 s apart.
  const CoursedPair pair(ball(0.1, {-0.55, 0.2 - 1e-6, 0}, {1, 0, 0}), ball(0.1, Vec3::Zero()), 1);
  EXPECT_EQ(search(ImpactSearchKind::backtracking, pair, work).meeting, Meeting::none);
}

TEST_P(EverySearch, ADrivenBallMeetsTheGroundAtTheRootOfItsParabola) {
  BodyDef ball = body("ball", Sphere{0.1}, {0, 0, 1.1});
  Scene s = scene({ball, ground()});
  SimulationLayer layer(s);
  SimulationWorker worker(layer.world());
  const double mass = ball.mass_properties.mass, push = 3;
  layer.world().held[0].in_W.force = {0, 0, -push * mass};
  layer.begin(1);
  const Course down = layer.course(0, 0, 1, false, worker), still = Course::still({}, 0, 1);
  ASSERT_EQ(down.kind(), Course::Kind::driven);
  const Collider a(0, Sphere{0.1}, {}), b(1, HalfSpace{}, {});
  SearchMemory memory;
  const SearchResult r = search_of(GetParam())({a, down, b, still}, {0, 1, 1e-11}, memory, work_);
  ASSERT_EQ(r.meeting, Meeting::impact);
  EXPECT_NEAR(r.time, std::sqrt(2 / (push - s.simulation.gravity.z())), 1e-13);
}

}  // namespace
}  // namespace poinsot::test
