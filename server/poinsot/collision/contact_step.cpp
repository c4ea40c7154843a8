#include "poinsot/collision/contact_step.h"

#include <algorithm>
#include <cmath>

#include "poinsot/collision/pair_contact.h"

namespace poinsot {
namespace {}  // namespace

ContactStep::ContactStep(const CollisionDef& def) : def_(def) {}

void ContactStep::begin(const CollisionState& state, double h, double usual, bool foresees,
                        bool stops) {
  for (const Eigen::Index column : columns_) local_of_[static_cast<std::size_t>(column)] = -1;
  local_of_.resize(static_cast<std::size_t>(state.world().size()), -1);
  h_ = h;
  usual_ = std::min(usual, h);
  least_size_ = std::numeric_limits<double>::infinity();
  slip_ = {};
  residual_ = {};
  iterations_ = 0;
  foresees_ = foresees;
  stops_ = stops;
  stopped_ = false;
  awaited_.clear();
  columns_.clear();
  travel_.clear();
  room_.clear();
  fastest_.clear();  // of the last sub-step: without contacts there is none to cut this one by
  records_.clear();
  first_point_.assign(1, 0);
  points_.clear();
  contacts_.clear();
}

int ContactStep::local(const CollisionState& state, Eigen::Index column) {
  int& local = local_of_[static_cast<std::size_t>(column)];
  if (local >= 0) return local;
  local = static_cast<int>(columns_.size());
  columns_.push_back(column);
  const World& world = state.world();
  double travel = 0;
  if (state.is_awake(column)) {
    const DrivenBound bound = driven_bound(world, column, {}, h_);
    travel = h_ * (std::min(bound.speed.v, bound.path / h_) +
                   state.arm[static_cast<std::size_t>(column)] * bound.speed.omega);
  } else if (world.is_kinematic(column)) {
    travel =
        h_ * (linear_velocity(world, column).norm() +
              state.arm[static_cast<std::size_t>(column)] * angular_velocity(world, column).norm());
  }
  travel_.push_back(travel);
  room_.push_back(std::numeric_limits<double>::infinity());
  return local;
}

double ContactStep::margin(const CollisionState& state, const PairRecord& record) {
  return def_.contact_margin * record.size +
         travel_[static_cast<std::size_t>(local(state, record.a))] +
         travel_[static_cast<std::size_t>(local(state, record.b))];
}

bool ContactStep::is_near(const CollisionState& state, int index) {
  const PairRecord& record = state.pairs.records()[static_cast<std::size_t>(index)];
  const Collider& a = state.colliders[static_cast<std::size_t>(record.pair.a)];
  const Collider& b = state.colliders[static_cast<std::size_t>(record.pair.b)];
  const auto center = [&](const Collider& collider) -> Vec3 {
    const World& world = state.world();
    return position(world.y, collider.body) +
           orientation(world.y, collider.body) * collider.in_body.c;
  };
  return (center(a) - center(b)).norm() <=
         a.bounding_radius + b.bounding_radius + margin(state, record);
}

void ContactStep::add(CollisionState& state, int index) {
  PairRecord& record = state.pairs[index];
  const double margin = this->margin(state, record);
  const auto a = static_cast<std::size_t>(local(state, record.a));
  const auto b = static_cast<std::size_t>(local(state, record.b));
  for (const std::size_t k : {a, b})
    room_[k] = std::min(room_[k], 0.5 * def_.contact_margin * record.size);
  least_size_ = std::min(least_size_, record.size);
  PairContact& contact = state.pairs.contact(record);
  contact.digest = 0;
  if (is_near(state, index)) {
    measure_pair(state, record, margin, h_);
  } else {
    contact.points.clear();
  }
  for (std::size_t k = 0; k < contact.points.size(); ++k) {
    PairPoint& p = contact.points[k];
    if (p.gap > margin) {
      p.normal_impulse = 0;
      p.friction_impulse.setZero();
      continue;
    }
    if (!foresees_ && comes_in(state, record, p)) {
      awaited_.push_back({index, p});
      continue;
    }
    points_.push_back({static_cast<int>(records_.size()), static_cast<int>(k), p.position, p.normal,
                       motion_of(state, record, p)});
    Contact c;
    c.a = static_cast<int>(a);
    c.b = static_cast<int>(b);
    c.point = p.position;
    c.normal = p.normal;
    c.gap = p.gap;
    c.restitution = record.restitution;
    c.friction = record.friction;
    c.normal_impulse = p.normal_impulse;
    c.friction_impulse = p.friction_impulse;
    contacts_.push_back(c);
  }
  records_.push_back(index);
  first_point_.push_back(points_.size());
}

bool ContactStep::comes_in(const CollisionState& state, const PairRecord& record,
                           const PairPoint& p) const {
  if (p.gap <= state.touch(record)) return false;
  const World& world = state.world();
  const auto velocity = [&](Eigen::Index i) -> Vec3 {
    return linear_velocity(world, i) +
           angular_velocity(world, i).cross(p.position - position(world.y, i));
  };
  const double speed = -p.normal.dot(velocity(record.a) - velocity(record.b));
  return speed > kRestingSteps * h_ * world.gravity.norm();
}

bool ContactStep::holds_all(const CollisionState& state,
                            std::span<const Eigen::Index> bodies) const {
  return std::all_of(bodies.begin(), bodies.end(), [&](Eigen::Index i) {
    return state.is_awake(i) && local_of_[static_cast<std::size_t>(i)] >= 0;
  });
}

bool ContactStep::pushes(std::size_t k) const {
  for (std::size_t i = first_point_[k]; i < first_point_[k + 1]; ++i)
    if (contacts_[i].normal_impulse > 0) return true;
  return false;
}

double ContactStep::least_gap(std::size_t k) const {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = first_point_[k]; i < first_point_[k + 1]; ++i)
    least = std::min(least, contacts_[i].gap);
  return least;
}

void ContactStep::find_movers(const CollisionState& state) {
  const World& world = state.world();
  movers_.clear();
  for (const Eigen::Index i : columns_) {
    if (!state.is_awake(i)) continue;
    const int system =
        world.systems.empty() ? World::kLone : world.system_of[static_cast<std::size_t>(i)];
    if (system == World::kLone) {
      movers_.push_back(i);
    } else {
      const auto& columns = world.systems[static_cast<std::size_t>(system)].columns;
      movers_.insert(movers_.end(), columns.begin(), columns.end());
    }
  }
  std::sort(movers_.begin(), movers_.end());
  movers_.erase(std::unique(movers_.begin(), movers_.end()), movers_.end());
}

}  // namespace poinsot
