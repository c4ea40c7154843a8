#include "poinsot/collision/crowd.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace poinsot {
namespace {

// Room of a box beside what is needed, of the size; and how many frames ahead it may reach.
constexpr double kRoom = 0.05;
constexpr double kFramesAhead = 4;

// What `auto` goes by.
// A larger island is too dear for a direct solver; one that moves, whose contacts come and go,
// sooner than one that rests, whose forces are known from the frame before; and any where the crowd
// is accurate enough as a rule.
constexpr std::size_t kMostMoving = 64;
// A body on its own is solved directly even if that accuracy is not asked for.
constexpr std::size_t kFewDirect = 1;
// Easy islands: of bodies less than kMostRatio times as heavy as one another (steps of it add up in
// a stack), at most kMostLevels on one another.
constexpr double kMostRatio = 10;
constexpr int kMostLevels = 12;
// An island that is strained by so many times its tolerance though it hardly moves, by kSlow of its
// size in a frame, is solved directly for some frames.
constexpr double kStrained = 10;
constexpr double kSlow = 1e-3;
constexpr int kPromotedFrames = 120;

// Whether bodies are in the crowd unless something speaks against it.
bool prefers_crowd(const CollisionDef& def) {
  return def.contact_solver == ContactSolverKind::soft_step ||
         (def.contact_solver == ContactSolverKind::automatic &&
          def.contact_tolerance >= kSoftTolerance);
}

}  // namespace

double crowd_travel(const CollisionState& state, Eigen::Index i, const Vec3& omega, double h) {
  const World& world = state.world();
  const auto k = static_cast<std::size_t>(i);
  double acceleration = world.gravity.norm();
  if (state.simulation.is_driven(i))
    acceleration += world.held[k].in_W.force.norm() * world.inv_mass[k];
  return h *
         (linear_velocity(world, i).norm() + state.arm[k] * omega.norm() + 0.5 * h * acceleration);
}

Crowd::Crowd(const CollisionState& state)
    : always_(state.def.contact_solver == ContactSolverKind::soft_step),
      usual_(prefers_crowd(state.def)) {
  for (Eigen::Index i = 0; i < state.world().size(); ++i) set_body(state, i);
  fit_to_shapes(state);
}

void Crowd::set_body(const CollisionState& state, Eigen::Index i) {
  const auto k = static_cast<std::size_t>(i);
  if (k == member_.size()) {
    member_.push_back(0);
    may_step_.push_back(0);
    counted_.push_back(0);
    looked_.push_back(0);
    fits_.push_back(0);
    level_.push_back(0);
    forced_.push_back(0);
    promoted_.push_back(0);
  }
  forced_[k] = 0;
  promoted_[k] = 0;
  look_at_forces(state.world(), i);
  set_member(i, everybody_);
}

void Crowd::fit_to_shapes(const CollisionState& state) {
  near_.resize(state.colliders.size());
  kind_.clear();
  has_mesh_ = false;
  for (const Collider& collider : state.colliders) {
    const bool plane = std::holds_alternative<HalfSpace>(collider.shape);
    const bool mesh = std::holds_alternative<Mesh>(collider.shape);
    kind_.push_back(plane ? Kind::plane : mesh ? Kind::mesh : Kind::solid);
    has_mesh_ = has_mesh_ || mesh;
  }
}

void Crowd::look_at_forces(const World& world, Eigen::Index i) {
  const auto k = static_cast<std::size_t>(i);
  const int system = world.systems.empty() ? World::kLone : world.system_of[k];
  const bool drags =
      !world.drag.empty() &&
      (world.drag[k].linear > 0 || world.drag[k].quadratic > 0 || world.drag[k].angular > 0);
  may_step_[k] = world.moves(i) && system == World::kLone && !drags ? 1 : 0;
  if (may_step_[k] == 0) member_[k] = 0;

  const bool sprung = system != World::kLone && system < static_cast<int>(world.scene_systems);
  count_ -= counted_[k];
  counted_[k] = world.mass[k] > 0 && !sprung && !drags ? 1 : 0;
  count_ += counted_[k];
  const bool before = everybody_;
  everybody_ = always_ || (usual_ && count_ > kMostMoving);
  if (everybody_ && !before) member_ = may_step_;
}

