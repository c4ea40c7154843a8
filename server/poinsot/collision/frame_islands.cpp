// The second half of a frame: islands are gone through, again with those they stray to, and the
// crowd, and all is closed.

#include <algorithm>
#include <cmath>

#include "poinsot/collision/frame_motion.h"
#include "poinsot/collision/proximity.h"
#include "poinsot/collision/reach.h"

namespace poinsot {
namespace {

// Bodies that nothing happens to are flown this many at a time: sums do not depend on the threads.
constexpr std::size_t kFlownTogether = 256;
// Bodies of the crowd that are stepped together: what they need fits into the cache of a core.
constexpr std::size_t kBatch = 256;
// Restarts widen the boxes of strays; from this one on they hold everything.
constexpr int kLastNarrow = 6;
constexpr double kEverywhere = 1e9;  // [m]
// An island that strays more often than this joins the crowd, if it can be stepped so.
constexpr int kMostAlone = 8, kMostAloneIfUsual = 3;
// No motion that is any needs more; what is left of a frame then ends all the same.
constexpr int kMostRestarts = 16;

}  // namespace

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
    const bool crowd = crowd_.takes(state_, island, strain_, duration);
    const bool was = std::any_of(island.bodies.begin(), island.bodies.end(),
                                 [&](Eigen::Index i) { return crowd_.had(i); });
    // Who was looked at as one of the crowd has no boxes for anything else, and who was not may
    // touch others that are not in the island: both change a frame later.
    island.crowd = was ? crowd || crowd_.may_step(state_, island)
                       : crowd && (crowd_.is_forced(island) || island.bodies.size() > kMostDirect);
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

// Small islands are stepped together, in their order.
void FrameMotion::gather_batches() {
  crowd_islands_.clear();
  batches_.clear();
  for (Island& island : islands_.all()) {
    if (!island.crowd) continue;
    for (const int r : island.records) state_.pairs.make_crowd_contact(state_.pairs[r]);
    const std::size_t bodies = island.bodies.size();
    if (batches_.empty() || batches_.back().bodies + bodies > kBatch)
      batches_.push_back({crowd_islands_.size(), 0, 0, {}});
    ++batches_.back().count;
    batches_.back().bodies += bodies;
    crowd_islands_.push_back(&island);
  }
}

void FrameMotion::run_crowd(double t_end, CollisionReport& report, CollisionTimes& times) {
  const Stopwatch::WallLap lap(times.contact.wall_s);
  gather_batches();
  const auto step = [&](Batch& batch, CrowdStep& by, Team& team) {
    const std::span islands(crowd_islands_.data() + batch.first, batch.count);
    batch.result = by.advance(state_, islands, t_end, team, strain_);
  };
  for (Batch& batch : batches_)
    if (batch.bodies > kBatch) step(batch, crowd_steps_.front(), team_);
  team_.run(batches_.size(), [&](std::size_t k, int thread) {
    if (batches_[k].bodies <= kBatch)
      step(batches_[k], crowd_steps_[static_cast<std::size_t>(thread)], alone_);
  });
  for (Island* island : crowd_islands_) island->done = true;
  for (const Batch& batch : batches_) {
    const SoftOutcome& outcome = batch.result.outcome;
    report.contacts += outcome.pushing;
    report.max_penetration = std::max(report.max_penetration, outcome.max_penetration);
    report.impact_loss += outcome.loss;
    report.push_out_energy += outcome.push_out_energy;
    report.soft_bodies += batch.result.bodies;
    report.contact_residual = std::max(report.contact_residual, outcome.residual);
  }
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

void FrameMotion::put_to_sleep() {
  sleep_.next_frame();
  const std::span<Island> islands = islands_.all();
  tired_.assign(islands.size(), 0);
  for (std::size_t k = 0; k < islands.size(); ++k) {
    const bool provable = !islands[k].crowd || islands[k].bodies.size() <= kMostDirect;
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
  const bool apart = std::all_of(world.systems.begin(), world.systems.end(),
                                 [](const BodySystem& s) { return s.columns.size() == 1; });
  if (apart) {
    team_.run(parts, fly);
  } else {  // a system may have bodies in several parts
    for (std::size_t part = 0; part < parts; ++part) fly(part, 0);
  }
  for (const Tally& part : rest_tallies_) tally.add_apart(part);
}

void FrameMotion::close(double t_end, CollisionReport& report, std::vector<ImpactEvent>& impacts,
                        const Tally& tally) {
  Tally all = tally;
  for (const Batch& batch : batches_) all.add_apart(batch.result.tally);
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

void FrameMotion::contact_forces(std::vector<ContactForce>& forces) const {
  forces.clear();
  for (const PairRecord& record : state_.pairs.records()) {
    if (!record.standing) continue;
    if (record.by_crowd) {
      CrowdStep::add_forces(state_, record, forces);
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

// Digests of their own do not wait for one another.
void FrameMotion::hash_into(Hash64& hash) const {
  for (std::size_t c = 0; c < state_.bound.size(); ++c) {
    Hash64 box;
    box.add(std::span(state_.bound[c].low.data(), 3));
    box.add(std::span(state_.bound[c].high.data(), 3));
    box.add(state_.bounds_until[static_cast<std::size_t>(state_.colliders[c].body)]);
    hash.add(box.value());
  }
  for (const double strain : strain_)
    if (strain > 0) hash.add(strain);
  state_.pairs.hash_into(hash);
  sleep_.hash_into(hash);
  crowd_.hash_into(hash);
  state_.simulation.hash_into(hash);
}

}  // namespace poinsot
