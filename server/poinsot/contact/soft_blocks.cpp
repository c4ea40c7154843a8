#include "poinsot/contact/soft_blocks.h"

#include <algorithm>
#include <cmath>

namespace poinsot {
namespace {

constexpr double kNoGap = 1e30;  // [m] of a point that is not there

// Softness of resting points, all of a sub-step and without unit. Against its usual load a point is
// a spring of frequency 0.25/h, critically damped and implicit. Contacts of columns take more than
// what stops them, which lets bending modes of a tower of 30 settle; where bodies touch more than
// two others that would excite them. The usual load is learnt more slowly than such modes decay:
// faster, it feeds them. Found by measurement: README.md.
constexpr double kPushOut = 0.44;          // part of a penetration that is removed
constexpr double kFade = 0.15;             // part of what exceeds the usual load that is let go
constexpr double kColumnOvershoot = 0.5;   // beyond the impulse that would stop the point …
constexpr double kCrowdOvershoot = -0.15;  // … or short of it
constexpr double kLearn = 3e-4;            // part of the way from the usual to the present load

constexpr double kNear = 1e-3;  // [-] of the pair's size: gaps below are of points that rest

constexpr std::size_t kPieceBlocks = 24;  // worth handing to another thread

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

// Before lanes are packed. Those that stay empty do nothing if all is zero.
void clear(SoftBlock& block, bool has_empty_lanes, int nobody) {
  if (has_empty_lanes) {
    block = SoftBlock{};
    block.source.fill(-1);
    block.a.fill(nobody);
    block.b.fill(nobody);
  } else {
    block.count = 0;
    block.bounces = block.turns = false;
    block.push_work = block.residual = block.roll_1 = block.roll_2 = Lanes{};
  }
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

void SoftBlocks::pack_lane(const SoftManifold& manifold, int source,
                           std::span<const SoftBody> bodies, const SoftBodies& motion,
                           SoftBlock& block, std::size_t lane) const {
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
  block.bend_a[lane] = manifold.round_a ? 0 : 1;
  block.bend_b[lane] = manifold.round_b ? 0 : 1;
  block.restitution[lane] = manifold.restitution;
  block.slop[lane] = allowed_penetration_ * manifold.size;
  block.near[lane] = kNear * manifold.size;
  const bool in_column =
      colors_.contacts_of(manifold.a) <= 2 && colors_.contacts_of(manifold.b) <= 2;
  block.overshoot[lane] = in_column ? kColumnOvershoot : kCrowdOvershoot;
  block.drag_1[lane] = manifold.friction_impulse.dot(t1);
  block.drag_2[lane] = manifold.friction_impulse.dot(t2);
  block.twist[lane] = manifold.twist_impulse;
  for (int i = 0; i < SoftBlock::kPoints; ++i) {
    SoftPointLanes& to = block.points[static_cast<std::size_t>(i)];
    if (i >= manifold.count) {
      to.x[lane] = to.y[lane] = to.radius[lane] = to.impulse[lane] = to.load[lane] = 0;
      to.peak[lane] = 0;
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
    to.load[lane] = point.usual_impulse;
    to.peak[lane] = 0;
  }
}

void SoftBlocks::start(std::span<const SoftBody> bodies, std::span<const SoftManifold> manifolds,
                       const SoftSettings& settings, double h) {
  rates_ = {.h = h,
            .inv_h = 1 / h,
            .push_out_rate = kPushOut / h,
            .push_out_speed = settings.push_out_speed,
            .rest_speed = settings.rest_speed,
            .rolling_arm = settings.rolling_resistance,
            .fade = kFade,
            .learn = kLearn};
  allowed_penetration_ = settings.allowed_penetration;
  const auto moves = [&](int k) { return bodies[static_cast<std::size_t>(k)].inv_mass > 0; };
  pairs_.clear();
  for (const SoftManifold& manifold : manifolds)
    pairs_.push_back({moves(manifold.a) ? manifold.a : -1, moves(manifold.b) ? manifold.b : -1});
  colors_.assign(pairs_, static_cast<int>(bodies.size()));
  sort_by_count(manifolds);
}

// Blocks of each colour by falling count of points: few have to carry lanes without a point.
void SoftBlocks::sort_by_count(std::span<const SoftManifold> manifolds) {
  order_.clear();
  runs_.clear();
  for (std::size_t group = 0; group < colors_.groups(); ++group) {
    const std::size_t first = order_.size() / kLanes;
    const std::span<const int> members = colors_.group(group);
    for (int count = SoftManifold::kMaxPoints; count > 0; --count)
      for (const int k : members)
        if (manifolds[static_cast<std::size_t>(k)].count == count) order_.push_back(k);
    while (order_.size() % kLanes != 0) order_.push_back(-1);
    add_run(first, order_.size() / kLanes);
  }
  // Every block is packed anew.
  if (blocks_.size() < order_.size() / kLanes) blocks_.resize(order_.size() / kLanes);
}

void SoftBlocks::add_run(std::size_t first, std::size_t last) {
  const std::size_t pieces = (last - first) / kPieceBlocks;
  if (pieces > 1)
    runs_.push_back({first, last, pieces});
  else if (!runs_.empty() && runs_.back().pieces == 1)
    runs_.back().last = last;
  else
    runs_.push_back({first, last, 1});
}

std::size_t SoftBlocks::pack_pieces() const {
  return (order_.size() / kLanes + kPieceBlocks - 1) / kPieceBlocks;
}

void SoftBlocks::pack(std::size_t piece, std::span<const SoftBody> bodies,
                      std::span<const SoftManifold> manifolds, const SoftBodies& motion) {
  const std::size_t last = std::min((piece + 1) * kPieceBlocks, order_.size() / kLanes);
  for (std::size_t k = piece * kPieceBlocks; k < last; ++k) {
    SoftBlock& block = blocks_[k];
    clear(block, order_[k * kLanes + kLanes - 1] < 0, static_cast<int>(bodies.size()));
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const int source = order_[k * kLanes + lane];
      if (source >= 0)
        pack_lane(manifolds[static_cast<std::size_t>(source)], source, bodies, motion, block, lane);
    }
    kernels_.respond(block, motion.masses());
    if (block.bounces) kernels_.note_approach(block, motion.hot());
  }
}

std::span<SoftBlock> SoftBlocks::blocks_of(std::size_t run, std::size_t piece) {
  const Run& r = runs_[run];
  const std::size_t size = r.last - r.first;
  const std::size_t first = r.first + size * piece / r.pieces;
  const std::size_t last = r.first + size * (piece + 1) / r.pieces;
  return std::span(blocks_).subspan(first, last - first);
}

void SoftBlocks::warm_start(SoftBodies& motion, std::size_t run, std::size_t piece) {
  for (SoftBlock& block : blocks_of(run, piece)) kernels_.warm_start(block, motion.hot());
}

void SoftBlocks::push(SoftBodies& motion, std::size_t run, std::size_t piece) {
  for (SoftBlock& block : blocks_of(run, piece)) kernels_.push(block, motion.hot(), rates_);
}

void SoftBlocks::relax(SoftBodies& motion, std::size_t run, std::size_t piece) {
  for (SoftBlock& block : blocks_of(run, piece)) {
    if (block.turns) {
      bool turned = false;
      for (std::size_t lane = 0; lane < kLanes; ++lane)
        turned = turned || motion.has_turned(block.a[lane]) || motion.has_turned(block.b[lane]);
      if (turned) kernels_.respond(block, motion.masses());
    }
    kernels_.relax(block, motion.hot(), rates_);
  }
}

void SoftBlocks::bounce(SoftBodies& motion, std::size_t run, std::size_t piece) {
  for (SoftBlock& block : blocks_of(run, piece))
    if (block.bounces) kernels_.bounce(block, motion.hot(), rates_);
}

void SoftBlocks::finish(std::span<SoftManifold> manifolds, SoftOutcome& outcome) const {
  for (const SoftBlock& block : std::span(blocks_).first(order_.size() / kLanes)) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      if (block.source[lane] < 0) continue;
      SoftManifold& manifold = manifolds[static_cast<std::size_t>(block.source[lane])];
      outcome.residual = std::max(outcome.residual, block.residual[lane]);
      outcome.push_out_energy += block.push_work[lane];
      for (int i = 0; i < manifold.count; ++i) {
        const SoftPointLanes& point = block.points[static_cast<std::size_t>(i)];
        manifold.points[i].gap = point.gap[lane];
        manifold.points[i].normal_impulse = point.impulse[lane];
        manifold.points[i].usual_impulse = point.load[lane];
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
