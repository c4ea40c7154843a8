#include "poinsot/study/path.h"

#include <cmath>

#include <gtest/gtest.h>

namespace poinsot {
namespace {

PoseSnapshot snapshot(const Vec3& position, double angle) {
  PoseSnapshot result;
  result.bodies.resize(2);
  result.bodies[1].position = position;
  result.bodies[1].orientation = Quat(std::cos(angle / 2), 0, std::sin(angle / 2), 0);
  return result;
}

TEST(Path, KnowsHowFarTheFarthestBodyIsFromAKeptFrame) {
  Path path;
  path.keep(snapshot(Vec3::Zero(), 0));
  path.keep(snapshot(Vec3(1, 2, 3), 0.25));
  const PoseError error = path.distance(1, snapshot(Vec3(1, 5, 7), 0.75));
  EXPECT_NEAR(error.position, 5, 1e-15);
  EXPECT_NEAR(error.orientation, 0.5, 1e-15);
  EXPECT_EQ(path.distance(1, snapshot(Vec3(1, 2, 3), 0.25)), PoseError{});
}

TEST(Path, ComparesTheLastFramesOfTwo) {
  Path a, b;
  a.keep(snapshot(Vec3::Zero(), 0));
  b.keep(snapshot(Vec3(9, 9, 9), 1));
  a.keep(snapshot(Vec3(0, 0, 1), 0));
  b.keep(snapshot(Vec3(0, 0, 3), 0));
  EXPECT_EQ(Path::last_distance(a, b), (PoseError{2, 0}));
}

TEST(Path, IsCutToSoManyFrames) {
  Path path;
  for (int n = 0; n < 5; ++n) path.keep(snapshot(Vec3(n, 0, 0), 0));
  path.cut(3);
  EXPECT_EQ(path.size(), 3u);
  path.cut(7);
  EXPECT_EQ(path.size(), 3u);
}

TEST(Path, IsThinnedToEveryOtherFrame) {
  for (const std::size_t frames : {4u, 5u}) {
    Path path;
    for (std::size_t n = 0; n < frames; ++n)
      path.keep(snapshot(Vec3(static_cast<double>(n), 0, 0), 0));
    path.thin();
    ASSERT_EQ(path.size(), (frames + 1) / 2);
    EXPECT_EQ(path.distance(1, snapshot(Vec3(2, 0, 0), 0)), PoseError{});
  }
}

}  // namespace
}  // namespace poinsot
