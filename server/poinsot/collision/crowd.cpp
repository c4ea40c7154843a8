#include "poinsot/collision/crowd.h"

#include <algorithm>
#include <cmath>

namespace poinsot {
namespace {

// What is near is looked at anew before a body has moved by this much of its size.
constexpr double kLook = 0.5;
constexpr int kMostParts = 64;  // of a frame
// Room of a box beside what is needed, of the size; and how many frames ahead it may reach.
constexpr double kRoom = 0.05;
constexpr double kFramesAhead = 4;
// Records and bodies that a thread takes at a time.
constexpr std::size_t kTogether = 64;
// A larger island is too dear for a direct solver: some hundred milliseconds a frame.
constexpr std::size_t kMostDirect = 400;
// Fewer are solved directly even if that accuracy is not asked for: it costs no more.
constexpr std::size_t kFewDirect = 4;

// Whether another point of the surface comes under the normal (in S) as the body turns.
bool is_round(const Collider& collider, const Vec3& normal) {
  constexpr double kSide = 0.5;  // of a cylinder or cone: its base is flat
  if (collider.core_radius > 0 || std::holds_alternative<Ellipsoid>(collider.shape)) return true;
  return collider.is_curved && std::abs(normal.z()) < kSide;
}

template <class Task>
void run_chunks(Team& team, std::size_t count, const Task& task) {
  team.run((count + kTogether - 1) / kTogether, [&](std::size_t chunk, int) {
    const std::size_t end = std::min(count, (chunk + 1) * kTogether);
    for (std::size_t k = chunk * kTogether; k < end; ++k) task(k);
  });
}

}  // namespace

// No point of the body moves farther in h, contacts aside [m].
double Crowd::travel(const CollisionState& state, Eigen::Index i, const Vec3& omega,
                     double h) const {
  const World& world = state.world();
  const auto k = static_cast<std::size_t>(i);
  double acceleration = world.gravity.norm();
  if (state.simulation.is_driven(i))
    acceleration += world.held[k].in_W.force.norm() * world.inv_mass[k];
  return h *
         (linear_velocity(world, i).norm() + state.arm[k] * omega.norm() + 0.5 * h * acceleration);
}

Crowd::Crowd(const CollisionState& state)
    : member_(state.stamp.size(), 0),
      may_step_(state.stamp.size(), 0),
      near_(state.colliders.size()),
      pose_(state.colliders.size()),
      travel_(state.stamp.size(), 0),
      placed_(state.stamp.size(), 0),
      local_(state.stamp.size(), -1) {
  const World& world = state.world();
  for (std::size_t k = 0; k < may_step_.size(); ++k) {
    const bool lone = world.systems.empty() || world.system_of[k] == World::kLone;
    const bool drags =
        !world.drag.empty() &&
        (world.drag[k].linear > 0 || world.drag[k].quadratic > 0 || world.drag[k].angular > 0);
    may_step_[k] = world.moves(static_cast<Eigen::Index>(k)) && lone && !drags ? 1 : 0;
  }
  if (state.def.contact_solver == ContactSolverKind::soft_step) member_ = may_step_;
}

void Crowd::set_member(Eigen::Index i, bool member) {
  member_[static_cast<std::size_t>(i)] = member ? 1 : 0;
}

bool Crowd::look(const CollisionState& state, Eigen::Index i, double h) {
  const World& world = state.world();
  const double more = travel(state, i, angular_velocity(world, i), h);
  travel_[static_cast<std::size_t>(i)] = more;
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
    return has(body) ? near_[c] : state.bound[c];
  };
  const auto is_plane = [&](int collider) {
    return std::holds_alternative<HalfSpace>(
        state.colliders[static_cast<std::size_t>(collider)].shape);
  };
  if (is_plane(record.pair.a) || is_plane(record.pair.b)) return true;
  return box(record.pair.a, record.a).overlaps(box(record.pair.b, record.b));
}

