#include "poinsot/collision/frame_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "poinsot/collision/proximity.h"
#include "poinsot/collision/reach.h"

namespace poinsot {
namespace {

constexpr double kForEver = std::numeric_limits<double>::infinity();
// Bodies that nothing happens to are flown this many at a time: sums do not depend on the threads.
constexpr std::size_t kFlownTogether = 256;
// Room beside the boxes of excited bodies, so that they last: of the size.
constexpr double kRoom = 0.1;
// Boxes that reach farther than needed by more than this, of the bounding radius, are made anew.
constexpr double kSpare = 0.5;
// An impact may give a body up to twice the speed at which it happens.
constexpr double kThrown = 2;
// Restarts widen the boxes of strays; from this one on they hold everything.
constexpr int kLastNarrow = 6;
constexpr double kEverywhere = 1e9;  // [m]
// Larger islands are not solved directly, not even to prove that they rest.
constexpr std::size_t kMostProven = 400;
// An island that strays more often than this joins the crowd, if it can be stepped so.
constexpr int kMostAlone = 8, kMostAloneIfUsual = 3;
// No motion that is any needs more; what is left of a frame then ends all the same.
constexpr int kMostRestarts = 16;

}  // namespace

FrameMotion::FrameMotion(const Scene& scene)
    : state_(scene),
      team_(std::max(1, scene.collision.threads)),
      broad_phase_(state_.colliders),
      islands_(scene.bodies.size()),
      crowd_(state_),
      crowd_step_(state_),
      sleep_(scene.bodies.size()),
      rules_(scene),
      bounded_(scene.bodies.size(), 0),
      excited_(scene.bodies.size(), 0),
      thrown_(scene.bodies.size(), 0) {
  for (int k = 0; k < team_.size(); ++k) motions_.emplace_back(state_);
  tired_.reserve(scene.bodies.size());
  for (Eigen::Index i = 0; i < state_.world().size(); ++i)
    if (!state_.world().moves(i) && !state_.world().is_kinematic(i)) place_resting(i);
}

// A body that does not move: its boxes and its course hold for ever.
void FrameMotion::place_resting(Eigen::Index i) {
  const World& world = state_.world();
  const Pose pose{position(world.y, i), orientation(world.y, i)};
  for (const Collider& collider : state_.colliders_of(i)) {
    const auto k = static_cast<int>(&collider - state_.colliders.data());
    broad_phase_.set_moves(k, false);
    if (const auto* plane = std::get_if<HalfSpace>(&collider.shape)) {
      const Pose placed = collider_pose(collider, pose);
      const Vec3 normal = placed.q * plane->normal;
      broad_phase_.set_plane(k, normal, plane->offset + normal.dot(placed.c));
      continue;
    }
    state_.bound[static_cast<std::size_t>(k)] = bounds(collider, collider_pose(collider, pose));
    broad_phase_.set(k, state_.bound[static_cast<std::size_t>(k)]);
  }
  state_.bounds_until[static_cast<std::size_t>(i)] = kForEver;
  state_.body_time[static_cast<std::size_t>(i)] = world.time;
  state_.course(i, kForEver, false, motions_.front().worker());
  boxes_changed_ = true;
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
    return;
  }
  state_.simulation.begin(t_end);
  Tally tally;
  SearchWork work;
  {
    const Stopwatch::WallLap lap(times.collision.wall_s);
    if (touched_) sleep_.wake_changed(state_);
    touched_ = false;
    settle_courses();
    state_.simulation.freeze_unsound(awake_, tally);  // before any geometry query
    if (tally.quarantined > 0) place_frozen();
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
        boxes_changed_ = true;
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
  const auto c = static_cast<int>(&collider - state_.colliders.data());
  state_.bound[static_cast<std::size_t>(c)] = box;
  broad_phase_.set(c, box);
  broad_phase_.set_moves(c, true);
}

// `more` [m]: beside what the body reaches by itself.
void FrameMotion::set_bound(Eigen::Index i, double until, double more) {
  const auto k = static_cast<std::size_t>(i);
  for (const Collider& collider : state_.colliders_of(i))
    place_box(collider, reach_box(state_, collider, state_.world().time, until).grown(more));
  bounded_[k] = state_.stamp[k];
  state_.bounds_until[k] = until;
  boxes_changed_ = true;
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

void FrameMotion::run_islands(double t_end, CollisionReport& report, CollisionTimes& times) {
  const Stopwatch::WallLap lap(times.collision.wall_s);
  for (int attempt = 0;; ++attempt) {
    const std::span<Island> islands = islands_.all();
    for (IslandMotion& motion : motions_) motion.watches = attempt < kMostRestarts;
    const auto advance = [&](std::size_t k, int thread) {
      Island& island = islands[k];
      if (island.done || island.crowd) return;
      motions_[static_cast<std::size_t>(thread)].advance(state_, island, t_end, islands_.island_of);
      island.done = island.strays.empty();
    };
    if (attempt < kMostRestarts) {
      team_.run(islands.size(), advance);
    } else {  // they may look at one another: one after the other, whatever the team
      for (std::size_t k = 0; k < islands.size(); ++k) advance(k, 0);
    }
    if (attempt > kMostRestarts)
      for (Island& island : islands) island.done = true;
    if (std::all_of(islands.begin(), islands.end(),
                    [](const Island& i) { return i.done || i.crowd; }))
      break;
    ++report.restarts;
    gather_strays(t_end, attempt);
  }
  for (IslandMotion& motion : motions_) {
    times.contact.wall_s += motion.contact_wall_s / team_.size();
    times.collision.wall_s -= motion.contact_wall_s / team_.size();
    motion.contact_wall_s = 0;
  }
}

// Bodies that left their boxes, or were met outside their islands: next time they are together.
void FrameMotion::gather_strays(double t_end, int attempt) {
  const double h = t_end - state_.world().time;
  strays_.clear();
  left_.clear();
  for (Island& island : islands_.all()) {
    if (island.done || island.crowd) continue;
    for (const Eigen::Index i : island.bodies) excited_[static_cast<std::size_t>(i)] = 1;
    // An island that goes wherever it may is no island: the crowd takes it.
    if (attempt >= (crowd_.is_usual() ? kMostAloneIfUsual : kMostAlone))
      for (const Eigen::Index i : island.bodies) crowd_.force(i);
    const int own = islands_.island_of[static_cast<std::size_t>(island.bodies.front())];
    for (const Eigen::Index i : island.strays)
      (islands_.island_of[static_cast<std::size_t>(i)] == own ? left_ : strays_).push_back(i);
    island.restore(state_);
  }
  // Islands that are done are at the end of the frame: those that strays belong to go back first.
  const auto put_back = [&](Eigen::Index i) {
    const int of = islands_.island_of[static_cast<std::size_t>(i)];
    if (of < 0 || !islands_.all()[static_cast<std::size_t>(of)].done) return;
    Island& island = islands_.all()[static_cast<std::size_t>(of)];
    island.restore(state_);
    island.done = false;
  };
  const auto put_neighbours_back = [&](Eigen::Index i) {
    put_back(i);
    for (const int r : state_.pairs.of(i)) {
      put_back(state_.pairs[r].a);
      put_back(state_.pairs[r].b);
    }
  };
  for (const Eigen::Index i : left_) put_neighbours_back(i);
  const auto neighbours_speed = [&](Eigen::Index i) {
    double speed = fastest_point(state_, i, h);
    for (const int r : state_.pairs.of(i)) {
      const PairRecord& record = state_.pairs[r];
      speed = std::max(speed, fastest_point(state_, record.a == i ? record.b : record.a, h));
    }
    return speed;
  };
  for (const Eigen::Index i : left_) {
    const double wider = kThrown * std::pow(4.0, attempt + 1) * neighbours_speed(i);
    excite(i, t_end, attempt < kLastNarrow ? wider : kEverywhere / h);
  }
  // Those that touch a stray now are likely to be the next.
  for (std::size_t k = 0; k < strays_.size(); ++k) {
    const Eigen::Index i = strays_[k];
    put_neighbours_back(i);
    if (state_.asleep[static_cast<std::size_t>(i)] != 0) sleep_.wake(state_, i);
    excite(i, t_end, kThrown * neighbours_speed(i));
    for (const int r : state_.pairs.of(i)) {
      const PairRecord& record = state_.pairs[r];
      const Eigen::Index other = record.a == i ? record.b : record.a;
      const bool known = !state_.is_awake(other) || excited_[static_cast<std::size_t>(other)] != 0;
      if (known || !touches_now(record)) continue;
      excited_[static_cast<std::size_t>(other)] = 1;  // once is enough
      strays_.push_back(other);
    }
  }
  update_pairs();
  crowd_.find_idle(state_, team_);
  islands_.partition(state_, excited_, false);
  choose_crowd(t_end);
}

// Of the islands of a new partition: which are stepped with the crowd; the others can go back.
void FrameMotion::choose_crowd(double t_end) {
  const double duration = t_end - state_.world().time;
  for (std::size_t k = 0; k < excited_.size(); ++k)
    if (islands_.island_of[k] < 0)
      crowd_.set_member(static_cast<Eigen::Index>(k), crowd_.is_everybody());
  for (Island& island : islands_.all()) {
    if (!island.fresh) continue;
    island.fresh = false;
    const bool crowd = crowd_.takes(state_, island, crowd_step_, duration);
    const bool was = std::any_of(island.bodies.begin(), island.bodies.end(),
                                 [&](Eigen::Index i) { return crowd_.had(i); });
    // Who was looked at as one of the crowd has no boxes for anything else, and who was not may
    // touch others that are not in the island: both change a frame later.
    island.crowd = was ? crowd || crowd_.may_step(state_, island)
                       : crowd && (crowd_.is_forced(island) || island.bodies.size() > kMostProven);
    for (const Eigen::Index i : island.bodies) crowd_.set_member(i, crowd);
    if (island.crowd) {
      island.result.clear();
      island.strays.clear();
      continue;
    }
    for (const int r : island.records) state_.pairs.make_contact(state_.pairs[r]);
    island.save(state_);
  }
}

void FrameMotion::run_crowd(double t_end, CollisionReport& report, CollisionTimes& times) {
  crowd_islands_.clear();
  crowd_result_ = {};
  for (Island& island : islands_.all())
    if (island.crowd) crowd_islands_.push_back(&island);
  if (crowd_islands_.empty()) return;
  const Stopwatch::WallLap lap(times.contact.wall_s);
  crowd_result_ = crowd_step_.advance(state_, crowd_islands_, t_end, team_);
  for (Island* island : crowd_islands_) island->done = true;
  report.contacts += crowd_result_.outcome.pushing;
  report.max_penetration = std::max(report.max_penetration, crowd_result_.outcome.max_penetration);
  report.impact_loss += crowd_result_.outcome.loss;
  report.push_out_energy += crowd_result_.outcome.push_out_energy;
  report.soft_bodies = crowd_result_.bodies;
  report.contact_residual = crowd_result_.outcome.residual;
}

void FrameMotion::place_frozen() {
  for (Eigen::Index i = 0; i < state_.world().size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (state_.world().motion[k] != Motion::frozen || state_.bounds_until[k] == kForEver) continue;
    state_.change_course(i);
    place_resting(i);
  }
}

void FrameMotion::put_to_sleep() {
  sleep_.next_frame();
  const std::span<Island> islands = islands_.all();
  tired_.assign(islands.size(), 0);
  for (std::size_t k = 0; k < islands.size(); ++k) {
    const bool provable = !islands[k].crowd || islands[k].bodies.size() <= kMostProven;
    tired_[k] = provable && sleep_.may_sleep(state_, islands[k]) ? 1 : 0;
    if (tired_[k] != 0 && islands[k].crowd)
      for (const int r : islands[k].records) state_.pairs.make_contact(state_.pairs[r]);
  }
  team_.run(islands.size(), [&](std::size_t k, int thread) {
    if (tired_[k] != 0)
      tired_[k] =
          motions_[static_cast<std::size_t>(thread)].proves_rest(state_, islands[k]) ? 1 : 0;
  });
  for (std::size_t k = 0; k < islands.size(); ++k)
    if (tired_[k] != 0) sleep_.lay_down(state_, islands[k]);
}

bool FrameMotion::touches_now(const PairRecord& record) const {
  const World& world = state_.world();
  const auto pose = [&](int collider) {
    const Collider& shape = state_.colliders[static_cast<std::size_t>(collider)];
    return collider_pose(shape, {position(world.y, shape.body), orientation(world.y, shape.body)});
  };
  const Collider& a = state_.colliders[static_cast<std::size_t>(record.pair.a)];
  const Collider& b = state_.colliders[static_cast<std::size_t>(record.pair.b)];
  const Pose pose_a = pose(record.pair.a), pose_b = pose(record.pair.b);
  const double touch = state_.touch(record);
  if ((pose_a.c - pose_b.c).norm() > a.bounding_radius + b.bounding_radius + touch) return false;
  return find_gap(a, pose_a, b, pose_b).value <= touch;
}

void FrameMotion::hash_into(Hash64& hash) const {
  state_.pairs.hash_into(hash);
  sleep_.hash_into(hash);
  crowd_.hash_into(hash);
  state_.simulation.hash_into(hash);
}

void FrameMotion::contact_forces(std::vector<ContactForce>& forces) const {
  forces.clear();
  for (const PairRecord& record : state_.pairs.records()) {
    if (!record.standing) continue;
    if (record.by_crowd) {
      crowd_step_.add_forces(state_, record, forces);
      continue;
    }
    const PairContact* contact = state_.pairs.find_contact(record);
    if (contact == nullptr || !(contact->last_h > 0)) continue;
    for (const PairPoint& p : contact->points)
      if (p.normal_impulse > 0)
        forces.push_back({record.a, record.b, p.position, p.normal,
                          (p.normal_impulse * p.normal + p.friction_impulse) / contact->last_h});
  }
}

void FrameMotion::fly_the_rest(double t_end, Tally& tally) {
  const World& world = state_.world();
  rest_.clear();
  for (Eigen::Index i = 0; i < world.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (islands_.island_of[k] >= 0) continue;
    if (state_.is_awake(i) || world.is_kinematic(i)) rest_.push_back(i);
  }
  const std::size_t parts = (rest_.size() + kFlownTogether - 1) / kFlownTogether;
  rest_tallies_.assign(parts, {});
  const double from = world.time;
  const auto fly = [&](std::size_t part, int thread) {
    const std::size_t first = part * kFlownTogether;
    const std::span<const Eigen::Index> bodies(rest_.data() + first,
                                               std::min(kFlownTogether, rest_.size() - first));
    state_.simulation.advance(bodies, from, t_end, false,
                              motions_[static_cast<std::size_t>(thread)].worker(),
                              rest_tallies_[part]);
  };
  if (world.systems.empty()) {
    team_.run(parts, fly);
  } else {  // a system may have bodies in several parts
    for (std::size_t part = 0; part < parts; ++part) fly(part, 0);
  }
  for (const Tally& part : rest_tallies_) tally.add_apart(part);
}

void FrameMotion::close(double t_end, CollisionReport& report, std::vector<ImpactEvent>& impacts,
                        const Tally& tally) {
  Tally all = tally;
  all.add_apart(crowd_result_.tally);
  report.islands = static_cast<std::uint32_t>(islands_.all().size());
  for (Island& island : islands_.all()) {
    const Island::Result& result = island.result;
    all.add_apart(result.tally);
    report.contacts += result.contacts;
    report.max_penetration = std::max(report.max_penetration, result.max_penetration);
    report.impact_loss += result.impact_loss;
    report.push_out_energy += result.push_out_energy;
    report.impacts += result.impacts;
    report.crowded |= result.crowded;
    if (result.solved) report.direct_bodies += static_cast<std::uint32_t>(island.bodies.size());
    report.contact_residual = std::max(report.contact_residual, result.residual);
    report.solver_iterations += result.iterations;
    report.unconverged += result.unconverged;
    report.searches += static_cast<std::uint32_t>(result.work.searches);
    report.search_poses += result.work.poses;
    report.search_gaps += result.work.gaps;
    impacts.insert(impacts.end(), result.events.begin(), result.events.end());
  }
  state_.simulation.commit(t_end, all);
  if (all.quarantined > 0) place_frozen();
  if (state_.def.sleeping) put_to_sleep();
  report.asleep = sleep_.asleep();
}

}  // namespace poinsot
