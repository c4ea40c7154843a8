#include "poinsot/collision/frame_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "poinsot/collision/reach.h"

namespace poinsot {
namespace {

constexpr double kForEver = std::numeric_limits<double>::infinity();
// Room beside the boxes of excited bodies, so that they last: of the size.
constexpr double kRoom = 0.1;
// Boxes that reach farther than needed by more than this, of the bounding radius, are made anew.
constexpr double kSpare = 0.5;

}  // namespace

FrameMotion::FrameMotion(const Scene& scene)
    : state_(scene),
      team_(std::max(1, scene.collision.threads)),
      broad_phase_(state_.colliders),
      islands_(scene.bodies.size()),
      crowd_(state_),
      strain_(scene.bodies.size(), 0),
      sleep_(scene.bodies.size()),
      rules_(scene),
      bounded_(scene.bodies.size(), 0),
      excited_(scene.bodies.size(), 0),
      thrown_(scene.bodies.size(), 0) {
  for (int k = 0; k < team_.size(); ++k) {
    motions_.emplace_back(state_);
    crowd_steps_.emplace_back(state_);
  }
  tired_.reserve(scene.bodies.size());
  for (Eigen::Index i = 0; i < state_.world().size(); ++i)
    if (!state_.world().moves(i) && !state_.world().is_kinematic(i)) place_resting(i);
}

// Courses of tethered bodies begin afresh in every frame, as those of all driven ones do.
void FrameMotion::set_tethers(std::span<const Tether> tethers) {
  const World& world = state_.world();
  const TetherChange change = state_.simulation.set_tethers(tethers);
  if (change != TetherChange::joined) return;
  for (IslandMotion& motion : motions_) motion.worker().prepare(world);
  for (Eigen::Index i = 0; i < world.size(); ++i) crowd_.look_at_forces(world, i);
  for (const Tether& tether : world.tethers)
    if (state_.asleep[static_cast<std::size_t>(tether.column)] != 0)
      sleep_.wake(state_, tether.column);
  rests_ = false;
}

void FrameMotion::advance_to(double t_end, CollisionReport& report,
                             std::vector<ImpactEvent>& impacts, CollisionTimes& times) {
  impacts.clear();
  crowd_.next_frame();
  report.islands = report.restarts = report.searches = report.impacts = 0;
  report.search_poses = report.search_gaps = 0;
  report.contacts = 0;
  report.max_penetration = 0;
  report.crowded = false;
  report.soft_bodies = report.direct_bodies = report.solver_iterations = report.unconverged = 0;
  report.contact_residual = 0;
  if (rests_ && !touched_ && std::isfinite(t_end) && t_end >= state_.world().time) {
    state_.simulation.commit(t_end, {});
    if (state_.def.sleeping) sleep_.next_frame();
    return;
  }
  state_.simulation.begin(t_end);
  Tally tally;
  SearchWork work;
  {
    const Stopwatch::WallLap lap(times.collision.wall_s);
    if (shapes_changed_) fit_to_shapes();
    if (touched_) sleep_.wake_changed(state_);
    touched_ = false;
    settle_courses();
    state_.simulation.freeze_unsound(awake_, tally);  // before any geometry query
    if (tally.quarantined > 0) place_frozen();
    wake_touched();
    set_bounds(t_end);
    update_pairs();
    find_excited(t_end, work);
    islands_.partition(state_, excited_, true);
    choose_crowd(t_end);
  }
  run_islands(t_end, report, times);
  run_crowd(t_end, report, times);
  {
    const Stopwatch::WallLap lap(times.simulation.wall_s);
    fly_the_rest(t_end, tally);
  }
  report.searches = static_cast<std::uint32_t>(work.searches);
  report.search_poses = work.poses;
  report.search_gaps = work.gaps;
  close(t_end, report, impacts, tally);
}

// A course goes on only while its body flies and nobody else has touched it.
void FrameMotion::settle_courses() {
  const World& world = state_.world();
  awake_.clear();
  bool moving = false;
  for (Eigen::Index i = 0; i < world.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    excited_[k] = 0;
    if (world.is_kinematic(i)) {
      moving = true;
      state_.body_time[k] = world.time;
      continue;
    }
    if (!state_.is_awake(i)) continue;
    moving = true;
    awake_.push_back(i);
    state_.body_time[k] = world.time;
    if (state_.simulation.is_driven(i) || !state_.simulation.is_in_flight(i))
      state_.change_course(i);
  }
  rests_ = !moving;
}

void FrameMotion::set_bounds(double t_end) {
  const World& world = state_.world();
  crowd_.look(state_, t_end - world.time, team_);
  for (Eigen::Index i = 0; i < world.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (!state_.is_awake(i) && !world.is_kinematic(i)) continue;
    if (state_.arm[k] == 0 && state_.colliders_of(i).empty()) continue;
    if (crowd_.has(i)) {
      const double h = t_end - world.time;
      if (!crowd_.fits(i)) {
        for (const Collider& collider : state_.colliders_of(i))
          place_box(collider, crowd_.roomy_box(state_, collider, h));
      }
      bounded_[k] = state_.stamp[k];
      state_.bounds_until[k] = t_end;
      continue;
    }
    if (bounded_[k] == state_.stamp[k] && state_.bounds_until[k] >= t_end) continue;
    bool inside = bounded_[k] != state_.stamp[k];  // boxes that were made with room may do
    for (const Collider& collider : state_.colliders_of(i)) {
      if (!inside) break;
      const Aabb& bound =
          state_.bound[static_cast<std::size_t>(&collider - state_.colliders.data())];
      const Aabb reach = reach_box(state_, collider, world.time, t_end);
      const Vec3 spare = (bound.high - bound.low) - (reach.high - reach.low);
      inside = bound.contains(reach) && spare.maxCoeff() <= 2 * kSpare * collider.bounding_radius;
    }
    if (inside) {
      bounded_[k] = state_.stamp[k];
      state_.bounds_until[k] = t_end;
    } else {
      set_bound(i, worthwhile(state_, i, world.time, t_end), 0);
    }
    if (world.is_kinematic(i)) state_.course(i, kForEver, false, motions_.front().worker());
  }
}

void FrameMotion::place_box(const Collider& collider, const Aabb& box) {
  state_.bound[static_cast<std::size_t>(&collider - state_.colliders.data())] = box;
  show(collider);
}

// `more` [m]: beside what the body reaches by itself.
void FrameMotion::set_bound(Eigen::Index i, double until, double more) {
  const auto k = static_cast<std::size_t>(i);
  for (const Collider& collider : state_.colliders_of(i))
    place_box(collider, reach_box(state_, collider, state_.world().time, until).grown(more));
  bounded_[k] = state_.stamp[k];
  state_.bounds_until[k] = until;
}

void FrameMotion::update_pairs() {
  if (!boxes_changed_) return;
  boxes_changed_ = false;
  const World& world = state_.world();
  state_.pairs.update(broad_phase_.pairs(), [&](PairRecord& record) {
    const Collider& a = state_.colliders[static_cast<std::size_t>(record.pair.a)];
    const Collider& b = state_.colliders[static_cast<std::size_t>(record.pair.b)];
    if (!world.moves(a.body) && !world.moves(b.body)) return false;
    const PairRule rule = rules_.rule(a.body, b.body);
    if (!rule.collide) return false;
    record.a = static_cast<int>(a.body);
    record.b = static_cast<int>(b.body);
    record.size = std::min(a.size, b.size);
    record.friction = rule.friction;
    record.restitution = rule.restitution;
    return true;
  });
}

// Bodies to which something may happen before t_end: those of pairs that touch or may meet.
void FrameMotion::find_excited(double t_end, SearchWork& work) {
  IslandMotion& motion = motions_.front();
  const bool searches = state_.def.impact_search != ImpactSearchKind::none;
  crowd_.find_idle(state_, team_);
  bool all_crowd = true;  // whatever is excited
  bool again = true;
  while (again) {  // until nobody else is woken
    again = false;
    for (PairRecord& record : state_.pairs.records()) {
      const bool awake_a = state_.is_awake(record.a), awake_b = state_.is_awake(record.b);
      const bool carried =
          state_.world().is_kinematic(record.a) || state_.world().is_kinematic(record.b);
      if (!awake_a && !awake_b && !carried) continue;
      if (record.idle) continue;
      const bool crowd = crowd_.has(record.a) || crowd_.has(record.b);
      bool hot = record.standing || !searches || crowd;
      if (!hot) {
        const double lasting = std::min(state_.bounds_until[static_cast<std::size_t>(record.a)],
                                        state_.bounds_until[static_cast<std::size_t>(record.b)]);
        motion.look_ahead(state_, record, state_.world().time, t_end, lasting, work);
        hot = record.meeting != Meeting::none && record.safe_until <= t_end;
      }
      if (!hot) continue;
      all_crowd = all_crowd && crowd_.has(record.a) == state_.is_awake(record.a) &&
                  crowd_.has(record.b) == state_.is_awake(record.b);
      for (const int body : {record.a, record.b}) {
        const auto k = static_cast<std::size_t>(body);
        if (state_.asleep[k] != 0 && (searches || crowd)) {
          sleep_.wake(state_, body);
          again = true;
        }
        if (state_.is_awake(body)) excited_[k] = 1;
      }
    }
  }
  if (all_crowd) return;
  // What one impact among them may throw them to.
  const double h = t_end - state_.world().time;
  fastest_.assign(excited_.size(), -1);
  const auto fastest = [&](std::size_t k) {
    if (fastest_[k] < 0) fastest_[k] = fastest_point(state_, static_cast<Eigen::Index>(k), h);
    return fastest_[k];
  };
  for (const PairRecord& record : state_.pairs.records()) {
    const auto a = static_cast<std::size_t>(record.a), b = static_cast<std::size_t>(record.b);
    if (record.idle || (excited_[a] == 0 && excited_[b] == 0)) continue;
    if (crowd_.has(record.a) && crowd_.has(record.b)) continue;
    const double speed = fastest(a) + fastest(b);
    for (const std::size_t k : {a, b})
      if (excited_[k] != 0) thrown_[k] = std::max(thrown_[k], speed);
  }
  for (std::size_t k = 0; k < excited_.size(); ++k)
    if (excited_[k] != 0 && !crowd_.has(static_cast<Eigen::Index>(k))) {
      excite(static_cast<Eigen::Index>(k), t_end, kThrown * thrown_[k]);
    }
  std::fill(thrown_.begin(), thrown_.end(), 0);
  update_pairs();
}

// Makes sure that body i stays in its boxes with `speed` more than it has [m/s].
void FrameMotion::excite(Eigen::Index i, double t_end, double speed) {
  const double now = state_.world().time;
  const double more = speed * (t_end - now);
  bool inside = true;
  double size = kForEver;
  for (const Collider& collider : state_.colliders_of(i)) {
    const auto c = static_cast<std::size_t>(&collider - state_.colliders.data());
    inside =
        inside && state_.bound[c].contains(reach_box(state_, collider, now, t_end).grown(more));
    size = std::min(size, collider.size);
  }
  excited_[static_cast<std::size_t>(i)] = 1;
  if (!inside) set_bound(i, t_end, more + kRoom * size);
}

void FrameMotion::place_frozen() {
  for (Eigen::Index i = 0; i < state_.world().size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (state_.world().motion[k] != Motion::frozen || state_.bounds_until[k] == kForEver) continue;
    state_.change_course(i);
    place_resting(i);
  }
}

}  // namespace poinsot
