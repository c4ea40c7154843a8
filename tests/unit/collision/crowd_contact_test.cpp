#include "poinsot/collision/crowd_contact.h"

#include <gtest/gtest.h>

#include "poinsot/collision/proximity.h"
#include "support/geometry.h"

namespace poinsot {
namespace {

constexpr double kMargin = 0.02;  // [m]
constexpr double kSize = 1;       // [m]

// A unit box that stands on another, 1 mm above it.
struct Boxes {
  Collider lower{0, Box{{1, 1, 1}}, Pose{}}, upper{1, Box{{1, 1, 1}}, Pose{}};
  Pose at_lower{Vec3(0, 0, 0), Quat::Identity()};
  Pose at_upper{Vec3(0.1, 0.05, 1.001), Quat::Identity()};
  CrowdContact contact;

  void measure() { measure_contact(upper, at_upper, lower, at_lower, kSize, kMargin, contact); }
  // The gap of a point as the crowd follows it, along the normal that goes with a [m].
  double gap(int k) const {
    const CrowdContact::Point& p = contact.points[static_cast<std::size_t>(k)];
    return (at_upper.q * contact.normal_in_a).dot(at_upper * p.on_a - at_lower * p.on_b);
  }
  void press() {
    for (int k = 0; k < contact.count; ++k) {
      CrowdContact::Point& p = contact.points[static_cast<std::size_t>(k)];
      p.normal_impulse = 1 + k;
      p.usual_impulse = 10 + k;
    }
    contact.friction_in_a = {0.5, 0, 0};
    contact.twist_impulse = 0.25;
  }
  std::uint64_t hash() const {
    Hash64 hash;
    contact.hash_into(hash);
    return hash.value();
  }
};

Quat turned(double angle, const Vec3& axis) {
  return Quat(Eigen::AngleAxisd(angle, axis.normalized()));
}

TEST(CrowdContact, LiesOnBothSurfaces) {
  Boxes pair;
  pair.at_upper.q = turned(0.3, Vec3::UnitZ());
  pair.measure();
  ASSERT_EQ(pair.contact.count, 4);
  for (int k = 0; k < 4; ++k) {
    const CrowdContact::Point& p = pair.contact.points[static_cast<std::size_t>(k)];
    EXPECT_NEAR(p.on_a.z(), -0.5, 1e-15);
    EXPECT_NEAR(p.on_b.z(), 0.5, 1e-15);
    EXPECT_NEAR(pair.gap(k), 1e-3, 1e-15);
  }
}

TEST(CrowdContact, KeepsItsPointsWhileThePairHardlyMoves) {
  Boxes pair;
  pair.measure();
  pair.press();
  const CrowdContact before = pair.contact;
  pair.at_upper.c += Vec3(2e-4, -2e-4, 1e-4);
  pair.at_upper.q = turned(2e-4, {1, 2, 3});
  pair.measure();
  EXPECT_EQ(pair.contact.measured.c, before.measured.c);
  ASSERT_EQ(pair.contact.count, before.count);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(pair.contact.points[k].on_a, before.points[k].on_a);
    EXPECT_EQ(pair.contact.points[k].on_b, before.points[k].on_b);
    EXPECT_EQ(pair.contact.points[k].normal_impulse, before.points[k].normal_impulse);
  }
  EXPECT_EQ(pair.contact.twist_impulse, before.twist_impulse);
}

TEST(CrowdContact, IsFoundAnewOnceThePairHasMoved) {
  Boxes pair;
  pair.measure();
  const Vec3 before = pair.contact.measured.c;
  pair.at_upper.c.x() += 0.01;
  pair.measure();
  EXPECT_NE(pair.contact.measured.c, before);
}

TEST(CrowdContact, DoesNotCareWhereThePairIsAsAWhole) {
  Boxes pair;
  pair.measure();
  const CrowdContact before = pair.contact;
  const Pose moved{{3, -4, 5}, turned(1.2, {3, 1, -2})};
  pair.at_lower = moved * pair.at_lower;
  pair.at_upper = moved * pair.at_upper;
  pair.measure();
  EXPECT_EQ(pair.contact.measured.c, before.measured.c);  // the pair has not moved in itself
  for (int k = 0; k < 4; ++k) EXPECT_NEAR(pair.gap(k), 1e-3, 1e-14);
}

// Kept points keep to their bodies: a turn by an angle errs by arm · angle² at most, a shift along
// the plane not at all.
TEST(CrowdContact, HasGapsRightToSecondOrderWhileItsPointsAreKept) {
  for (const double angle : {4e-4, 2e-4, 1e-4, 5e-5}) {
    Boxes pair;
    pair.measure();
    const CrowdContact kept = pair.contact;
    pair.at_upper.q = turned(angle, {1, 1, 0});
    pair.at_upper.c.x() += 0.1 * angle;
    pair.measure();
    ASSERT_EQ(pair.contact.measured.q.coeffs(), kept.measured.q.coeffs()) << angle;
    double changed = 0;
    for (int k = 0; k < 4; ++k) {
      // The truth: the corner of the upper box above the plane z = 0.5.
      const CrowdContact::Point& p = pair.contact.points[static_cast<std::size_t>(k)];
      const double truth = (pair.at_upper * p.on_a).z() - 0.5;
      EXPECT_NEAR(pair.gap(k), truth, std::sqrt(0.5) * angle * angle) << angle;
      changed = std::max(changed, std::abs(truth - 1e-3));
    }
    EXPECT_GT(changed, 0.3 * angle);  // to first order
  }
}

TEST(CrowdContact, RecallsImpulsesByFeature) {
  Boxes pair;
  pair.measure();
  pair.press();
  const CrowdContact before = pair.contact;
  pair.at_upper.c += Vec3(0.2, 0, 0);  // farther than a point may be to be recalled by its place
  pair.measure();
  ASSERT_EQ(pair.contact.count, 4);
  int recalled = 0;
  for (int k = 0; k < 4; ++k) {
    const CrowdContact::Point& now = pair.contact.points[static_cast<std::size_t>(k)];
    for (int j = 0; j < 4; ++j) {
      const CrowdContact::Point& then = before.points[static_cast<std::size_t>(j)];
      if (then.feature != now.feature) continue;
      EXPECT_EQ(now.normal_impulse, then.normal_impulse);
      EXPECT_EQ(now.usual_impulse, then.usual_impulse);
      ++recalled;
    }
  }
  EXPECT_GE(recalled, 2);
  EXPECT_EQ(pair.contact.friction_in_a, before.friction_in_a);
  EXPECT_EQ(pair.contact.twist_impulse, before.twist_impulse);
}

TEST(CrowdContact, RecallsImpulsesOfOtherFeaturesByTheirPlace) {
  Boxes pair;
  pair.measure();
  pair.press();
  for (CrowdContact::Point& p : pair.contact.points) p.feature = 0x3fffffffu;  // known no more
  const CrowdContact before = pair.contact;
  pair.at_upper.c += Vec3(0.01, 0, 0);
  pair.measure();
  ASSERT_EQ(pair.contact.count, 4);
  for (int k = 0; k < 4; ++k) {
    const CrowdContact::Point& now = pair.contact.points[static_cast<std::size_t>(k)];
    const CrowdContact::Point* nearest = nullptr;
    for (const CrowdContact::Point& p : before.points)
      if (nearest == nullptr || (p.on_b - now.on_b).norm() < (nearest->on_b - now.on_b).norm())
        nearest = &p;
    EXPECT_EQ(now.normal_impulse, nearest->normal_impulse);
    EXPECT_EQ(now.usual_impulse, nearest->usual_impulse);
  }
  for (CrowdContact::Point& p : pair.contact.points) p.feature = 0x3fffffffu;
  pair.at_upper.q = turned(2, Vec3::UnitZ());
  pair.at_upper.c += Vec3(0.3, 0.3, 0);  // farther than a tenth of the size
  pair.measure();
  double sum = 0;
  for (int k = 0; k < pair.contact.count; ++k)
    sum += pair.contact.points[static_cast<std::size_t>(k)].normal_impulse;
  EXPECT_LT(sum, 1 + 2 + 3 + 4);
}

TEST(CrowdContact, LosesAllItKnewWhenThePairParts) {
  Boxes pair;
  pair.measure();
  pair.press();
  pair.at_upper.c.z() = 1.5;
  pair.measure();
  EXPECT_EQ(pair.contact.count, 0);
  EXPECT_TRUE(pair.contact.friction_in_a.isZero(0));
  pair.at_upper.c.z() = 1.001;
  pair.measure();
  ASSERT_EQ(pair.contact.count, 4);
  for (const CrowdContact::Point& p : pair.contact.points) {
    EXPECT_EQ(p.normal_impulse, 0);
    EXPECT_EQ(p.usual_impulse, 0);
  }
  EXPECT_EQ(pair.contact.twist_impulse, 0);
}

// What is apart is not looked at again until it may have come nearer than the margin.
TEST(CrowdContact, NeverMissesAPairThatComesNear) {
  Boxes pair;
  for (int step = 0; step <= 2000; ++step) {
    pair.at_upper.c.z() = 1.1 - 1e-4 * step + 0.02;
    pair.measure();
    const double gap = pair.at_upper.c.z() - 1;
    if (gap < kMargin - 1e-12) {
      ASSERT_GT(pair.contact.count, 0) << gap;
    }
    if (gap > 1.5 * kMargin + 1e-12) {
      ASSERT_EQ(pair.contact.count, 0) << gap;
    }
    if (gap < -0.05) break;
  }
}

TEST(CrowdContact, OfTwoSpheresIsThatOfTheNarrowPhase) {
  test::Random random(7);
  for (int i = 0; i < 1000; ++i) {
    const Collider a(0, Sphere{0.3}, Pose{}), b(1, Sphere{0.7}, Pose{});
    const Pose at_a{random.in_box(2), random.rotation()};
    const Pose at_b{at_a.c + (1 + 0.02 * random.in_box(1).x()) * random.direction(),
                    random.rotation()};
    CrowdContact contact;
    measure_contact(a, at_a, b, at_b, 0.6, kMargin, contact);
    Manifold manifold;
    find_manifold(a, at_a, b, at_b, 1.5 * kMargin, manifold);
    ASSERT_EQ(contact.count, manifold.count);
    if (contact.count == 0) continue;
    const Vec3 normal = at_a.q * contact.normal_in_a;
    EXPECT_LT((normal - manifold.normal).norm(), 1e-14);
    const CrowdContact::Point& p = contact.points[0];
    EXPECT_NEAR(normal.dot(at_a * p.on_a - at_b * p.on_b), manifold.points[0].gap, 1e-14);
    EXPECT_LT((0.5 * (at_a * p.on_a + at_b * p.on_b) - manifold.points[0].point).norm(), 1e-14);
  }
}

TEST(CrowdContact, OfSpheresIsFoundAnewHoweverLittleTheyMove) {
  const Collider a(0, Sphere{0.5}, Pose{}), b(1, Sphere{0.5}, Pose{});
  CrowdContact contact;
  measure_contact(a, {Vec3(0, 0, 1), Quat::Identity()}, b, {Vec3::Zero(), Quat::Identity()}, kSize,
                  kMargin, contact);
  measure_contact(a, {Vec3(1e-6, 0, 1), Quat::Identity()}, b, {Vec3::Zero(), Quat::Identity()},
                  kSize, kMargin, contact);
  EXPECT_NEAR(contact.normal_in_a.x(), 1e-6, 1e-12);
}

TEST(CrowdContact, ForgetsAsIfItHadNeverBeenNear) {
  Boxes pair;
  pair.measure();
  pair.press();
  pair.contact.forget();
  EXPECT_EQ(pair.contact.count, 0);
  pair.measure();
  for (const CrowdContact::Point& p : pair.contact.points) EXPECT_EQ(p.normal_impulse, 0);
  EXPECT_TRUE(pair.contact.friction_in_a.isZero(0));
  EXPECT_EQ(pair.contact.twist_impulse, 0);
}

TEST(CrowdContact, HashesAllThatTheNextStepDependsOn) {
  Boxes pair, same;
  pair.measure();
  same.measure();
  EXPECT_EQ(pair.hash(), same.hash());
  const auto differs = [&](auto&& change) {
    Boxes other;
    other.measure();
    change(other.contact);
    return other.hash() != pair.hash();
  };
  EXPECT_TRUE(differs([](CrowdContact& c) { c.points[2].normal_impulse = 1e-300; }));
  EXPECT_TRUE(differs([](CrowdContact& c) { c.points[1].usual_impulse = 1e-300; }));
  EXPECT_TRUE(differs([](CrowdContact& c) { c.friction_in_a.y() = 1e-300; }));
  EXPECT_TRUE(differs([](CrowdContact& c) { c.twist_impulse = 1e-300; }));
  EXPECT_TRUE(differs([](CrowdContact& c) { c.measured.c.x() += 1e-12; }));
  EXPECT_TRUE(differs([](CrowdContact& c) { c.measured.q.z() += 1e-12; }));
  EXPECT_TRUE(differs([](CrowdContact& c) { c.margin *= 2; }));
}

}  // namespace
}  // namespace poinsot
