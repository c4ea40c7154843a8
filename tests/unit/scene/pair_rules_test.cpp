#include "poinsot/scene/pair_rules.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

namespace poinsot {
namespace {

Scene crowd(int count) {
  Scene scene;
  for (int i = 0; i < count; ++i) {
    BodyDef body;
    body.name = std::to_string(i);
    body.material = {0.1 * (i + 1), 1.0 / (i + 1)};
    scene.bodies.push_back(body);
  }
  return scene;
}

void expect_rule(const PairRule& rule, double friction, double restitution, bool collide) {
  EXPECT_EQ(rule.friction, friction);
  EXPECT_EQ(rule.restitution, restitution);
  EXPECT_EQ(rule.collide, collide);
}

TEST(PairRules, MaterialsSayItWithoutEntries) {
  const PairRules rules(crowd(3));
  expect_rule(rules.rule(0, 2), std::sqrt(0.1 * 0.1 * 3), 1, true);
  expect_rule(rules.rule(2, 1), std::sqrt(0.1 * 2 * 0.1 * 3), 0.5, true);
  EXPECT_TRUE(rules.collide(0, 1));
}

TEST(PairRules, AnEntryOverridesWhatItNamesAndNothingElse) {
  Scene scene = crowd(5);
  scene.pairs.push_back({.a = "3", .b = "1", .friction = 7, .restitution = {}, .where = {}});
  scene.pairs.push_back({.a = "0", .b = "4", .friction = {}, .restitution = 0, .where = {}});
  const PairRules rules(scene);
  for (const auto& [a, b] : {std::pair{1, 3}, {3, 1}}) expect_rule(rules.rule(a, b), 7, 0.5, true);
  for (const auto& [a, b] : {std::pair{4, 0}, {0, 4}})
    expect_rule(rules.rule(a, b), std::sqrt(0.1 * (0.1 * 5)), 0, true);
  // Both are named, but not together.
  expect_rule(rules.rule(1, 4), std::sqrt((0.1 * 2) * (0.1 * 5)), 0.5, true);
}

TEST(PairRules, FindsEachOfManyEntriesWhicheverWayItIsAsked) {
  constexpr int kCount = 40;
  Scene scene = crowd(kCount);
  const auto are_apart = [](int a, int b) { return (a * b) % 7 == 3; };
  for (int a = 0; a < kCount; ++a)
    for (int b = kCount - 1; b > a; --b)
      if (are_apart(a, b)) {
        PairDef pair;
        pair.a = std::to_string(a % 2 == 0 ? a : b);
        pair.b = std::to_string(a % 2 == 0 ? b : a);
        pair.collide = false;
        scene.pairs.push_back(pair);
      }
  ASSERT_GT(scene.pairs.size(), 50u);
  const PairRules rules(scene);
  for (int a = 0; a < kCount; ++a)
    for (int b = 0; b < kCount; ++b)
      if (a != b) {
        EXPECT_EQ(rules.collide(a, b), !are_apart(a, b)) << a << ' ' << b;
        EXPECT_EQ(rules.rule(a, b).collide, !are_apart(a, b)) << a << ' ' << b;
      }
}

TEST(PairRules, HoldForBodiesThatComeAndNoLongerForThoseThatWent) {
  Scene scene = crowd(3);
  PairDef pair;
  pair.a = std::to_string(2);
  pair.b = std::to_string(0);
  pair.collide = false;
  scene.pairs.push_back(pair);
  PairRules rules(scene);
  EXPECT_FALSE(rules.collide(0, 2));
  rules.remove(0);
  EXPECT_TRUE(rules.collide(0, 2));
  BodyDef other;
  other.name = std::to_string(9);
  other.material = {0.9, 0.7};
  rules.add(0, other);
  expect_rule(rules.rule(0, 2), std::sqrt(0.9 * scene.bodies[2].material.friction), 0.7, true);
  rules.add(3, scene.bodies[0]);
  EXPECT_FALSE(rules.collide(3, 2));
  EXPECT_TRUE(rules.collide(0, 2));

  scene.bodies[0] = {};  // a scene in which the name is nobody's
  scene.bodies[0].absent = true;
  EXPECT_TRUE(PairRules(scene).collide(0, 2));
}

}  // namespace
}  // namespace poinsot
