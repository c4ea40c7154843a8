#include "poinsot/collision/impact_response.h"

#include <algorithm>
#include <cmath>

#include "poinsot/collision/proximity.h"

namespace poinsot {
namespace {

// Of the contact step: a bounce whose flight would be shorter is the last one. A ball that comes to
// rest by it is wrong by g (kRestFlight/240 s)²/8 of height, 3e-10 m.
constexpr double kRestFlight = 4e-3;
// Of the touch distance: pairs of a cluster that meet at one instant are that close.
constexpr double kTogether = 4;
// Larger clusters without restitution are solved as contacts are: the cost is that of their points,
// not of their cube.
constexpr std::size_t kFewPoints = 16;
// Of the closing speed: what is acceptable if it takes long.
constexpr double kAcceptable = 1e-9;
constexpr int kMostIterations = 150;

Vec3 velocity_at(const ContactBody& body, const Vec3& point) {
  return body.v + body.omega.cross(point - body.c);
}

double closing_speed(const ImpactPoint& p, std::span<const ContactBody> bodies) {
  return -p.normal.dot(velocity_at(bodies[static_cast<std::size_t>(p.a)], p.point) -
                       velocity_at(bodies[static_cast<std::size_t>(p.b)], p.point));
}

}  // namespace

int ImpactResponse::local(CollisionState& state, Eigen::Index column, double t,
                          SimulationWorker& worker) {
  const auto found = std::find(columns_.begin(), columns_.end(), column);
  if (found != columns_.end()) return static_cast<int>(found - columns_.begin());
  columns_.push_back(column);
  const World& world = state.world();
  poses_.push_back(state.moving_pose(column, t, false, worker));
  ContactBody body;
  body.c = poses_.back().pose.c;
  body.v = poses_.back().velocity.linear;
  body.omega = poses_.back().velocity.angular;
  if (state.is_awake(column)) {
    const auto k = static_cast<std::size_t>(column);
    const Mat3 R = poses_.back().pose.q.toRotationMatrix();
    body.inv_mass = world.inv_mass[k];
    body.inv_J_W = R * world.inv_J_B[k] * R.transpose();
  }
  bodies_.push_back(body);
  return static_cast<int>(columns_.size()) - 1;
}

bool ImpactResponse::touches(CollisionState& state, const PairRecord& record, double t,
                             SimulationWorker& worker) {
  const Collider& shape_a = state.colliders[static_cast<std::size_t>(record.pair.a)];
  const Collider& shape_b = state.colliders[static_cast<std::size_t>(record.pair.b)];
  const auto pose = [&](const Collider& shape) {
    return collider_pose(shape, state.moving_pose(shape.body, t, false, worker).pose);
  };
  const Pose pose_a = pose(shape_a), pose_b = pose(shape_b);
  const double touch = kTogether * state.touch(record);
  if ((pose_a.c - pose_b.c).norm() > shape_a.bounding_radius + shape_b.bounding_radius + touch)
    return false;
  return find_gap(shape_a, pose_a, shape_b, pose_b).value <= touch;
}

void ImpactResponse::add_points(CollisionState& state, int index, double t,
                                SimulationWorker& worker) {
  const PairRecord& record = state.pairs[index];
  const int a = local(state, record.a, t, worker), b = local(state, record.b, t, worker);
  const Collider& shape_a = state.colliders[static_cast<std::size_t>(record.pair.a)];
  const Collider& shape_b = state.colliders[static_cast<std::size_t>(record.pair.b)];
  const Pose pose_a = collider_pose(shape_a, poses_[static_cast<std::size_t>(a)].pose);
  const Pose pose_b = collider_pose(shape_b, poses_[static_cast<std::size_t>(b)].pose);
  const std::size_t first = points_.size();
  ImpactPoint p;
  p.a = a;
  p.b = b;
  p.restitution = record.restitution;
  p.friction = record.friction;
  // Corners of a face that arrive together do so to the rounding of their motion.
  const double together = std::max(kTogether * state.touch(record), kSameGap * record.size);
  find_manifolds(shape_a, pose_a, shape_b, pose_b, together, manifolds_);
  for (const Manifold& manifold : manifolds_)
    for (int k = 0; k < manifold.count; ++k) {
      p.normal = manifold.normal;
      p.point = manifold.points[static_cast<std::size_t>(k)].point;
      points_.push_back(p);
    }
  if (points_.size() == first && ranges_.empty()) {  // the search knows where they met
    p.normal = record.normal;
    p.point = record.point;
    points_.push_back(p);
  }
  if (points_.size() > first) ranges_.push_back({index, first, points_.size()});
}

// All that touches, from moving body to moving body.
void ImpactResponse::gather_cluster(CollisionState& state, Island& island,
                                    std::span<const int> island_of, int record, double t,
                                    SimulationWorker& worker) {
  columns_.clear();
  poses_.clear();
  bodies_.clear();
  points_.clear();
  ranges_.clear();
  add_points(state, record, t, worker);
  const auto first = static_cast<std::size_t>(island.bodies.front());
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    const Eigen::Index body = columns_[k];
    if (!state.world().moves(body)) continue;
    if (island_of[static_cast<std::size_t>(body)] != island_of[first]) {
      island.strays.push_back(body);
      continue;
    }
    for (const int r : state.pairs.of(body)) {
      const bool known = std::any_of(ranges_.begin(), ranges_.end(),
                                     [&](const Range& range) { return range.record == r; });
      if (known || !touches(state, state.pairs[r], t, worker)) continue;
      add_points(state, r, t, worker);
    }
  }
}

