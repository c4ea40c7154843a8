// Random crowds of boxes for benchmarks, the same on every machine: turned boxes that fly about in
// a room and come back from its walls.

#pragma once

#include <cmath>
#include <vector>

#include "poinsot/collision/collider.h"
#include "support/geometry.h"

namespace poinsot::bench {

struct Crowd {
  std::vector<Vec3> size;  // [m] full lengths
  std::vector<Pose> pose;
  std::vector<Vec3> velocity;  // [m/s]
  std::vector<bool> moves;
  Vec3 room = Vec3::Zero();  // [m] half lengths, about the origin

  int count() const { return static_cast<int>(size.size()); }

  void add(const Vec3& lengths, const Vec3& position, test::Random& random, double speed) {
    size.push_back(lengths);
    pose.push_back({position, random.rotation()});
    velocity.push_back(speed * random.direction());
    moves.push_back(true);
  }

  // The tight box of body i in W, as far as it reaches within h [s].
  Aabb box(int i, double h = 0) const {
    const auto k = static_cast<std::size_t>(i);
    const Vec3 half = 0.5 * (pose[k].q.toRotationMatrix().cwiseAbs() * size[k]);
    const Vec3 way = h * velocity[k];
    return {pose[k].c - half + way.cwiseMin(0), pose[k].c + half + way.cwiseMax(0)};
  }

  void advance(int i, double h) {
    const auto k = static_cast<std::size_t>(i);
    if (!moves[k]) return;
    pose[k].c += h * velocity[k];
    for (int axis = 0; axis < 3; ++axis)
      if (std::abs(pose[k].c[axis]) > room[axis] && pose[k].c[axis] * velocity[k][axis] > 0)
        velocity[k][axis] = -velocity[k][axis];
  }

  std::vector<Collider> colliders() const {
    std::vector<Collider> result;
    for (std::size_t k = 0; k < size.size(); ++k)
      result.emplace_back(static_cast<Eigen::Index>(k), Box{size[k]}, Pose{});
    return result;
  }
};

// Unit boxes at 1 m/s; about 0.7 pairs of boxes to a body.
inline Crowd gas(int n, std::uint64_t seed = 1) {
  test::Random random(seed);
  Crowd crowd;
  const double half = 0.5 * std::cbrt(20.0 * n);
  crowd.room = Vec3::Constant(half);
  for (int i = 0; i < n; ++i) crowd.add(Vec3::Ones(), random.in_box(half), random, 1);
  return crowd;
}

// Unit boxes side by side and on top of each other, three times as wide as high: 10 … 11 pairs of
// boxes to a body.
inline Crowd pile(int n, std::uint64_t seed = 1) {
  test::Random random(seed);
  Crowd crowd;
  const int wide = static_cast<int>(std::ceil(std::cbrt(3.0 * n)));
  constexpr double kSpacing = 1.2;
  for (int i = 0; i < n; ++i) {
    const Vec3 at(i % wide, i / wide % wide, i / (wide * wide));
    crowd.add(Vec3::Ones(), kSpacing * (at + random.in_box(0.1)), random, 0.1);
  }
  crowd.room = Vec3::Constant(kSpacing * wide);
  return crowd;
}

// Sizes log-uniform over three decades, 0.01 … 10 m, each body as fast as it is large.
inline Crowd mixed(int n, std::uint64_t seed = 1) {
  test::Random random(seed);
  Crowd crowd;
  const double half = 0.5 * std::cbrt(500.0 * n);
  crowd.room = Vec3::Constant(half);
  for (int i = 0; i < n; ++i) {
    const double size = random.log_uniform(0.01, 10);
    crowd.add(Vec3::Constant(size), random.in_box(half), random, size);
  }
  return crowd;
}

// Unit boxes close together on a ground that is one box, and does not move.
inline Crowd ground(int n, std::uint64_t seed = 1) {
  test::Random random(seed);
  Crowd crowd;
  const int wide = static_cast<int>(std::ceil(std::sqrt(n)));
  const double half = 0.75 * wide;
  crowd.add({2 * half, 2 * half, 1}, {0, 0, -0.5}, random, 0);
  crowd.pose[0].q.setIdentity();
  crowd.moves[0] = false;
  for (int i = 1; i < n; ++i)
    crowd.add(Vec3::Ones(), {1.5 * (i % wide) - half, 1.5 * (i / wide) - half, 0.6}, random, 1);
  crowd.room = Vec3(half, half, 1);
  return crowd;
}

// Heaps of a hundred bodies, far apart.
inline Crowd clusters(int n, std::uint64_t seed = 1) {
  test::Random random(seed);
  Crowd crowd;
  constexpr int kHeap = 100;
  const double half = 50 * std::cbrt(n / static_cast<double>(kHeap) + 1);
  crowd.room = Vec3::Constant(half);
  Vec3 heap = Vec3::Zero();
  for (int i = 0; i < n; ++i) {
    if (i % kHeap == 0) heap = random.in_box(half);
    crowd.add(Vec3::Ones(), heap + random.in_box(4), random, 1);
  }
  return crowd;
}

// Unit boxes so far apart that hardly two of them meet.
inline Crowd sparse(int n, std::uint64_t seed = 1) {
  test::Random random(seed);
  Crowd crowd;
  const double half = 5 * std::cbrt(n);
  crowd.room = Vec3::Constant(half);
  for (int i = 0; i < n; ++i) crowd.add(Vec3::Ones(), random.in_box(half), random, 1);
  return crowd;
}

}  // namespace poinsot::bench