bool Crowd::takes(const CollisionState& state, const Island& island, double duration) const {
  if (state.def.contact_solver == ContactSolverKind::convex_newton) return false;
  const World& world = state.world();
  for (const Eigen::Index i : island.bodies) {
    const auto k = static_cast<std::size_t>(i);
    const HeldWrench& held = world.held[k];
    if (may_step_[k] == 0 || !held.in_B.force.isZero(0) || !held.in_B.torque.isZero(0) ||
        !held.moment.isZero(0))
      return false;
  }
  bool stands = false;
  for (const int r : island.records) {
    const PairRecord& record = state.pairs.records()[static_cast<std::size_t>(r)];
    stands = stands || record.standing;
    for (const int c : {record.pair.a, record.pair.b})
      if (std::holds_alternative<Mesh>(state.colliders[static_cast<std::size_t>(c)].shape))
        return false;
  }
  if (state.def.contact_solver == ContactSolverKind::soft_step) return true;
  for (const Eigen::Index i : island.bodies) {
    double size = std::numeric_limits<double>::infinity();
    for (const Collider& collider : state.colliders_of(i)) size = std::min(size, collider.size);
    if (travel(state, i, angular_velocity(world, i), duration) > kLook * size) return false;
  }
  if (island.bodies.size() > kMostDirect) return true;
  constexpr double kSoftTolerance = 1e-4;  // what soft_step may reach in easy islands
  return stands && island.bodies.size() > kFewDirect &&
         state.def.contact_tolerance >= kSoftTolerance;
}

// How often what is near is looked at.
int Crowd::parts(const CollisionState& state, double duration) {
  double most = 1;
  for (const Eigen::Index i : columns_) {
    double size = std::numeric_limits<double>::infinity();
    for (const Collider& collider : state.colliders_of(i)) size = std::min(size, collider.size);
    const double way = travel(
        state, i, bodies_[static_cast<std::size_t>(local_[static_cast<std::size_t>(i)])].omega,
        duration);
    most = std::max(most, way / (kLook * size));
  }
  return most < kMostParts ? static_cast<int>(std::ceil(most)) : kMostParts;
}

// Kinematic bodies are moved on when the frame is over.
void Crowd::place_immovable(const CollisionState& state, int i, double h) {
  const World& world = state.world();
  const auto k = static_cast<std::size_t>(i);
  if (world.moves(i) || placed_[k] == step_) return;
  placed_[k] = step_;
  const bool carried = world.is_kinematic(i);
  const Pose pose = carried && now_ > world.time
                        ? state.courses[k].at(now_)
                        : Pose{position(world.y, i), orientation(world.y, i)};
  for (const Collider& collider : state.colliders_of(i))
    pose_[static_cast<std::size_t>(&collider - state.colliders.data())] =
        collider_pose(collider, pose);
  travel_[k] = carried ? h * (linear_velocity(world, i).norm() +
                              state.arm[k] * angular_velocity(world, i).norm())
                       : 0;
}

int Crowd::local(const CollisionState& state, int column) {
  int& local = local_[static_cast<std::size_t>(column)];
  if (local >= 0) return local;
  const World& world = state.world();
  local = static_cast<int>(bodies_.size());
  immovable_.push_back(column);
  const bool carried = world.is_kinematic(column) && now_ > world.time;
  const Pose pose = carried ? state.courses[static_cast<std::size_t>(column)].at(now_)
                            : Pose{position(world.y, column), orientation(world.y, column)};
  SoftBody body;
  body.c = pose.c;
  body.q = pose.q;
  body.v = linear_velocity(world, column);
  body.L.setZero();
  body.omega = angular_velocity(world, column);
  body.acceleration.setZero();
  body.torque.setZero();
  bodies_.push_back(body);
  return local;
}

void Crowd::gather_bodies(const CollisionState& state, std::span<Island* const> islands) {
  for (const Eigen::Index i : columns_) local_[static_cast<std::size_t>(i)] = -1;
  columns_.clear();
  records_.clear();
  for (const Island* island : islands) {
    columns_.insert(columns_.end(), island->bodies.begin(), island->bodies.end());
    records_.insert(records_.end(), island->records.begin(), island->records.end());
  }
  for (std::size_t k = 0; k < columns_.size(); ++k)
    local_[static_cast<std::size_t>(columns_[k])] = static_cast<int>(k);
  const World& world = state.world();
  bodies_.resize(columns_.size());
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    const Eigen::Index i = columns_[k];
    const auto column = static_cast<std::size_t>(i);
    SoftBody& body = bodies_[k];
    body.c = position(world.y, i);
    body.q = orientation(world.y, i);
    body.v = linear_velocity(world, i);
    body.L = angular_momentum(world.y, i);
    body.omega = angular_velocity(world, i);
    body.inv_mass = world.inv_mass[column];
    body.inv_J_B = world.inv_J_B[column];
    body.acceleration = world.gravity;
    body.torque.setZero();
    if (state.simulation.is_driven(i)) {
      body.acceleration += body.inv_mass * world.held[column].in_W.force;
      body.torque = world.held[column].in_W.torque;
    }
    const Mat3& J = world.J_B[column];
    body.turns_evenly = J(0, 0) == J(1, 1) && J(1, 1) == J(2, 2) && J.isDiagonal(0);
  }
}

