#include "poinsot/collision/island_motion.h"

#include <algorithm>
#include <cmath>

#include "poinsot/base/stopwatch.h"
#include "poinsot/collision/mesh_pairs.h"
#include "poinsot/collision/mesh_surface.h"
#include "poinsot/collision/point_arrival.h"
#include "poinsot/collision/proximity.h"
#include "poinsot/collision/reach.h"

namespace poinsot {
namespace {

// A frame is some four sub-steps long; a longer one may have more impacts.
constexpr double kUsualSteps = 4;
// Stopping an island whose contacts are stepped costs a solve of all its points: so many of them
// count as one impact more.
constexpr double kPointsPerImpact = 16;
// A sub-step is cut to no less than this part of itself.
constexpr double kLeastPart = 1.0 / 256;

bool is_known(const CollisionState& state, const PairRecord& record, double to) {
  return record.stamp_a == state.stamp[static_cast<std::size_t>(record.a)] &&
         record.stamp_b == state.stamp[static_cast<std::size_t>(record.b)] &&
         (record.safe_until >= to || record.meeting == Meeting::impact);
}

SearchResult search_by(ImpactSearchKind kind, const CoursePair& pair, const SearchSpan& span,
                       SearchMemory& memory, SearchWork& work) {
  switch (kind) {
    case ImpactSearchKind::backtracking:
      return search_backtracking(pair, span, memory, work);
    case ImpactSearchKind::continuous:
      return search_continuous(pair, span, memory, work);
    default:
      return search_conservative(pair, span, memory, work);
  }
}

// The normal of a triangle in W, on the side where most of the other shape is: a triangle has no
// inside, so that which side a touching shape comes from has to be known beforehand.
Vec3 side_of_face(const Collider& triangle, const Course& course, const Collider& other,
                  const Course& course_of_other, double t) {
  const Pose mesh = collider_pose(triangle, course.at(t));
  const Pose pose = collider_pose(other, course_of_other.at(t));
  const Vec3 n = mesh.q * triangle.surface->normal(triangle.triangle);
  const double face = n.dot(mesh * triangle.surface->corners(triangle.triangle)[0]);
  const auto reach = [&](const Vec3& d) {
    return d.dot(pose * support(other, pose.q.conjugate() * d)) + other.core_radius;
  };
  return reach(n) - face >= face + reach(-n) ? n : Vec3(-n);
}

}  // namespace

void IslandMotion::search(CollisionState& state, PairRecord& record, double t, double to,
                          double lasting, bool in_contact, SearchWork& work) {
  const auto a = static_cast<std::size_t>(record.a), b = static_cast<std::size_t>(record.b);
  const bool same = record.stamp_a == state.stamp[a] && record.stamp_b == state.stamp[b];
  const double from = same ? std::max(t, std::min(record.safe_until, to)) : t;
  const double horizon = std::max(to, lasting);
  const CoursePair pair{state.colliders[static_cast<std::size_t>(record.pair.a)],
                        state.course(record.a, horizon, in_contact, worker_),
                        state.colliders[static_cast<std::size_t>(record.pair.b)],
                        state.course(record.b, horizon, in_contact, worker_)};
  const SearchSpan span{from, horizon, state.touch(record)};
  const bool mesh =
      std::holds_alternative<Mesh>(pair.a.shape) || std::holds_alternative<Mesh>(pair.b.shape);
  const SearchResult found =
      mesh ? search_mesh(state, pair, span, work)
           : search_by(state.def.impact_search, pair, span, record.memory, work);
  record.stamp_a = state.stamp[a];
  record.stamp_b = state.stamp[b];
  record.safe_until = found.time;
  record.meeting = found.meeting;
  record.normal = found.normal;
  record.point = found.point;
}

// The first of all the triangles that the other shape may reach.
SearchResult IslandMotion::search_mesh(CollisionState& state, const CoursePair& pair,
                                       const SearchSpan& span, SearchWork& work) {
  const bool mesh_is_a = std::holds_alternative<Mesh>(pair.a.shape);
  const Collider& mesh = mesh_is_a ? pair.a : pair.b;
  const Collider& other = mesh_is_a ? pair.b : pair.a;
  const Course& course = mesh_is_a ? pair.course_a : pair.course_b;
  const MovingPose start = course.moving_at(span.from);
  const double carried = (span.to - span.from) * (start.velocity.linear.norm() +
                                                  state.arm[static_cast<std::size_t>(mesh.body)] *
                                                      start.velocity.angular.norm());
  triangles_.clear();
  triangles_near(mesh, collider_pose(mesh, start.pose),
                 state.bound[static_cast<std::size_t>(&other - state.colliders.data())].grown(
                     (course.moves() ? carried : 0) + span.touch),
                 triangles_);
  SearchResult first{Meeting::none, span.to, Vec3::Zero(), Vec3::Zero()};
  for (const int k : triangles_) {
    const Collider triangle = triangle_collider(mesh, k);
    const CoursePair one{mesh_is_a ? triangle : pair.a, pair.course_a,
                         mesh_is_a ? pair.b : triangle, pair.course_b};
    const Vec3 face =
        side_of_face(triangle, course, other, mesh_is_a ? pair.course_b : pair.course_a, span.from);
    SearchMemory memory{mesh_is_a ? Vec3(-face) : face};
    const SearchResult found =
        search_by(state.def.impact_search, one, {span.from, first.time, span.touch}, memory, work);
    if (found.meeting == Meeting::none) continue;
    if (first.meeting == Meeting::none || found.time < first.time) first = found;
  }
  return first;
}

void IslandMotion::look_ahead(CollisionState& state, PairRecord& record, double t, double to,
                              double lasting, SearchWork& work) {
  if (!is_known(state, record, to)) search(state, record, t, to, lasting, false, work);
}

void IslandMotion::advance(CollisionState& state, Island& island, double t_end,
                           std::span<const int> island_of) {
  island.result.clear();
  island.strays.clear();
  double t = state.world().time;
  const double usual = kUsualSteps * state.def.contact_step;
  const double impacts = state.def.max_impacts * std::max(1.0, (t_end - t) / usual);
  Frame frame{state,
              island,
              t_end,
              island_of,
              island_of[static_cast<std::size_t>(island.bodies.front())],
              impacts,
              std::max(kUsualSteps, (t_end - t) / usual * kUsualSteps),
              impacts * static_cast<double>(island.bodies.size()),
              state.def.impact_search == ImpactSearchKind::none};
  while (t < t_end && island.strays.empty()) {
    if (frame.crowded) {
      t = step_foreseeing(frame, t);
      continue;
    }
    const bool stands = std::any_of(island.records.begin(), island.records.end(),
                                    [&](int r) { return state.pairs[r].standing; });
    t = stands ? step_standing(frame, t) : fly(frame, t);
  }
  if (island.strays.empty()) bring_all(frame, t_end);
}

void IslandMotion::bring_all(Frame& frame, double t) {
  for (const Eigen::Index i : frame.island.bodies)
    frame.state.bring(i, t, worker_, frame.island.result.tally);
}

// Whether one more impact is located; if not, the rest of the frame is stepped.
bool IslandMotion::afford(Frame& frame, double& budget, double cost) {
  budget -= cost;
  if (budget >= 0) return true;
  frame.crowded = frame.island.result.crowded = true;
  return false;
}

IslandMotion::Meet IslandMotion::first_meeting(Frame& frame, double t, double to, bool in_contact) {
  CollisionState& state = frame.state;
  Meet first{-1, to, false};
  for (const int r : frame.island.records) {
    PairRecord& record = state.pairs[r];
    if (record.standing) continue;
    if (!is_known(state, record, to)) {
      const double lasting = std::min(state.bounds_until[static_cast<std::size_t>(record.a)],
                                      state.bounds_until[static_cast<std::size_t>(record.b)]);
      const bool stepped = in_contact && (step_.acts_on(record.a) || step_.acts_on(record.b));
      search(state, record, t, to, stepped ? to : lasting, in_contact, frame.island.result.work);
    }
    if (record.meeting == Meeting::none || record.safe_until > to) continue;
    for (const int body : {record.a, record.b})  // whom it wakes
      if (state.asleep[static_cast<std::size_t>(body)] != 0) frame.island.strays.push_back(body);
    if (record.meeting == Meeting::impact) {
      if (record.safe_until < first.time || first.record < 0) {
        first.record = r;
        first.time = record.safe_until;
      }
    } else {  // at rest, or too close for the search to tell
      record.standing = true;
      first.rests = true;
    }
  }
  return first;
}

double IslandMotion::fly(Frame& frame, double t) {
  const Meet first = first_meeting(frame, t, frame.t_end, false);
  if (!frame.island.strays.empty() || first.rests) return t;
  if (first.record < 0) {
    bring_all(frame, frame.t_end);
    return frame.t_end;
  }
  if (!afford(frame, frame.flights, 1)) return t;
  meet(frame, first);
  return first.time;
}

void IslandMotion::meet(Frame& frame, const Meet& at) {
  CollisionState& state = frame.state;
  response_.resolve(state, frame.island, frame.island_of, at.record, at.time, worker_);
  if (!frame.island.strays.empty()) return;
  PairRecord& record = state.pairs[at.record];
  const std::span<const Eigen::Index> changed = response_.changed();
  const bool takes_part = std::any_of(changed.begin(), changed.end(), [&](Eigen::Index i) {
    return i == record.a || i == record.b;
  });
  if (!takes_part) record.standing = true;  // it only seemed to approach
  for (const Eigen::Index i : response_.changed()) watch(frame, i, at.time);
}

// A body with a new course: whether it stays where its island can look after it.
void IslandMotion::watch(Frame& frame, Eigen::Index i, double t) {
  if (!watches) return;
  CollisionState& state = frame.state;
  for (const int r : state.pairs.of(i)) {
    const PairRecord& record = state.pairs[r];
    if (record.idle) continue;  // out of its reach while it keeps to its boxes
    const int other = record.a == i ? record.b : record.a;
    if (state.is_awake(other) && frame.island_of[static_cast<std::size_t>(other)] != frame.id)
      frame.island.strays.push_back(other);
  }
  for (const Collider& collider : state.colliders_of(i)) {
    const auto k = static_cast<std::size_t>(&collider - state.colliders.data());
    const Aabb reach = reach_box(state, collider, t, frame.t_end);
    const bool sound = reach.low.allFinite() && reach.high.allFinite();  // or it will be frozen
    if (!sound || state.bound[k].contains(reach)) continue;
    frame.island.strays.push_back(i);
    return;
  }
}

// Approaches that end within the sub-step by themselves.
bool IslandMotion::is_slow(Frame& frame, const PairRecord& record, double t, double h) {
  CollisionState& state = frame.state;
  const MovingPose a = state.moving_pose(record.a, t, true, worker_);
  const MovingPose b = state.moving_pose(record.b, t, true, worker_);
  const auto at = [&](const MovingPose& body) -> Vec3 {
    return body.velocity.linear + body.velocity.angular.cross(record.point - body.pose.c);
  };
  const double speed = -record.normal.dot(at(a) - at(b));
  const double fall = h * state.world().gravity.norm();
  return record.restitution > 0 ? 2 * record.restitution * speed < 0.1 * fall
                                : speed < kRestingSteps * fall;
}

// Whether nothing that touches moves noticeably before the frame ends, unless a force makes it.
bool IslandMotion::rests(const Frame& frame) const {
  const CollisionState& state = frame.state;
  const World& world = state.world();
  const double h = frame.t_end - world.time;
  return std::all_of(frame.island.bodies.begin(), frame.island.bodies.end(), [&](Eigen::Index i) {
    const double arm = state.arm[static_cast<std::size_t>(i)];
    const double speed = linear_velocity(world, i).norm() + arm * angular_velocity(world, i).norm();
    return h * speed <= state.def.contact_tolerance * arm;
  });
}

double IslandMotion::step_standing(Frame& frame, double t) {
  CollisionState& state = frame.state;
  const int steps = step_count(frame.t_end - t, state.def.contact_step);
  const double usual = (frame.t_end - t) / steps;
  const double h = rests(frame) ? frame.t_end - t : usual;
  double to = frame.t_end;
  ContactStep::Books books;
  ContactStep::Outcome outcome;
  Meet first;
  double arrivals = std::numeric_limits<double>::infinity();
  constexpr int kAttempts = 2;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    const Stopwatch::WallLap lap(contact_wall_s);
    step_.begin(state, h, usual, false, frame.stops > 0);
    for (const int r : frame.island.records) {
      if (!state.pairs[r].standing) continue;
      for (const int body : {state.pairs[r].a, state.pairs[r].b})
        state.bring(body, t, worker_, frame.island.result.tally);
      step_.add(state, r);
    }
    if (attempt > 0)  // what the attempt before found
      for (const Eigen::Index i : step_.movers())
        state.simulation.contact_wrenches()[static_cast<std::size_t>(i)] = Wrench{};
    const double cost = 1 + static_cast<double>(step_.points()) / kPointsPerImpact;
    if (cost > state.def.max_impacts) {  // too many to stop for anything
      if (attempt > 0) note(frame, outcome, books);
      frame.crowded = frame.island.result.crowded = true;
      return t;
    }
    outcome = step_.solve(state, books);
    to = step_.duration() < frame.t_end - t ? t + step_.duration() : frame.t_end;
    if (const double part = sound_part(state, step_.duration()); part < 1)
      to = t + part * step_.duration();
    for (const Eigen::Index i : step_.movers()) {
      state.bring(i, t, worker_, frame.island.result.tally);
      state.change_course(i);
    }
    first = first_meeting(frame, t, to, true);
    if (!frame.island.strays.empty()) break;
    bool again = first.rests;
    if (again) join_touching(frame, t);
    for (const int r : frame.island.records) {
      PairRecord& record = state.pairs[r];
      if (record.standing || record.meeting != Meeting::impact || record.safe_until > to ||
          !is_slow(frame, record, record.safe_until, h))
        continue;
      record.standing = again = true;
      if (attempt + 1 == kAttempts) arrivals = std::min(arrivals, record.safe_until);
      state.bring(record.a, t, worker_, frame.island.result.tally);
      state.bring(record.b, t, worker_, frame.island.result.tally);
    }
    if (!again) break;
    if (first.record >= 0 && state.pairs[first.record].standing) {
      first.record = -1;
      first.time = to;
      for (const int r : frame.island.records) {
        const PairRecord& record = state.pairs[r];
        if (record.standing || record.meeting != Meeting::impact || record.safe_until >= first.time)
          continue;
        first.record = r;
        first.time = record.safe_until;
      }
    }
  }
  if (arrivals > t && arrivals < first.time) {  // they are not among the contacts yet
    first.time = arrivals;
    first.record = -1;
  }
  await_points(frame, t, first);
  if (step_.stopped()) --frame.stops;
  advance_movers(frame, t, first.time);
  note(frame, outcome, books);
  for (std::size_t k = 0; k < step_.records().size(); ++k) {
    PairRecord& record = state.pairs[step_.records()[k]];
    if (!step_.pushes(k)) record.standing = step_.least_gap(k) <= state.touch(record);
  }
  for (const Eigen::Index i : step_.movers()) watch(frame, i, first.time);
  if (!frame.island.strays.empty() || first.record < 0) return first.time;
  if (afford(frame, frame.budget, 1 + static_cast<double>(step_.points()) / kPointsPerImpact))
    meet(frame, first);
  return first.time;
}

