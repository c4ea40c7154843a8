#include "poinsot/collision/crowd_step.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "poinsot/collision/crowd.h"

namespace poinsot {
namespace {

constexpr int kMostParts = 64;  // of a frame

// Whether another point of the surface comes under the normal (in S) as the body turns.
bool is_round(const Collider& collider, const Vec3& normal) {
  constexpr double kSide = 0.5;  // of a cylinder or cone: its base is flat
  if (collider.core_radius > 0 || std::holds_alternative<Ellipsoid>(collider.shape)) return true;
  return collider.is_curved && std::abs(normal.z()) < kSide;
}

// Contacts of pairs lie anywhere in memory: those needed soon are asked for ahead.
constexpr std::size_t kAhead = 6;
void prefetch(const CrowdContact& contact) {
  const char* const bytes = reinterpret_cast<const char*>(&contact);
  for (std::size_t line = 0; line < 4; ++line) __builtin_prefetch(bytes + 64 * line);
}

// Half as long where more than soft_step can give is asked for.
int sub_steps(const CollisionDef& def, double h) {
  const double longest =
      def.contact_tolerance < kSoftTolerance ? 0.5 * def.contact_step : def.contact_step;
  return std::max(1, static_cast<int>(std::ceil(h / longest - 1e-6)));
}

// What the direct solver found at the nearest of its points.
void take_over(const PairContact& solved, const Pose& pose_a, const Pose& pose_b, double size,
               double h, CrowdContact& contact) {
  if (!(solved.last_h > 0)) return;
  constexpr double kSamePlace = 0.1;  // of the size
  const double scale = h / solved.last_h;
  Vec3 friction = Vec3::Zero();
  for (const PairPoint& p : solved.points) {
    double nearest = kSamePlace * size;
    CrowdContact::Point* match = nullptr;
    for (int j = 0; j < contact.count; ++j) {
      CrowdContact::Point& point = contact.points[static_cast<std::size_t>(j)];
      const double distance = (pose_b * point.on_b - p.position).norm();
      if (distance >= nearest || point.normal_impulse > 0) continue;
      nearest = distance;
      match = &point;
    }
    if (match == nullptr) continue;
    match->normal_impulse = match->usual_impulse = scale * p.normal_impulse;
    friction += scale * p.friction_impulse;
  }
  contact.friction_in_a = pose_a.q.conjugate() * friction;
  contact.h = h;
}

}  // namespace

void CrowdStep::fit(const CollisionState& state) {
  pose_.resize(state.colliders.size());
  radius_.clear();
  for (const Collider& collider : state.colliders) radius_.push_back(collider.bounding_radius);
  travel_.resize(state.stamp.size(), 0);
  placed_.resize(state.stamp.size(), 0);
  local_.resize(state.stamp.size(), -1);
}

// How often what is near is looked at.
int CrowdStep::parts(const CollisionState& state, double duration) {
  double most = 1;
  for (const Eigen::Index i : columns_) {
    const double way = crowd_travel(
        state, i, bodies_[static_cast<std::size_t>(local_[static_cast<std::size_t>(i)])].omega,
        duration);
    most = std::max(most, way / (kLook * state.least_size[static_cast<std::size_t>(i)]));
  }
  return most < kMostParts ? static_cast<int>(std::ceil(most)) : kMostParts;
}

// Kinematic bodies are moved on when the frame is over.
void CrowdStep::place_immovable(const CollisionState& state, int i, double h) {
  const World& world = state.world();
  const auto k = static_cast<std::size_t>(i);
  if (state.is_awake(i) || placed_[k] == step_) return;
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

int CrowdStep::local(const CollisionState& state, int column) {
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

void CrowdStep::gather_bodies(const CollisionState& state, std::span<Island* const> islands,
                              Team& team) {
  for (const Eigen::Index i : columns_) local_[static_cast<std::size_t>(i)] = -1;
  for (const int column : immovable_) local_[static_cast<std::size_t>(column)] = -1;
  immovable_.clear();
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
  run_chunks(team, columns_.size(), [&](std::size_t k) {
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
  });
}

// Finds the points of all records.
void CrowdStep::measure(CollisionState& state, double h, Team& team) {
  ++step_;
  run_chunks(team, columns_.size(), [&](std::size_t k) {
    const Eigen::Index i = columns_[k];
    const Pose pose{bodies_[k].c, bodies_[k].q};
    for (const Collider& collider : state.colliders_of(i))
      pose_[static_cast<std::size_t>(&collider - state.colliders.data())] =
          collider_pose(collider, pose);
    travel_[static_cast<std::size_t>(i)] = crowd_travel(state, i, bodies_[k].omega, h);
  });
  for (const int r : records_) {
    const PairRecord& record = state.pairs[r];
    place_immovable(state, record.a, h);
    place_immovable(state, record.b, h);
  }
  run_chunks(team, records_.size(), [&](std::size_t k) {
    if (k + kAhead < records_.size())
      prefetch(state.pairs.crowd_contact(state.pairs[records_[k + kAhead]]));
    measure(state, state.pairs[records_[k]]);
  });
}

void CrowdStep::measure(CollisionState& state, const PairRecord& record) {
  CrowdContact& contact = state.pairs.crowd_contact(record);
  const auto a = static_cast<std::size_t>(record.pair.a),
             b = static_cast<std::size_t>(record.pair.b);
  const bool goes_on = contact.until == now_;
  if (!goes_on) contact.forget();
  contact.until = end_;
  const double margin = state.def.contact_margin * record.size +
                        travel_[static_cast<std::size_t>(record.a)] +
                        travel_[static_cast<std::size_t>(record.b)];
  const double reach = radius_[a] + radius_[b] + margin;
  if ((pose_[a].c - pose_[b].c).squaredNorm() > reach * reach) {
    contact.forget();
    return;
  }
  measure_contact(state.colliders[a], pose_[a], state.colliders[b], pose_[b], record.size, margin,
                  contact);
  if (goes_on || contact.count == 0) return;
  if (const PairContact* solved = state.pairs.find_contact(record); solved != nullptr)
    take_over(*solved, pose_[a], pose_[b], record.size, sub_step_, contact);
}

// The manifolds of all records that have points, as the solver sees them.
void CrowdStep::fill(CollisionState& state, Team& team) {
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
  run_chunks(team, active_.size(),
             [&](std::size_t k) { fill(state, state.pairs[active_[k]], manifolds_[k]); });
}

void CrowdStep::fill(const CollisionState& state, const PairRecord& record, SoftManifold& m) const {
  const CrowdContact& contact = state.pairs.crowd_contact(record);
  const auto a = static_cast<std::size_t>(record.pair.a),
             b = static_cast<std::size_t>(record.pair.b);
  const Pose &pose_a = pose_[a], &pose_b = pose_[b];
  const Mat3 R_a = pose_a.q.toRotationMatrix(), R_b = pose_b.q.toRotationMatrix();
  const double scale = contact.h > 0 ? sub_step_ / contact.h : 0;
  m.a = local_[static_cast<std::size_t>(record.a)];
  m.b = local_[static_cast<std::size_t>(record.b)];
  m.count = contact.count;
  m.normal = R_a * contact.normal_in_a;
  m.round_a = is_round(state.colliders[a], contact.normal_in_a);
  m.round_b = is_round(state.colliders[b], R_b.transpose() * m.normal);
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
    point.normal_impulse = scale * p.normal_impulse;
    point.usual_impulse = scale * p.usual_impulse;
  }
  m.friction_impulse = scale * (R_a * contact.friction_in_a);
  m.twist_impulse = scale * contact.twist_impulse;
}

void CrowdStep::find_strain(std::span<double> strain) const {
  for (const Eigen::Index i : columns_) strain[static_cast<std::size_t>(i)] = 0;
  for (const SoftManifold& m : manifolds_) {
    double gap = 0;
    for (int j = 0; j < m.count; ++j) gap = std::min(gap, m.points[j].gap);
    const double depth = -gap / m.size;
    for (const int body : {m.a, m.b}) {
      if (static_cast<std::size_t>(body) >= columns_.size()) continue;
      double& most = strain[static_cast<std::size_t>(columns_[static_cast<std::size_t>(body)])];
      most = std::max(most, depth);
    }
  }
}

// Contacts remember their impulses.
void CrowdStep::recall(CollisionState& state, Team& team) {
  for (const int r : records_) {
    PairRecord& record = state.pairs[r];
    record.standing = false;
    record.by_crowd = true;
    if (record.contact < 0) continue;
    PairContact& solved = state.pairs.contact(record);  // what it knows is old from now on
    solved.last_h = 0;
    solved.digest = 0;
    for (PairPoint& p : solved.points) p.approach = 0;
  }
  run_chunks(team, active_.size(), [&](std::size_t k) {
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
    contact.h = sub_step_;
    record.standing = sum > 0;
  });
}

void CrowdStep::scatter(CollisionState& state, Result& result, Team& team) {
  World& world = state.simulation.world();
  Vec3 moved = Vec3::Zero();  // [kg·m]
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    const Eigen::Index i = columns_[k];
    if (!bodies_[k].c.allFinite()) continue;  // it will be frozen where it was
    moved += world.mass[static_cast<std::size_t>(i)] * (bodies_[k].c - Vec3(position(world.y, i)));
  }
  result.tally.work -= world.gravity.dot(moved);
  run_chunks(team, columns_.size(), [&](std::size_t k) {
    const Eigen::Index i = columns_[k];
    const SoftBody& body = bodies_[k];
    position(world.y, i) = body.c;
    orientation(world.y, i) = body.q;
    momentum(world.y, i) = world.mass[static_cast<std::size_t>(i)] * body.v;
    angular_momentum(world.y, i) = body.L;
    state.change_course(i);
  });
  state.simulation.accept(columns_, result.tally);
}

void CrowdStep::add_forces(const CollisionState& state, const PairRecord& record,
                           std::vector<ContactForce>& forces) {
  if (record.crowd_contact < 0) return;
  const CrowdContact& contact = state.pairs.crowd_contact(record);
  if (!(contact.h > 0)) return;
  const World& world = state.world();
  const auto pose = [&](int collider, int body) {
    return collider_pose(state.colliders[static_cast<std::size_t>(collider)],
                         {position(world.y, body), orientation(world.y, body)});
  };
  const Pose pose_a = pose(record.pair.a, record.a), pose_b = pose(record.pair.b, record.b);
  const Vec3 normal = pose_a.q * contact.normal_in_a;
  Vec3 friction = pose_a.q * contact.friction_in_a / contact.h;
  for (int k = 0; k < contact.count; ++k) {
    const CrowdContact::Point& p = contact.points[static_cast<std::size_t>(k)];
    if (!(p.normal_impulse > 0)) continue;
    forces.push_back({record.a, record.b, 0.5 * (pose_a * p.on_a + pose_b * p.on_b), normal,
                      p.normal_impulse / contact.h * normal + friction});
    friction.setZero();
  }
}

CrowdStep::Result CrowdStep::advance(CollisionState& state, std::span<Island* const> islands,
                                     double t_end, Team& team, std::span<double> strain) {
  Result result;
  const double duration = t_end - state.world().time;
  if (!(duration > 0)) return result;
  gather_bodies(state, islands, team);
  const int parts = this->parts(state, duration);
  const double h = duration / parts;
  SoftSettings settings;
  settings.steps = sub_steps(state.def, h);
  settings.push_out_speed = state.def.push_out_speed;
  settings.rest_speed = 2 * state.world().gravity.norm() * h / settings.steps;
  now_ = state.world().time;
  sub_step_ = h / settings.steps;
  for (int part = 0; part < parts; ++part) {
    if (part > 0) {
      now_ = end_;
      gather_bodies(state, islands, team);
    }
    end_ = part + 1 < parts ? state.world().time + (part + 1) * h : t_end;
    measure(state, h, team);
    fill(state, team);
    if (state.def.contact_solver == ContactSolverKind::automatic) find_strain(strain);
    const SoftOutcome outcome = solver_.advance(bodies_, manifolds_, {}, h, settings, team);
    if (std::isfinite(outcome.force_work) && std::isfinite(outcome.loss)) {
      result.tally.work += outcome.force_work;
      result.outcome.loss += outcome.loss;
      result.outcome.push_out_energy += outcome.push_out_energy;
    }
    result.outcome.max_penetration = outcome.max_penetration;
    result.outcome.pushing = outcome.pushing;
    result.outcome.residual = std::max(result.outcome.residual, outcome.residual);
    recall(state, team);
    scatter(state, result, team);
  }
  for (const Eigen::Index i : columns_) state.body_time[static_cast<std::size_t>(i)] = t_end;
  result.bodies = static_cast<std::uint32_t>(columns_.size());
  return result;
}

}  // namespace poinsot