double ImpactResponse::restitution(CollisionState& state, const PairRecord& record,
                                   const ImpactPoint& point) const {
  const double e = point.restitution, speed = closing_speed(point, bodies_);
  if (e == 0 || speed <= 0) return e;
  const auto acceleration = [&](int body) -> Vec3 {
    if (!state.is_awake(body)) return Vec3::Zero();
    const auto k = static_cast<std::size_t>(body);
    return state.course_stamp[k] == state.stamp[k] ? state.courses[k].acceleration()
                                                   : state.world().gravity;
  };
  const double pressing = -point.normal.dot(Vec3(acceleration(record.a) - acceleration(record.b)));
  return 2 * e * speed < pressing * kRestFlight * state.def.contact_step ? 0 : e;
}

void ImpactResponse::resolve(CollisionState& state, Island& island, std::span<const int> island_of,
                             int record, double t, SimulationWorker& worker) {
  changed_.clear();
  gather_cluster(state, island, island_of, record, t, worker);
  if (!island.strays.empty()) return;
  for (const Range& range : ranges_)
    for (std::size_t k = range.first; k < range.end; ++k)
      points_[k].restitution = restitution(state, state.pairs[range.record], points_[k]);
  before_ = bodies_;
  island.result.impact_loss += solve();

  World& world = state.simulation.world();
  for (const ImpactPoint& p : points_) {
    if (p.impulse.isZero(0)) continue;
    for (const int body : {p.a, p.b}) {
      const Eigen::Index i = columns_[static_cast<std::size_t>(body)];
      if (!state.is_awake(i) || std::find(changed_.begin(), changed_.end(), i) != changed_.end())
        continue;
      state.bring(i, t, worker, island.result.tally);
      changed_.push_back(i);
    }
  }
  for (const ImpactPoint& p : points_) {
    if (p.impulse.isZero(0)) continue;
    for (const auto& [body, sign] : {std::pair{p.a, 1.0}, {p.b, -1.0}}) {
      const Eigen::Index i = columns_[static_cast<std::size_t>(body)];
      if (!state.is_awake(i)) continue;
      momentum(world.y, i) += sign * p.impulse;
      angular_momentum(world.y, i) +=
          sign * (p.point - bodies_[static_cast<std::size_t>(body)].c).cross(p.impulse);
    }
  }
  if (!world.systems.empty()) add_systems(world);
  for (const Eigen::Index i : changed_) state.change_course(i);
  tell(state, island, t);
}

