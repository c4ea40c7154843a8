// The parts of soft_kernels.cpp: bodies in and out of lanes, twists, and the points of a manifold
// solved one after another.

#pragma once

#include "poinsot/contact/soft_kernels.h"

namespace poinsot {

struct Pair {
  Vec3Lanes v_a, omega_a, v_b, omega_b;
};

POINSOT_INLINE void gather(const HotBody* bodies, const std::array<int, kLanes>& index,
                           Lanes HotBody::*member, Vec3Lanes& to, Lanes& w) {
  to.x = bodies[index[0]].*member;
  to.y = bodies[index[1]].*member;
  to.z = bodies[index[2]].*member;
  w = bodies[index[3]].*member;
  transpose(to.x, to.y, to.z, w);
}

POINSOT_INLINE Pair gather(const SoftBlock& block, const HotBody* bodies) {
  Pair pair;
  Lanes none;
  gather(bodies, block.a, &HotBody::v, pair.v_a, none);
  gather(bodies, block.a, &HotBody::omega, pair.omega_a, none);
  gather(bodies, block.b, &HotBody::v, pair.v_b, none);
  gather(bodies, block.b, &HotBody::omega, pair.omega_b, none);
  return pair;
}

POINSOT_INLINE void scatter(HotBody* bodies, const std::array<int, kLanes>& index,
                            const std::array<bool, kLanes>& moves, Vec3Lanes v, Vec3Lanes omega) {
  Lanes v_3 = {}, omega_3 = {};
  transpose(v.x, v.y, v.z, v_3);
  transpose(omega.x, omega.y, omega.z, omega_3);
  const auto put = [&](std::size_t lane, Lanes v_lane, Lanes omega_lane)
      __attribute__((always_inline)) {
    if (!moves[lane]) return;
    bodies[index[lane]].v = v_lane;
    bodies[index[lane]].omega = omega_lane;
  };
  put(0, v.x, omega.x);
  put(1, v.y, omega.y);
  put(2, v.z, omega.z);
  put(3, v_3, omega_3);
}

// Relative twist at the centre.
struct Twist {
  Vec3Lanes v, omega;
};

POINSOT_INLINE Twist twist_of(const SoftBlock& block, const Pair& pair) {
  return {
      (pair.v_a + cross(pair.omega_a, block.arm_a)) - (pair.v_b + cross(pair.omega_b, block.arm_b)),
      pair.omega_a - pair.omega_b};
}

POINSOT_INLINE void apply(const SoftBlock& block, const Vec3Lanes& force, const Vec3Lanes& couple,
                          Pair& pair, HotBody* bodies) {
  pair.v_a = pair.v_a + force * block.inv_mass_a;
  pair.v_b = pair.v_b - force * block.inv_mass_b;
  pair.omega_a = pair.omega_a + block.inv_J_a * (cross(block.arm_a, force) + couple);
  pair.omega_b = pair.omega_b - block.inv_J_b * (cross(block.arm_b, force) + couple);
  scatter(bodies, block.a, block.move_a, pair.v_a, pair.omega_a);
  scatter(bodies, block.b, block.move_b, pair.v_b, pair.omega_b);
}

POINSOT_INLINE Lanes point_velocity(const SoftPointLanes& point, const Vec3Lanes& push) {
  return push.x + (point.y * push.y - point.x * push.z);
}

// Normal impulses.
struct Push {
  Lanes force, about_1, about_2;
};

POINSOT_INLINE void add(Push& push, const SoftPointLanes& point, Lanes impulse) {
  push.force += impulse;
  push.about_1 += point.y * impulse;
  push.about_2 -= point.x * impulse;
}

// Changes of the points' velocities with the impulse of one of them.
template <int count>
POINSOT_INLINE void spread(const SoftBlock& block, int from, Lanes change, Lanes* velocity) {
  constexpr int kIndex[4][4] = {{-1, 0, 1, 2}, {0, -1, 3, 4}, {1, 3, -1, 5}, {2, 4, 5, -1}};
  for (int to = from + 1; to < count; ++to)
    velocity[to] += block.point_point[kIndex[from][to]] * change;
}

// Before points are solved one by one: what all of them lack, or have too much, is given to all
// alike, so that a flat impact hardly turns a body. Only where it is more than resting points ever
// have: their balance is left to the softer way below.
template <int count>
POINSOT_INLINE void solve_impact(SoftBlock& block, Lanes* velocity, const Lanes* target,
                                 const SoftRates& rates, Push& push) {
  Lanes most = velocity[0] - target[0], least = most, spare = block.points[0].impulse;
  for (int i = 1; i < count; ++i) {
    const SoftPointLanes& point = block.points[static_cast<std::size_t>(i)];
    most = larger(most, velocity[i] - target[i]);
    least = smaller(least, velocity[i] - target[i]);
    spare = smaller(spare, point.impulse);
  }
  const Lanes reach = block.near * rates.inv_h;
  const Lanes lack = most < -reach ? -most : Lanes{}, excess = least > reach ? least : Lanes{};
  const Lanes change = larger(block.inv_heave * (lack - excess), -spare);
  for (int i = 0; i < count; ++i) {
    SoftPointLanes& point = block.points[static_cast<std::size_t>(i)];
    point.impulse += change;
    velocity[i] += point.heave * change;
    add(push, point, change);
  }
}

// One pass over the points: each is given the impulse that makes its velocity `target`, or none.
template <int count>
POINSOT_INLINE Push solve_points(SoftBlock& block, Lanes* velocity, const Lanes* target,
                                 const SoftRates& rates) {
  Push push = {};
  if constexpr (count > 1) solve_impact<count>(block, velocity, target, rates, push);
  for (int i = 0; i < count; ++i) {
    SoftPointLanes& point = block.points[static_cast<std::size_t>(i)];
    const Lanes impulse =
        positive_part(point.impulse - point.inv_response * (velocity[i] - target[i]));
    const Lanes change = impulse - point.impulse;
    point.impulse = impulse;
    spread<count>(block, i, change, velocity);
    add(push, point, change);
  }
  return push;
}

// The same with softness: points that rest are given more, as far as that does not lift them off,
// and let go part of what exceeds their usual load.
template <int count>
POINSOT_INLINE Push solve_soft_points(SoftBlock& block, Lanes* velocity, const Lanes* target,
                                      const SoftRates& rates) {
  const Lanes reach = block.near * rates.inv_h;
  Push push = {};
  if constexpr (count > 1) solve_impact<count>(block, velocity, target, rates, push);
  for (int i = 0; i < count; ++i) {
    SoftPointLanes& point = block.points[static_cast<std::size_t>(i)];
    const LaneMask rests = point.gap <= block.near;
    const Lanes off = velocity[i] - target[i];
    const Lanes more = block.overshoot * larger(-reach, smaller(reach, off));
    const Lanes less = rates.fade * (point.impulse - point.load);
    const Lanes firm = point.impulse - point.inv_response * off;
    const Lanes soft = firm - point.inv_response * more - less;
    const Lanes impulse = positive_part(rests ? soft : firm);
    const Lanes change = impulse - point.impulse;
    point.impulse = impulse;
    spread<count>(block, i, change, velocity);
    add(push, point, change);
  }
  return push;
}

}  // namespace poinsot