// The first arrival of a corner of a pair that touches already, if it is earlier than `first`.
void IslandMotion::await_points(Frame& frame, double t, Meet& first) {
  CollisionState& state = frame.state;
  for (const ContactStep::Awaited& awaited : step_.awaited()) {
    const PairRecord& record = state.pairs[awaited.record];
    const Collider& a = state.colliders[static_cast<std::size_t>(record.pair.a)];
    const Collider& b = state.colliders[static_cast<std::size_t>(record.pair.b)];
    const auto gap_at = [&](double time) {
      const Pose pose_a = collider_pose(a, state.moving_pose(record.a, time, true, worker_).pose);
      const Pose pose_b = collider_pose(b, state.moving_pose(record.b, time, true, worker_).pose);
      return gap_of_point(a, pose_a, b, pose_b, awaited.point, manifolds_);
    };
    const double arrival = first_zero(gap_at, t, awaited.point.gap, first.time);
    if (arrival >= first.time) continue;
    first.record = awaited.record;
    first.time = arrival;
  }
}

// What comes to rest carries what touches it: all pairs that touch now are stepped from now on.
void IslandMotion::join_touching(Frame& frame, double t) {
  CollisionState& state = frame.state;
  for (const int r : frame.island.records) {
    PairRecord& record = state.pairs[r];
    if (record.standing || !is_known(state, record, t)) continue;
    const Collider& a = state.colliders[static_cast<std::size_t>(record.pair.a)];
    const Collider& b = state.colliders[static_cast<std::size_t>(record.pair.b)];
    const Pose pose_a = collider_pose(a, state.moving_pose(record.a, t, true, worker_).pose);
    const Pose pose_b = collider_pose(b, state.moving_pose(record.b, t, true, worker_).pose);
    const double touch = state.touch(record);
    if ((pose_a.c - pose_b.c).norm() > a.bounding_radius + b.bounding_radius + touch) continue;
    record.standing = find_gap(a, pose_a, b, pose_b).value <= touch;
  }
}

