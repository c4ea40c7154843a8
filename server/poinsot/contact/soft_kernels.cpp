#include "poinsot/contact/soft_kernels.h"

#include "poinsot/contact/soft_points.h"

namespace poinsot {
namespace {

template <int count>
POINSOT_INLINE void respond_count(SoftBlock& block) {
  const Sym3Lanes& P = block.push_push;
  Vec3Lanes response[4];
  for (int i = 0; i < count; ++i) {
    SoftPointLanes& point = block.points[static_cast<std::size_t>(i)];
    response[i] = P * Vec3Lanes{all_lanes(1), point.y, -point.x};
    const Lanes own = point_velocity(point, response[i]);
    point.inv_response = own > 0.0 ? 1.0 / own : Lanes{};
  }
  Push all = {};
  for (int i = 0; i < count; ++i) add(all, block.points[static_cast<std::size_t>(i)], all_lanes(1));
  const Vec3Lanes lift = P * Vec3Lanes{all.force, all.about_1, all.about_2};
  Lanes most = {};
  for (int i = 0; i < count; ++i) {
    SoftPointLanes& point = block.points[static_cast<std::size_t>(i)];
    point.heave = point_velocity(point, lift);
    most = larger(most, point.heave);
  }
  block.inv_heave = most > 0.0 ? 1.0 / most : Lanes{};
  int k = 0;
  for (int i = 0; i < SoftBlock::kPoints; ++i)
    for (int j = i + 1; j < SoftBlock::kPoints; ++j, ++k)
      block.point_point[k] =
          j < count ? point_velocity(block.points[static_cast<std::size_t>(j)], response[i])
                    : Lanes{};
}

POINSOT_INLINE void load_masses(const std::array<int, kLanes>& index, const SoftMass* masses,
                                Sym3Lanes& inv_J, Lanes& inv_mass) {
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const SoftMass& mass = masses[index[lane]];
    inv_J.xx[lane] = mass.inv_J_W[0];
    inv_J.xy[lane] = mass.inv_J_W[1];
    inv_J.xz[lane] = mass.inv_J_W[2];
    inv_J.yy[lane] = mass.inv_J_W[3];
    inv_J.yz[lane] = mass.inv_J_W[4];
    inv_J.zz[lane] = mass.inv_J_W[5];
    inv_mass[lane] = mass.inv_mass;
  }
}

POINSOT_INLINE void respond_block(SoftBlock& block, const SoftMass* masses) {
  load_masses(block.a, masses, block.inv_J_a, block.inv_mass_a);
  load_masses(block.b, masses, block.inv_J_b, block.inv_mass_b);
  const Vec3Lanes axes[3] = {block.n, block.t1, block.t2};
  const Lanes inv_mass = block.inv_mass_a + block.inv_mass_b;
  Vec3Lanes arm_a[3], arm_b[3], spin_a[3], spin_b[3], own_spin[3];
  for (int k = 0; k < 3; ++k) {
    arm_a[k] = cross(block.arm_a, axes[k]);
    arm_b[k] = cross(block.arm_b, axes[k]);
    spin_a[k] = block.inv_J_a * arm_a[k];
    spin_b[k] = block.inv_J_b * arm_b[k];
    own_spin[k] = block.inv_J_a * axes[k] + block.inv_J_b * axes[k];
  }
  // v along i by a force along j; ω about i by a force along j; ω about i by a couple about j.
  const auto vf = [&](int i, int j) __attribute__((always_inline)) {
    const Lanes turning = dot(arm_a[i], spin_a[j]) + dot(arm_b[i], spin_b[j]);
    return i == j ? inv_mass + turning : turning;
  };
  const auto wf = [&](int i, int j) __attribute__((always_inline)) {
    return dot(axes[i], spin_a[j] + spin_b[j]);
  };
  const auto wm = [&](int i, int j) __attribute__((always_inline)) {
    return dot(axes[i], own_spin[j]);
  };
  block.push_push = {vf(0, 0), wf(1, 0), wf(2, 0), wm(1, 1), wm(1, 2), wm(2, 2)};
  block.drag_drag = {vf(1, 1), vf(1, 2), wf(0, 1), vf(2, 2), wf(0, 2), wm(0, 0)};
  for (int j = 0; j < 2; ++j) {
    block.push_drag[0][j] = vf(0, j + 1);
    block.push_drag[1][j] = wf(1, j + 1);
    block.push_drag[2][j] = wf(2, j + 1);
  }
  block.push_drag[0][2] = wf(0, 0);
  block.push_drag[1][2] = wm(1, 0);
  block.push_drag[2][2] = wm(2, 0);
  const Sym3Lanes& D = block.drag_drag;
  const Lanes determinant = D.xx * D.yy - D.xy * D.xy;
  const Lanes inv_determinant = determinant > 0.0 ? 1.0 / determinant : Lanes{};
  block.inv_drag_11 = D.yy * inv_determinant;
  block.inv_drag_12 = -D.xy * inv_determinant;
  block.inv_drag_22 = D.xx * inv_determinant;
  const Lanes trace = D.xx + D.yy;
  block.slip_gain = trace > 0.0 ? 1.0 / trace : Lanes{};
  block.inv_twist = D.zz > 0.0 ? 1.0 / D.zz : Lanes{};
  switch (block.count) {
    case 1:
      respond_count<1>(block);
      break;
    case 2:
      respond_count<2>(block);
      break;
    case 3:
      respond_count<3>(block);
      break;
    default:
      respond_count<4>(block);
  }
}

POINSOT_INLINE Vec3Lanes push_part(const SoftBlock& block, const Twist& twist) {
  return {dot(block.n, twist.v), dot(block.t1, twist.omega), dot(block.t2, twist.omega)};
}

POINSOT_INLINE void note_approach_block(SoftBlock& block, const HotBody* bodies) {
  const Vec3Lanes push = push_part(block, twist_of(block, gather(block, bodies)));
  for (int i = 0; i < block.count; ++i) {
    SoftPointLanes& point = block.points[static_cast<std::size_t>(i)];
    point.approach = point_velocity(point, push);
  }
}

POINSOT_INLINE void apply_push(const SoftBlock& block, const Push& push, Pair& pair,
                               HotBody* bodies) {
  apply(block, block.n * push.force, block.t1 * push.about_1 + block.t2 * push.about_2, pair,
        bodies);
}

POINSOT_INLINE void warm_start_block(SoftBlock& block, HotBody* bodies) {
  Pair pair = gather(block, bodies);
  Push push = {};
  for (int i = 0; i < block.count; ++i)
    add(push, block.points[static_cast<std::size_t>(i)],
        block.points[static_cast<std::size_t>(i)].impulse);
  apply(block, block.n * push.force + (block.t1 * block.drag_1 + block.t2 * block.drag_2),
        block.n * block.twist + (block.t1 * push.about_1 + block.t2 * push.about_2), pair, bodies);
}

// Speeds at which points are moved apart, and at which they may meet: nearly touching, as slowly.
POINSOT_INLINE Lanes push_out(const SoftBlock& block, Lanes gap, const SoftRates& rates) {
  return smaller(positive_part(-gap - block.slop) * rates.push_out_rate,
                 all_lanes(rates.push_out_speed));
}
POINSOT_INLINE Lanes meet(const SoftBlock& block, Lanes gap, const SoftRates& rates) {
  return larger(positive_part(gap) * rates.push_out_rate,
                (gap - block.near) * rates.inv_h + block.near * rates.push_out_rate);
}

template <int count>
POINSOT_INLINE void push_count(SoftBlock& block, HotBody* bodies, const SoftRates& rates) {
  Pair pair = gather(block, bodies);
  const Vec3Lanes push = push_part(block, twist_of(block, pair));
  Lanes velocity[count], target[count];
  for (int i = 0; i < count; ++i) {
    SoftPointLanes& point = block.points[static_cast<std::size_t>(i)];
    point.load += rates.learn * (point.impulse - point.load);
    velocity[i] = point_velocity(point, push);
    target[i] = push_out(block, point.gap, rates) - meet(block, point.gap, rates);
  }
  apply_push(block, solve_soft_points<count>(block, velocity, target, rates), pair, bodies);
}

// (Rᵀ − 1) n for the rotation of a unit quaternion with vector part u; of a round surface to first
// order.
POINSOT_INLINE Vec3Lanes turned_back(const Vec3Lanes& u, Lanes w, const Vec3Lanes& n, Lanes bend) {
  const Vec3Lanes c = cross(u, n);
  return (cross(u, c) * bend - c * w) * all_lanes(2);
}

template <int count>
POINSOT_INLINE void follow_gaps(SoftBlock& block, const HotBody* bodies) {
  Vec3Lanes shift_a, shift_b, u_a, u_b;
  Lanes none, w_a, w_b;
  gather(bodies, block.a, &HotBody::shift, shift_a, none);
  gather(bodies, block.b, &HotBody::shift, shift_b, none);
  gather(bodies, block.a, &HotBody::turn, u_a, w_a);
  gather(bodies, block.b, &HotBody::turn, u_b, w_b);
  const Vec3Lanes lean_a = turned_back(u_a, w_a, block.n, block.bend_a),
                  lean_b = turned_back(u_b, w_b, block.n, block.bend_b);
  const Lanes moved =
      dot(block.n, shift_a - shift_b) + (dot(lean_a, block.arm_a) - dot(lean_b, block.arm_b));
  const Vec3Lanes lean = lean_a - lean_b;
  const Lanes lean_1 = dot(lean, block.t1), lean_2 = dot(lean, block.t2);
  for (int i = 0; i < count; ++i) {
    SoftPointLanes& point = block.points[static_cast<std::size_t>(i)];
    point.gap = point.start_gap + (moved + (point.x * lean_1 + point.y * lean_2));
  }
}

struct Drag {
  Lanes along_1, along_2, about_n;
};

// Friction as one vector in its circle, and the twist. Where the circle is reached the step is
// along the slip and not along what would stop it: so that both point the same way when they
// settle.
template <int count>
POINSOT_INLINE Drag solve_friction(SoftBlock& block, const Vec3Lanes& drag) {
  Lanes load = {}, arm = {};
  for (int i = 0; i < count; ++i) {
    const SoftPointLanes& point = block.points[static_cast<std::size_t>(i)];
    load += point.impulse;
    arm += point.impulse * point.radius;
  }
  const Lanes radius = block.friction * load;
  Lanes f_1 = block.drag_1 - (block.inv_drag_11 * drag.x + block.inv_drag_12 * drag.y);
  Lanes f_2 = block.drag_2 - (block.inv_drag_12 * drag.x + block.inv_drag_22 * drag.y);
  const LaneMask sticks = f_1 * f_1 + f_2 * f_2 <= radius * radius;
  const Lanes s_1 = block.drag_1 - block.slip_gain * drag.x;
  const Lanes s_2 = block.drag_2 - block.slip_gain * drag.y;
  const Lanes length = root(s_1 * s_1 + s_2 * s_2);
  const Lanes scale = length > radius ? radius / length : all_lanes(1);
  f_1 = sticks ? f_1 : s_1 * scale;
  f_2 = sticks ? f_2 : s_2 * scale;
  const Lanes d_1 = f_1 - block.drag_1, d_2 = f_2 - block.drag_2;
  block.drag_1 = f_1;
  block.drag_2 = f_2;
  Lanes twist = {};
  if (count > 1) {
    const Lanes limit = block.friction * arm;
    const Lanes speed = drag.z + (block.drag_drag.xz * d_1 + block.drag_drag.yz * d_2);
    twist = larger(-limit, smaller(limit, block.twist - block.inv_twist * speed));
  }
  const Lanes d_n = twist - block.twist;
  block.twist = twist;
  return {d_1, d_2, d_n};
}

// Resistance to rolling: a couple in its circle, changed into what it does to the twist.
template <int count>
POINSOT_INLINE Vec3Lanes solve_rolling(SoftBlock& block, const Vec3Lanes& push,
                                       const SoftRates& rates) {
  Lanes load = {};
  for (int i = 0; i < count; ++i) load += block.points[static_cast<std::size_t>(i)].impulse;
  const Lanes radius = rates.rolling_arm * load;
  const Lanes response = block.push_push.yy + block.push_push.zz;
  const Lanes gain = response > 0.0 ? 1.0 / response : Lanes{};
  const Lanes m_1 = block.roll_1 - gain * push.y, m_2 = block.roll_2 - gain * push.z;
  const Lanes length = root(m_1 * m_1 + m_2 * m_2);
  const Lanes scale = length > radius ? radius / length : all_lanes(1);
  const Vec3Lanes change = {Lanes{}, m_1 * scale - block.roll_1, m_2 * scale - block.roll_2};
  block.roll_1 += change.y;
  block.roll_2 += change.z;
  return change;
}

POINSOT_INLINE Lanes coupled(const Lanes* row, const Drag& drag) {
  return row[0] * drag.along_1 + row[1] * drag.along_2 + row[2] * drag.about_n;
}

template <int count>
POINSOT_INLINE void relax_count(SoftBlock& block, HotBody* bodies, const SoftRates& rates) {
  Pair pair = gather(block, bodies);
  const Twist twist = twist_of(block, pair);
  Vec3Lanes push = push_part(block, twist);
  // What moved points apart has lifted their load over this sub-step.
  for (int i = 0; i < count; ++i) {
    const SoftPointLanes& point = block.points[static_cast<std::size_t>(i)];
    const Lanes speed =
        smaller(positive_part(point_velocity(point, push)), push_out(block, point.gap, rates));
    block.push_work += point.impulse * speed;
  }
  follow_gaps<count>(block, bodies);

  const Drag drag = solve_friction<count>(
      block, {dot(block.t1, twist.v), dot(block.t2, twist.v), dot(block.n, twist.omega)});
  push.x += coupled(block.push_drag[0], drag);
  push.y += coupled(block.push_drag[1], drag);
  push.z += coupled(block.push_drag[2], drag);
  Vec3Lanes roll = {};
  if (rates.rolling_arm > 0) {
    roll = solve_rolling<count>(block, push, rates);
    push = push + block.push_push * roll;
  }

  Lanes velocity[count], target[count];
  for (int i = 0; i < count; ++i) {
    const SoftPointLanes& point = block.points[static_cast<std::size_t>(i)];
    velocity[i] = point_velocity(point, push);
    target[i] = -positive_part(point.gap - block.near) * rates.inv_h;
  }
  const Push change = solve_points<count>(block, velocity, target, rates);
  const Vec3Lanes jump = block.push_push * Vec3Lanes{change.force, change.about_1, change.about_2};
  Lanes residual = {};
  for (int i = 0; i < count; ++i) {
    SoftPointLanes& point = block.points[static_cast<std::size_t>(i)];
    residual = larger(residual, magnitude(point_velocity(point, jump)));
    if (block.bounces) point.peak = larger(point.peak, point.impulse);
  }
  block.residual = residual;
  apply(block, block.n * change.force + (block.t1 * drag.along_1 + block.t2 * drag.along_2),
        block.n * drag.about_n +
            (block.t1 * (change.about_1 + roll.y) + block.t2 * (change.about_2 + roll.z)),
        pair, bodies);
}

// Points that were pushed and had approached leave as fast as their restitution says. The impulses
// are gone after it: no guess for what comes.
POINSOT_INLINE void bounce_block(SoftBlock& block, HotBody* bodies, const SoftRates& rates) {
  constexpr int kRounds = 12;  // the points of one manifold settle among themselves
  Pair pair = gather(block, bodies);
  Vec3Lanes push = push_part(block, twist_of(block, pair));
  Push sum = {};
  Lanes given[SoftBlock::kPoints] = {};
  for (int round = 0; round < kRounds; ++round) {
    for (int i = 0; i < block.count; ++i) {
      const SoftPointLanes& point = block.points[static_cast<std::size_t>(i)];
      const LaneMask bounces = (point.approach < -rates.rest_speed) & (point.peak > 0.0);
      const Lanes off = point_velocity(point, push) + block.restitution * point.approach;
      const Lanes all = positive_part(given[i] - point.inv_response * off);
      const Lanes change = bounces ? all - given[i] : Lanes{};
      given[i] += change;
      push = push + block.push_push * Vec3Lanes{change, point.y * change, -point.x * change};
      add(sum, point, change);
    }
  }
  for (int i = 0; i < block.count; ++i) {
    SoftPointLanes& point = block.points[static_cast<std::size_t>(i)];
    point.impulse = given[i] > 0.0 ? Lanes{} : point.impulse;
  }
  apply_push(block, sum, pair, bodies);
}

#define POINSOT_BY_COUNT(kernel)       \
  switch (block.count) {               \
    case 1:                            \
      kernel<1>(block, bodies, rates); \
      break;                           \
    case 2:                            \
      kernel<2>(block, bodies, rates); \
      break;                           \
    case 3:                            \
      kernel<3>(block, bodies, rates); \
      break;                           \
    default:                           \
      kernel<4>(block, bodies, rates); \
  }

#define POINSOT_KERNELS(suffix, target)                                                           \
  target void respond_##suffix(SoftBlock& block, const SoftMass* masses) {                        \
    respond_block(block, masses);                                                                 \
  }                                                                                               \
  target void note_approach_##suffix(SoftBlock& block, const HotBody* bodies) {                   \
    note_approach_block(block, bodies);                                                           \
  }                                                                                               \
  target void warm_start_##suffix(SoftBlock& block, HotBody* bodies) {                            \
    warm_start_block(block, bodies);                                                              \
  }                                                                                               \
  target void push_##suffix(SoftBlock& block, HotBody* bodies, const SoftRates& rates){           \
      POINSOT_BY_COUNT(push_count)} target void relax_##suffix(SoftBlock& block, HotBody* bodies, \
                                                               const SoftRates& rates){           \
      POINSOT_BY_COUNT(relax_count)} target void bounce_##suffix(SoftBlock& block,                \
                                                                 HotBody* bodies,                 \
                                                                 const SoftRates& rates) {        \
    bounce_block(block, bodies, rates);                                                           \
  }                                                                                               \
  constexpr SoftKernels kKernels_##suffix = {respond_##suffix,    note_approach_##suffix,         \
                                             warm_start_##suffix, push_##suffix,                  \
                                             relax_##suffix,      bounce_##suffix};

POINSOT_KERNELS(baseline, )
#ifdef __x86_64__
POINSOT_KERNELS(avx2, [[gnu::target("avx2")]])
#endif

}  // namespace

SoftKernels baseline_soft_kernels() {
  return kKernels_baseline;
}

SoftKernels soft_kernels() {
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx2")) return kKernels_avx2;
#endif
  return kKernels_baseline;
}

}  // namespace poinsot