// Finds the points of all records.
void Crowd::measure(CollisionState& state, double h, Team& team) {
  ++step_;
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    const Eigen::Index i = columns_[k];
    const Pose pose{bodies_[k].c, bodies_[k].q};
    for (const Collider& collider : state.colliders_of(i))
      pose_[static_cast<std::size_t>(&collider - state.colliders.data())] =
          collider_pose(collider, pose);
    travel_[static_cast<std::size_t>(i)] = travel(state, i, bodies_[k].omega, h);
  }
  for (const int r : records_) {
    PairRecord& record = state.pairs[r];
    state.pairs.make_crowd_contact(record);
    place_immovable(state, record.a, h);
    place_immovable(state, record.b, h);
  }
  run_chunks(team, records_.size(), [&](std::size_t k) {
    const PairRecord& record = state.pairs[records_[k]];
    CrowdContact& contact = state.pairs.crowd_contact(record);
    const Collider& a = state.colliders[static_cast<std::size_t>(record.pair.a)];
    const Collider& b = state.colliders[static_cast<std::size_t>(record.pair.b)];
    const Pose& pose_a = pose_[static_cast<std::size_t>(record.pair.a)];
    const Pose& pose_b = pose_[static_cast<std::size_t>(record.pair.b)];
    const double margin = state.def.contact_margin * record.size +
                          travel_[static_cast<std::size_t>(record.a)] +
                          travel_[static_cast<std::size_t>(record.b)];
    if ((pose_a.c - pose_b.c).norm() > a.bounding_radius + b.bounding_radius + margin) {
      contact.forget();
      return;
    }
    measure_contact(a, pose_a, b, pose_b, record.size, margin, contact);
  });
}

// The manifolds of all records that have points, as the solver sees them.
void Crowd::fill(CollisionState& state, Team& team) {
  active_.clear();
  for (const int column : immovable_) local_[static_cast<std::size_t>(column)] = -1;
  immovable_.clear();
  bodies_.resize(columns_.size());
  for (const int r : records_) {
    const PairRecord& record = state.pairs[r];
    if (state.pairs.crowd_contact(record).count == 0) continue;
    active_.push_back(r);
    local(state, record.a);
    local(state, record.b);
  }
  manifolds_.resize(active_.size());
  run_chunks(team, active_.size(), [&](std::size_t k) {
    const PairRecord& record = state.pairs[active_[k]];
    const CrowdContact& contact = state.pairs.crowd_contact(record);
    const Pose& pose_a = pose_[static_cast<std::size_t>(record.pair.a)];
    const Pose& pose_b = pose_[static_cast<std::size_t>(record.pair.b)];
    const Mat3 R_a = pose_a.q.toRotationMatrix(), R_b = pose_b.q.toRotationMatrix();
    SoftManifold& m = manifolds_[k];
    m.a = local_[static_cast<std::size_t>(record.a)];
    m.b = local_[static_cast<std::size_t>(record.b)];
    m.count = contact.count;
    m.normal = R_a * contact.normal_in_a;
    m.round_a =
        is_round(state.colliders[static_cast<std::size_t>(record.pair.a)], contact.normal_in_a);
    m.round_b = is_round(state.colliders[static_cast<std::size_t>(record.pair.b)],
                         pose_b.q.conjugate() * m.normal);
    m.friction = record.friction;
    m.restitution = record.restitution;
    m.size = record.size;
    const Vec3 from_a = pose_a.c - bodies_[static_cast<std::size_t>(m.a)].c;
    const Vec3 from_b = pose_b.c - bodies_[static_cast<std::size_t>(m.b)].c;
    const Vec3 apart = pose_a.c - pose_b.c;
    for (int j = 0; j < m.count; ++j) {
      const CrowdContact::Point& p = contact.points[static_cast<std::size_t>(j)];
      const Vec3 on_a = R_a * p.on_a, on_b = R_b * p.on_b;
      SoftManifold::Point& point = m.points[j];
      point.arm_a = from_a + on_a;
      point.arm_b = from_b + on_b;
      point.gap = m.normal.dot(apart + on_a - on_b);
      point.normal_impulse = p.normal_impulse;
      point.usual_impulse = p.usual_impulse;
    }
    m.friction_impulse = R_a * contact.friction_in_a;
    m.twist_impulse = contact.twist_impulse;
  });
}