void IslandMotion::advance_movers(Frame& frame, double t, double to) {
  CollisionState& state = frame.state;
  if (to > t) {
    state.simulation.advance(step_.movers(), t, to, true, worker_, frame.island.result.tally);
  } else {
    for (const Eigen::Index i : step_.movers())
      state.simulation.contact_wrenches()[static_cast<std::size_t>(i)] = Wrench{};
  }
  for (const Eigen::Index i : step_.movers()) {
    state.body_time[static_cast<std::size_t>(i)] = to;
    state.change_course(i);
  }
}

double IslandMotion::sound_part(const CollisionState& state, double h) const {
  // Of a whole sub-step, so that what is left of the frame cannot be cut for ever.
  const double least = std::min(1.0, kLeastPart * state.def.contact_step / h);
  return std::max(least, step_.sound_part(state));
}

double IslandMotion::step_foreseeing(Frame& frame, double t) {
  CollisionState& state = frame.state;
  const int steps = step_count(frame.t_end - t, state.def.contact_step);
  const double h = (frame.t_end - t) / steps;
  bring_all(frame, t);
  ContactStep::Books books;
  double to;
  {
    const Stopwatch::WallLap lap(contact_wall_s);
    step_.begin(state, h, h, true, false);
    for (const int r : frame.island.records) {
      const PairRecord& record = state.pairs[r];
      for (const int body : {record.a, record.b})
        if (state.asleep[static_cast<std::size_t>(body)] != 0 && step_.is_near(state, r))
          frame.island.strays.push_back(body);
      step_.add(state, r);
    }
    if (!frame.island.strays.empty()) return t;
    const ContactStep::Outcome outcome = step_.solve(state, books);
    const double part = sound_part(state, h);
    to = part < 1 ? t + part * h : (steps == 1 ? frame.t_end : t + h);
    note(frame, outcome, books);
  }
  for (const Eigen::Index i : step_.movers()) state.change_course(i);
  advance_movers(frame, t, to);
  for (std::size_t k = 0; k < step_.records().size(); ++k)
    state.pairs[step_.records()[k]].standing = step_.pushes(k);
  for (const Eigen::Index i : step_.movers()) watch(frame, i, to);
  return to;
}

void IslandMotion::note(Frame& frame, const ContactStep::Outcome& outcome,
                        const ContactStep::Books& books) {
  Island::Result& result = frame.island.result;
  result.contacts = outcome.pushing;
  result.max_penetration = outcome.max_penetration;
  result.impact_loss += books.impact_loss;
  result.push_out_energy += books.push_out_energy;
  if (step_.points() == 0) return;
  result.solved = true;
  result.residual = std::max(result.residual, outcome.residual.worst());
  result.iterations += static_cast<std::uint32_t>(outcome.iterations);
  result.unconverged += outcome.residual.converged ? 0 : 1;
}

bool IslandMotion::proves_rest(CollisionState& state, const Island& island) {
  step_.begin(state, state.def.contact_step, state.def.contact_step, true, false);
  for (const int r : island.records)
    if (state.pairs[r].standing) step_.add(state, r);
  return step_.holds_all(state, island.bodies) && step_.proves_rest(state);
}

}  // namespace poinsot