void Crowd::next_frame() {
  ++frame_;
  before_ = member_;
  std::fill(looked_.begin(), looked_.end(), 0);
  for (int& frames : promoted_) frames = std::max(0, frames - 1);
}

bool Crowd::is_forced(const Island& island) const {
  return std::any_of(island.bodies.begin(), island.bodies.end(), [&](Eigen::Index i) {
    return forced_[static_cast<std::size_t>(i)] >= frame_;
  });
}

void Crowd::hash_into(Hash64& hash) const {
  for (std::size_t k = 0; k < member_.size(); ++k) {
    const std::uint64_t forced = forced_[k] > frame_ ? forced_[k] - frame_ : 0;
    const std::uint64_t word =
        std::uint64_t{member_[k]} | forced << 8 | static_cast<std::uint64_t>(promoted_[k]) << 32;
    if (word != 0) hash.add(static_cast<std::uint64_t>(k) << 48 ^ word);
  }
}

void Crowd::set_member(Eigen::Index i, bool member) {
  const auto k = static_cast<std::size_t>(i);
  member_[k] = member && may_step_[k] != 0 ? 1 : 0;
}

void Crowd::look(const CollisionState& state, double h, Team& team) {
  run_chunks(team, member_.size(), [&](std::size_t k) {
    const auto i = static_cast<Eigen::Index>(k);
    if (member_[k] == 0 || !state.is_awake(i)) return;
    looked_[k] = 1;
    fits_[k] = look(state, i, h) ? 1 : 0;
  });
}

bool Crowd::look(const CollisionState& state, Eigen::Index i, double h) {
  const World& world = state.world();
  const double more = crowd_travel(state, i, angular_velocity(world, i), h);
  const Pose pose{position(world.y, i), orientation(world.y, i)};
  bool fits = true;
  for (const Collider& collider : state.colliders_of(i)) {
    const auto c = static_cast<std::size_t>(&collider - state.colliders.data());
    near_[c] = bounds(collider, collider_pose(collider, pose))
                   .grown(more + 0.5 * state.def.contact_margin * collider.size);
    fits = fits && state.bound[c].contains(near_[c]);
  }
  return fits;
}

void Crowd::find_idle(CollisionState& state, Team& team) const {
  const std::span<PairRecord> records = state.pairs.records();
  run_chunks(team, records.size(), [&](std::size_t k) {
    PairRecord& record = records[k];
    record.idle = (had(record.a) || had(record.b)) && !is_near(state, record);
  });
}

Aabb Crowd::roomy_box(const CollisionState& state, const Collider& collider, double h) const {
  const Aabb& near = near_[static_cast<std::size_t>(&collider - state.colliders.data())];
  const Vec3 path = kFramesAhead * h * linear_velocity(state.world(), collider.body);
  const double length = path.norm();
  const Vec3 ahead = length > collider.size ? Vec3(path * (collider.size / length)) : path;
  Aabb box = near.grown(kRoom * collider.size);
  box.low += ahead.cwiseMin(0);
  box.high += ahead.cwiseMax(0);
  return box;
}

bool Crowd::is_near(const CollisionState& state, const PairRecord& record) const {
  const auto box = [&](int collider, int body) -> const Aabb& {
    const auto c = static_cast<std::size_t>(collider);
    const bool known = looked_[static_cast<std::size_t>(body)] != 0;  // or it slept
    return known && state.is_awake(body) ? near_[c] : state.bound[c];
  };
  const auto is_plane = [&](int collider) {
    return kind_[static_cast<std::size_t>(collider)] == Kind::plane;
  };
  if (is_plane(record.pair.a) || is_plane(record.pair.b)) return true;
  return box(record.pair.a, record.a).overlaps(box(record.pair.b, record.b));
}

bool Crowd::may_step(const CollisionState& state, const Island& island) const {
  const World& world = state.world();
  for (const Eigen::Index i : island.bodies) {
    const auto k = static_cast<std::size_t>(i);
    const HeldWrench& held = world.held[k];
    if (may_step_[k] == 0 || !held.in_B.force.isZero(0) || !held.in_B.torque.isZero(0) ||
        !held.moment.isZero(0))
      return false;
  }
  if (!has_mesh_) return true;
  return std::none_of(island.records.begin(), island.records.end(), [&](int r) {
    const PairRecord& record = state.pairs.records()[static_cast<std::size_t>(r)];
    return kind_[static_cast<std::size_t>(record.pair.a)] == Kind::mesh ||
           kind_[static_cast<std::size_t>(record.pair.b)] == Kind::mesh;
  });
}

