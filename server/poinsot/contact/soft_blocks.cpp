#include "poinsot/contact/soft_blocks.h"

#include <algorithm>
#include <cmath>

namespace poinsot {
namespace {

constexpr double kNoGap = 1e30;  // [m] of a point that is not there

// Softness of a penetrating point: a spring of frequency 0.25/h with critical damping, implicitly.
constexpr double kPushOut = 0.4399, kGive = 0.848, kFade = 0.152;  // [-] of a sub-step

void put(Vec3Lanes& to, std::size_t lane, const Vec3& value) {
  to.x[lane] = value.x();
  to.y[lane] = value.y();
  to.z[lane] = value.z();
}

// Two unit vectors that make a right-handed frame with n. Source: Duff et al., Building an
// Orthonormal Basis, Revisited (2017).
void make_frame(const Vec3& n, Vec3& t1, Vec3& t2) {
  const double sign = std::copysign(1.0, n.z());
  const double a = -1 / (sign + n.z()), b = n.x() * n.y() * a;
  t1 = Vec3(1 + sign * n.x() * n.x() * a, sign * b, -sign * n.x());
  t2 = Vec3(b, sign + n.y() * n.y() * a, -n.y());
}

// Where friction acts, from a's centre: where the load was, or the middle of the points.
Vec3 friction_arm(const SoftManifold& manifold, const Vec3& between) {
  double load = 0;
  Vec3 weighted = Vec3::Zero(), sum = Vec3::Zero();
  for (int i = 0; i < manifold.count; ++i) {
    const SoftManifold::Point& point = manifold.points[i];
    const Vec3 arm = 0.5 * (point.arm_a + (point.arm_b - between));
    load += point.normal_impulse;
    weighted += point.normal_impulse * arm;
    sum += arm;
  }
  return load > 0 ? Vec3(weighted / load) : Vec3(sum / manifold.count);
}

}  // namespace

void SoftBlocks::pack(const SoftManifold& manifold, int source, std::span<const SoftBody> bodies,
                      const SoftBodies& motion, SoftBlock& block, std::size_t lane) const {
  const SoftBody& a = bodies[static_cast<std::size_t>(manifold.a)];
  const SoftBody& b = bodies[static_cast<std::size_t>(manifold.b)];
  block.source[lane] = source;
  block.a[lane] = manifold.a;
  block.b[lane] = manifold.b;
  block.move_a[lane] = motion.moves(manifold.a);
  block.move_b[lane] = motion.moves(manifold.b);
  block.count = std::max(block.count, manifold.count);
  block.bounces = block.bounces || manifold.restitution > 0;
  block.turns = block.turns || motion.turns(manifold.a) || motion.turns(manifold.b);
  Vec3 t1, t2;
  make_frame(manifold.normal, t1, t2);
  put(block.n, lane, manifold.normal);
  put(block.t1, lane, t1);
  put(block.t2, lane, t2);
  const Vec3 between = a.c - b.c;  // arm_b − arm_a of one point
  const Vec3 centre = friction_arm(manifold, between);
  put(block.arm_a, lane, centre);
  put(block.arm_b, lane, centre + between);
  block.friction[lane] = manifold.friction;
  block.restitution[lane] = manifold.restitution;
  block.slop[lane] = allowed_penetration_ * manifold.size;
  block.drag_1[lane] = manifold.friction_impulse.dot(t1);
  block.drag_2[lane] = manifold.friction_impulse.dot(t2);
  block.twist[lane] = manifold.twist_impulse;
  for (int i = 0; i < SoftBlock::kPoints; ++i) {
    SoftPointLanes& to = block.points[static_cast<std::size_t>(i)];
    if (i >= manifold.count) {
      to.gap[lane] = to.start_gap[lane] = kNoGap;
      continue;
    }
    const SoftManifold::Point& point = manifold.points[i];
    const Vec3 from_centre = 0.5 * (point.arm_a + (point.arm_b - between)) - centre;
    to.x[lane] = t1.dot(from_centre);
    to.y[lane] = t2.dot(from_centre);
    to.radius[lane] = std::sqrt(to.x[lane] * to.x[lane] + to.y[lane] * to.y[lane]);
    to.gap[lane] = to.start_gap[lane] = point.gap;
    to.impulse[lane] = point.normal_impulse;
  }
}

void SoftBlocks::start(std::span<const SoftBody> bodies, std::span<const SoftManifold> manifolds,
                       const SoftBodies& motion, const SoftSettings& settings, double h) {
  rates_ = {h, 1 / h, kPushOut / h, settings.push_out_speed, settings.rest_speed, kGive, kFade};
  allowed_penetration_ = settings.allowed_penetration;
  pairs_.clear();
  for (const SoftManifold& manifold : manifolds)
    pairs_.push_back(
        {motion.moves(manifold.a) ? manifold.a : -1, motion.moves(manifold.b) ? manifold.b : -1});
  colors_.assign(pairs_, static_cast<int>(bodies.size()));
  starts_.assign(1, 0);
  for (std::size_t group = 0; group < colors_.groups(); ++group)
    starts_.push_back(starts_.back() + (colors_.group(group).size() + kLanes - 1) / kLanes);
  blocks_.assign(starts_.back(), SoftBlock{});
  for (std::size_t group = 0; group < colors_.groups(); ++group) {
    const std::span<const int> members = colors_.group(group);
    for (std::size_t first = 0; first < members.size(); first += kLanes) {
      SoftBlock& block = blocks_[starts_[group] + first / kLanes];
      block.source.fill(-1);
      block.a.fill(static_cast<int>(bodies.size()));
      block.b.fill(static_cast<int>(bodies.size()));
      const std::size_t lanes = std::min<std::size_t>(kLanes, members.size() - first);
      for (std::size_t lane = 0; lane < lanes; ++lane)
        pack(manifolds[static_cast<std::size_t>(members[first + lane])], members[first + lane],
             bodies, motion, block, lane);
      kernels_.respond(block, motion.masses());
    }
  }
}

void SoftBlocks::note_approach(SoftBodies& motion) {
  for (SoftBlock& block : blocks_)
    if (block.bounces) kernels_.note_approach(block, motion.hot());
}

void SoftBlocks::warm_start(SoftBodies& motion) {
  for (SoftBlock& block : blocks_) kernels_.warm_start(block, motion.hot());
}

void SoftBlocks::push(SoftBodies& motion) {
  for (SoftBlock& block : blocks_) kernels_.push(block, motion.hot(), rates_);
}

void SoftBlocks::relax(SoftBodies& motion) {
  for (SoftBlock& block : blocks_) {
    if (block.turns) {
      bool turned = false;
      for (std::size_t lane = 0; lane < kLanes; ++lane)
        turned = turned || motion.has_turned(block.a[lane]) || motion.has_turned(block.b[lane]);
      if (turned) kernels_.respond(block, motion.masses());
    }
    kernels_.relax(block, motion.hot(), rates_);
  }
}

void SoftBlocks::bounce(SoftBodies& motion) {
  for (SoftBlock& block : blocks_)
    if (block.bounces) kernels_.bounce(block, motion.hot(), rates_);
}

void SoftBlocks::finish(std::span<SoftManifold> manifolds, SoftOutcome& outcome) const {
  for (const SoftBlock& block : blocks_) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      if (block.source[lane] < 0) continue;
      SoftManifold& manifold = manifolds[static_cast<std::size_t>(block.source[lane])];
      outcome.residual = std::max(outcome.residual, block.residual[lane]);
      outcome.push_out_energy += block.push_work[lane];
      for (int i = 0; i < manifold.count; ++i) {
        const SoftPointLanes& point = block.points[static_cast<std::size_t>(i)];
        manifold.points[i].gap = point.gap[lane];
        manifold.points[i].normal_impulse = point.impulse[lane];
        outcome.max_penetration = std::max(outcome.max_penetration, -point.gap[lane]);
        outcome.pushing += point.impulse[lane] > 0;
      }
      const Vec3 t1(block.t1.x[lane], block.t1.y[lane], block.t1.z[lane]);
      const Vec3 t2(block.t2.x[lane], block.t2.y[lane], block.t2.z[lane]);
      manifold.friction_impulse = block.drag_1[lane] * t1 + block.drag_2[lane] * t2;
      manifold.twist_impulse = block.twist[lane];
    }
  }
}

}  // namespace poinsot
