#include "poinsot/cli/roster.h"

#include <gtest/gtest.h>

#include "poinsot/base/error.h"
#include "unit/cli/sample.h"

namespace poinsot {
namespace {

std::string error_of(const std::vector<std::string>& wanted) {
  try {
    Roster roster(sample::bodies(), wanted);
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Roster, ShowsAllBodiesUnlessSomeAreNamed) {
  const Roster roster(sample::bodies(), {});
  ASSERT_NE(roster.shown(sample::kBox), nullptr);
  EXPECT_EQ(*roster.shown(sample::kBox), "box");
  EXPECT_EQ(*roster.shown(sample::kBall), "big ball");
}

TEST(Roster, NamesEveryBodyOfTheSceneAndNoOther) {
  const Roster roster(sample::bodies(), {"big ball"});
  ASSERT_NE(roster.name(sample::kTable), nullptr);
  EXPECT_EQ(*roster.name(sample::kTable), "table");
  EXPECT_EQ(*roster.name(sample::kBox), "box");
  EXPECT_EQ(roster.name({99, 1}), nullptr);
  EXPECT_EQ(roster.session(), 7u);
}

TEST(Roster, ShowsTheNamedOnly) {
  const Roster roster(sample::bodies(), {"big ball"});
  EXPECT_EQ(roster.shown(sample::kBox), nullptr);
  EXPECT_NE(roster.shown(sample::kBall), nullptr);
}

TEST(Roster, SuggestsTheNearestBody) {
  EXPECT_EQ(error_of({"bax"}), "no body 'bax', did you mean 'box'?");
}

TEST(Roster, SaysWhyAStaticBodyCannotBeWatched) {
  EXPECT_EQ(error_of({"table"}), "body 'table' is static: it has no stream of poses");
}

TEST(Roster, DescribesASnapshotOfItsOwnDaemonOnly) {
  const Roster roster(sample::bodies(), {"box"});
  PoseSnapshot poses = sample::poses();
  EXPECT_TRUE(roster.describes(poses));
  poses.bodies.front().id.generation = 2;  // another body in the same slot
  EXPECT_FALSE(roster.describes(poses));
  poses = sample::poses();
  poses.session = 8;
  EXPECT_FALSE(roster.describes(poses));
}

}  // namespace
}  // namespace poinsot