// Contacts remember their impulses.
void Crowd::recall(CollisionState& state) {
  for (const int r : records_) state.pairs[r].standing = false;
  for (std::size_t k = 0; k < active_.size(); ++k) {
    PairRecord& record = state.pairs[active_[k]];
    CrowdContact& contact = state.pairs.crowd_contact(record);
    const SoftManifold& m = manifolds_[k];
    double sum = 0;
    for (int j = 0; j < m.count; ++j) {
      CrowdContact::Point& p = contact.points[static_cast<std::size_t>(j)];
      p.normal_impulse = m.points[j].normal_impulse;
      p.usual_impulse = m.points[j].usual_impulse;
      sum += m.points[j].normal_impulse;
    }
    contact.friction_in_a =
        pose_[static_cast<std::size_t>(record.pair.a)].q.conjugate() * m.friction_impulse;
    contact.twist_impulse = m.twist_impulse;
    record.standing = sum > 0;
  }
}

void Crowd::scatter(CollisionState& state, Result& result) {
  World& world = state.simulation.world();
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    const Eigen::Index i = columns_[k];
    const SoftBody& body = bodies_[k];
    const double mass = world.mass[static_cast<std::size_t>(i)];
    result.tally.work -= mass * world.gravity.dot(body.c - Vec3(position(world.y, i)));
    position(world.y, i) = body.c;
    orientation(world.y, i) = body.q;
    momentum(world.y, i) = mass * body.v;
    angular_momentum(world.y, i) = body.L;
    state.change_course(i);
  }
  state.simulation.accept(columns_, result.tally);
}

void Crowd::add_forces(const CollisionState& state, const PairRecord& record,
                       std::vector<ContactForce>& forces) const {
  if (record.crowd_contact < 0 || !(last_h_ > 0)) return;
  const CrowdContact& contact = state.pairs.crowd_contact(record);
  const World& world = state.world();
  const auto pose = [&](int collider, int body) {
    return collider_pose(state.colliders[static_cast<std::size_t>(collider)],
                         {position(world.y, body), orientation(world.y, body)});
  };
  const Pose pose_a = pose(record.pair.a, record.a), pose_b = pose(record.pair.b, record.b);
  const Vec3 normal = pose_a.q * contact.normal_in_a;
  Vec3 friction = pose_a.q * contact.friction_in_a / last_h_;
  for (int k = 0; k < contact.count; ++k) {
    const CrowdContact::Point& p = contact.points[static_cast<std::size_t>(k)];
    if (!(p.normal_impulse > 0)) continue;
    forces.push_back({record.a, record.b, 0.5 * (pose_a * p.on_a + pose_b * p.on_b), normal,
                      p.normal_impulse / last_h_ * normal + friction});
    friction.setZero();
  }
}

Crowd::Result Crowd::advance(CollisionState& state, std::span<Island* const> islands, double t_end,
                             Team& team) {
  Result result;
  const double duration = t_end - state.world().time;
  gather_bodies(state, islands);
  const int parts = this->parts(state, duration);
  const double h = duration / parts;
  SoftSettings settings;
  settings.steps = std::max(1, static_cast<int>(std::ceil(h / state.def.contact_step - 1e-6)));
  settings.push_out_speed = state.def.push_out_speed;
  settings.rest_speed = 2 * state.world().gravity.norm() * h / settings.steps;
  now_ = state.world().time;
  last_h_ = h / settings.steps;
  for (int part = 0; part < parts; ++part) {
    if (part > 0) {
      now_ = state.world().time + part * h;
      gather_bodies(state, islands);
    }
    measure(state, h, team);
    fill(state, team);
    const SoftOutcome outcome = solver_.advance(bodies_, manifolds_, {}, h, settings, team);
    result.tally.work += outcome.force_work;
    result.outcome.loss += outcome.loss;
    result.outcome.push_out_energy += outcome.push_out_energy;
    result.outcome.max_penetration = outcome.max_penetration;
    result.outcome.pushing = outcome.pushing;
    result.outcome.residual = std::max(result.outcome.residual, outcome.residual);
    recall(state);
    scatter(state, result);
  }
  for (const Eigen::Index i : columns_) state.body_time[static_cast<std::size_t>(i)] = t_end;
  result.bodies = static_cast<std::uint32_t>(columns_.size());
  return result;
}

}  // namespace poinsot