// Bodies of the island that something stands on or that stand on something.
std::size_t Crowd::count_standing(const CollisionState& state, const Island& island) {
  for (const Eigen::Index i : island.bodies) level_[static_cast<std::size_t>(i)] = 0;
  for (const int r : island.records) {
    const PairRecord& record = state.pairs.records()[static_cast<std::size_t>(r)];
    if (!record.standing) continue;
    for (const int body : {record.a, record.b})
      if (state.is_awake(body)) level_[static_cast<std::size_t>(body)] = 1;
  }
  return static_cast<std::size_t>(
      std::count_if(island.bodies.begin(), island.bodies.end(),
                    [&](Eigen::Index i) { return level_[static_cast<std::size_t>(i)] != 0; }));
}

bool Crowd::takes(const CollisionState& state, const Island& island, std::span<const double> strain,
                  double duration) {
  const ContactSolverKind kind = state.def.contact_solver;
  if (kind == ContactSolverKind::convex_newton || !may_step(state, island)) return false;
  if (kind == ContactSolverKind::soft_step) return true;
  if (is_forced(island) || island.bodies.size() > kMostDirect) return true;
  const std::size_t standing = count_standing(state, island);
  bool promoted = false, rests = true;
  for (const Eigen::Index i : island.bodies) {
    const auto k = static_cast<std::size_t>(i);
    const double way = crowd_travel(state, i, angular_velocity(state.world(), i), duration);
    if (way > kLook * state.least_size[k] && standing <= kMostMoving) return false;
    const bool slow =
        duration * linear_velocity(state.world(), i).norm() <= kSlow * state.least_size[k];
    rests = rests && slow;
    if (has(i) && slow && strain[k] > kStrained * state.def.contact_tolerance)
      promoted_[k] = kPromotedFrames;
    promoted = promoted || promoted_[k] > 0;
  }
  if (standing > (rests && !usual_ ? kMostDirect : kMostMoving)) return true;
  return !promoted && is_easy(state, island);
}

// Whether soft_step is accurate enough for an island, by its size, its masses and its depth.
bool Crowd::is_easy(const CollisionState& state, const Island& island) {
  if (state.def.contact_tolerance < kSoftTolerance || island.bodies.size() <= kFewDirect)
    return false;
  const World& world = state.world();
  double lightest = std::numeric_limits<double>::infinity(), heaviest = 0;
  for (const Eigen::Index i : island.bodies) {
    lightest = std::min(lightest, world.mass[static_cast<std::size_t>(i)]);
    heaviest = std::max(heaviest, world.mass[static_cast<std::size_t>(i)]);
  }
  if (heaviest >= kMostRatio * lightest) return false;
  return is_shallow(state, island);
}

// Whether no body is more than kMostLevels contacts away from what does not move.
bool Crowd::is_shallow(const CollisionState& state, const Island& island) {
  if (island.bodies.size() <= static_cast<std::size_t>(kMostLevels)) return true;
  constexpr int kUnknown = kMostLevels + 1;
  for (const Eigen::Index i : island.bodies) level_[static_cast<std::size_t>(i)] = kUnknown;
  const auto level = [&](int body) {
    return state.is_awake(body) ? level_[static_cast<std::size_t>(body)] : 0;
  };
  for (int sweep = 0, changed = 1; changed != 0 && sweep < kMostLevels; ++sweep) {
    changed = 0;
    for (const int r : island.records) {
      const PairRecord& record = state.pairs.records()[static_cast<std::size_t>(r)];
      if (!record.standing) continue;
      for (const auto& [body, other] : {std::pair{record.a, record.b}, {record.b, record.a}}) {
        if (level(body) <= level(other) + 1) continue;
        level_[static_cast<std::size_t>(body)] = level(other) + 1;
        changed = 1;
      }
    }
  }
  return std::all_of(island.bodies.begin(), island.bodies.end(), [&](Eigen::Index i) {
    return level_[static_cast<std::size_t>(i)] <= kMostLevels;
  });
}

}  // namespace poinsot