// Impulses of the points, velocities of the bodies; the kinetic energy lost [J].
double ImpactResponse::solve() {
  const bool bounces = std::any_of(points_.begin(), points_.end(),
                                   [](const ImpactPoint& p) { return p.restitution > 0; });
  if (bounces || points_.size() <= kFewPoints) return solver_.resolve(bodies_, points_).energy_lost;
  return solve_plastic();
}

double ImpactResponse::solve_plastic() {
  contacts_.resize(points_.size());
  targets_.assign(points_.size(), 0);
  double closing = 0;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const ImpactPoint& p = points_[k];
    Contact& contact = contacts_[k];
    contact.a = p.a;
    contact.b = p.b;
    contact.point = p.point;
    contact.normal = p.normal;
    contact.friction = p.friction;
    contact.normal_impulse = 0;
    contact.friction_impulse.setZero();
    contact.carried.setZero();
    closing = std::max(closing, closing_speed(p, bodies_));
  }
  plastic_solver_.max_iterations = kMostIterations;
  plastic_solver_.acceptable = kAcceptable * closing;
  plastic_solver_.solve(bodies_, contacts_, targets_);
  double lost = 0;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    ImpactPoint& p = points_[k];
    p.impulse = contacts_[k].normal_impulse * p.normal + contacts_[k].friction_impulse;
    for (const std::vector<ContactBody>* bodies : {&before_, &bodies_})
      lost -= 0.5 * p.impulse.dot(velocity_at((*bodies)[static_cast<std::size_t>(p.a)], p.point) -
                                  velocity_at((*bodies)[static_cast<std::size_t>(p.b)], p.point));
  }
  return lost;
}

// What springs join to a body that was struck moves differently as well.
void ImpactResponse::add_systems(const World& world) {
  const std::size_t struck = changed_.size();
  for (std::size_t k = 0; k < struck; ++k) {
    const int system = world.system_of[static_cast<std::size_t>(changed_[k])];
    if (system == World::kLone) continue;
    for (const Eigen::Index j : world.systems[static_cast<std::size_t>(system)].columns)
      if (std::find(changed_.begin(), changed_.end(), j) == changed_.end()) changed_.push_back(j);
  }
}

void ImpactResponse::tell(CollisionState& state, Island& island, double t) {
  for (const Range& range : ranges_) {
    ImpactEvent event;
    double weight = 0;
    for (std::size_t k = range.first; k < range.end; ++k) {
      const ImpactPoint& p = points_[k];
      const double push = p.normal.dot(p.impulse);
      event.impulse += p.impulse;
      event.point += push * p.point;
      weight += push;
      event.normal = p.normal;
    }
    if (!(weight > 0)) continue;
    event.point /= weight;
    event.time = t;
    const auto a = static_cast<std::size_t>(points_[range.first].a);
    const auto b = static_cast<std::size_t>(points_[range.first].b);
    event.a = columns_[a];
    event.b = columns_[b];
    event.v_a_before = before_[a].v;
    event.w_a_before = before_[a].omega;
    event.v_b_before = before_[b].v;
    event.w_b_before = before_[b].omega;
    event.v_a_after = bodies_[a].v;
    event.w_a_after = bodies_[a].omega;
    event.v_b_after = bodies_[b].v;
    event.w_b_after = bodies_[b].omega;
    if (!state.world().moves(event.a)) {  // a is the one that moves
      std::swap(event.a, event.b);
      std::swap(event.v_a_before, event.v_b_before);
      std::swap(event.w_a_before, event.w_b_before);
      std::swap(event.v_a_after, event.v_b_after);
      std::swap(event.w_a_after, event.w_b_after);
      event.normal = -event.normal;
      event.impulse = -event.impulse;
    }
    island.result.events.push_back(event);
    ++island.result.impacts;
  }
}

}  // namespace poinsot
