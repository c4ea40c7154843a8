#include "poinsot/collision/contact_set.h"

#include <algorithm>
#include <cmath>

#include "poinsot/collision/proximity.h"

namespace poinsot {
namespace {

// Pairs of the broad phase are made to last about this many sub-steps.
constexpr double kLastingSteps = 4;
// A point continues an old one of its pair when it moved by less than this, relative to the size.
constexpr double kSamePoint = 0.25;

std::vector<bool> moving(std::span<const Collider> colliders, const World& world) {
  std::vector<bool> result;
  for (const Collider& collider : colliders) result.push_back(world.moves(collider.body));
  return result;
}

double smaller(double a, double b) {
  return std::min(a, b);
}

}  // namespace

std::vector<Collider> make_colliders(const Scene& scene) {
  std::vector<Collider> colliders;
  for (std::size_t k = 0; k < scene.bodies.size(); ++k) {
    const BodyDef& body = scene.bodies[k];
    for (const ShapeDef& def : body.shapes)
      colliders.emplace_back(static_cast<Eigen::Index>(k), def.shape,
                             Pose{def.pose.c - body.mass_properties.center_of_mass, def.pose.q});
  }
  return colliders;
}

ContactSet::ContactSet(const Scene& scene, const World& world)
    : def_(scene.collision),
      colliders_(make_colliders(scene)),
      broad_phase_(colliders_, moving(colliders_, world)) {
  for (const BodyDef& body : scene.bodies) materials_.push_back(body.material);
  poses_.resize(colliders_.size());
  travel_.resize(colliders_.size());
  reach_.resize(colliders_.size());
  boxes_.resize(colliders_.size());
  for (auto* list : {&contacts_, &last_contacts_}) list->reserve(8 * colliders_.size());
  for (auto* list : {&memories_, &last_memories_}) list->reserve(8 * colliders_.size());
}

bool ContactSet::may_meet(const World& world, double h) {
  if (colliders_.empty()) return false;
  place(world, h);
  for (const ColliderPair& pair : broad_phase_.pairs(boxes_, reach_))
    if (may_touch(pair)) return true;
  return false;
}

void ContactSet::forget() {
  contacts_.clear();
  memories_.clear();
}

bool ContactSet::may_touch(const ColliderPair& pair) const {
  const auto a = static_cast<std::size_t>(pair.a), b = static_cast<std::size_t>(pair.b);
  if (std::isinf(colliders_[a].size)) return reaches(boxes_[b], a);
  if (std::isinf(colliders_[b].size)) return reaches(boxes_[a], b);
  return boxes_[a].overlaps(boxes_[b]);
}

// Half-spaces have no box: whether one's lowest corner is under the plane.
bool ContactSet::reaches(const Aabb& box, std::size_t half_space) const {
  const HalfSpace& plane = std::get<HalfSpace>(colliders_[half_space].shape);
  const Pose& pose = poses_[half_space];
  const Vec3 n = pose.q * plane.normal;
  const Vec3 lowest = (n.array() > 0).select(box.low, box.high);
  return n.dot(lowest - pose.c) <= plane.offset;
}

void ContactSet::find(const World& world, double h) {
  std::swap(contacts_, last_contacts_);
  std::swap(memories_, last_memories_);
  contacts_.clear();
  memories_.clear();
  place(world, h);
  Manifold manifold;
  for (const ColliderPair& pair : broad_phase_.pairs(boxes_, reach_)) {
    const auto a = static_cast<std::size_t>(pair.a), b = static_cast<std::size_t>(pair.b);
    if (!may_touch(pair)) continue;
    const double size = smaller(colliders_[a].size, colliders_[b].size);
    const double margin = def_.contact_margin * size + travel_[a] + travel_[b];
    find_manifold(colliders_[a], poses_[a], colliders_[b], poses_[b], margin, manifold);
    add(world, pair, manifold);
  }
  recall(h);
  last_h_ = h;
}

void ContactSet::place(const World& world, double h) {
  speeds_.update(world, h);
  for (std::size_t i = 0; i < colliders_.size(); ++i) {
    const Collider& collider = colliders_[i];
    const Eigen::Index body = collider.body;
    poses_[i] = Pose{position(world.y, body), orientation(world.y, body)} * collider.in_body;
    if (std::isinf(collider.size)) continue;
    // No point of the body is faster in the next h, unless another body strikes it.
    SpeedBound bound;
    if (world.moves(body)) bound = speeds_.of(world, body);
    const double arm = collider.in_body.c.norm() + collider.bounding_radius;
    travel_[i] = h * (bound.v + arm * bound.omega);
    reach_[i] = kLastingSteps * travel_[i] + 0.05 * collider.size;
    boxes_[i] = bounds(collider, poses_[i]).grown(travel_[i] + def_.contact_margin * collider.size);
  }
}

void ContactSet::add(const World& world, const ColliderPair& pair, const Manifold& manifold) {
  const Collider& a = colliders_[static_cast<std::size_t>(pair.a)];
  const Collider& b = colliders_[static_cast<std::size_t>(pair.b)];
  const Material& material_a = materials_[static_cast<std::size_t>(a.body)];
  const Material& material_b = materials_[static_cast<std::size_t>(b.body)];
  const Eigen::Index mover = world.moves(a.body) ? a.body : b.body;
  for (int k = 0; k < manifold.count; ++k) {
    const ManifoldPoint& p = manifold.points[static_cast<std::size_t>(k)];
    Contact contact;
    contact.a = static_cast<int>(a.body);
    contact.b = static_cast<int>(b.body);
    contact.point = p.point;
    contact.normal = manifold.normal;
    contact.gap = p.gap;
    contact.restitution = std::max(material_a.restitution, material_b.restitution);
    contact.friction = std::sqrt(material_a.friction * material_b.friction);
    contacts_.push_back(contact);
    // On the mover's own surface: the point midway moves while the gap closes.
    const double to_surface = (mover == a.body ? 0.5 : -0.5) * p.gap;
    const Vec3 on_mover = p.point + to_surface * manifold.normal;
    memories_.push_back({pair, on_mover - position(world.y, mover), smaller(a.size, b.size), 0});
  }
}

// Both lists are in pair order: one walk over both.
void ContactSet::recall(double h) {
  const double impulse_scale = last_h_ > 0 ? h / last_h_ : 0;
  std::size_t old = 0;
  for (std::size_t first = 0; first < contacts_.size();) {
    const ColliderPair pair = memories_[first].pair;
    std::size_t end = first;
    while (end < contacts_.size() && memories_[end].pair == pair) ++end;
    while (old < last_memories_.size() && last_memories_[old].pair < pair) ++old;
    std::size_t old_end = old;
    while (old_end < last_memories_.size() && last_memories_[old_end].pair == pair) ++old_end;

    std::uint64_t taken = 0;  // at most four old points of a pair: a bit each
    for (std::size_t i = first; i < end; ++i) {
      double nearest = kSamePoint * memories_[i].size;
      std::size_t match = old_end;
      for (std::size_t j = old; j < old_end; ++j) {
        const double distance = (last_memories_[j].offset - memories_[i].offset).norm();
        if ((taken >> (j - old) & 1) != 0 || distance >= nearest) continue;
        nearest = distance;
        match = j;
      }
      if (match == old_end) continue;
      taken |= std::uint64_t{1} << (match - old);
      const Contact& before = last_contacts_[match];
      Contact& now = contacts_[i];
      now.normal_impulse = impulse_scale * before.normal_impulse;
      now.friction_impulse = impulse_scale * (before.friction_impulse -
                                              now.normal.dot(before.friction_impulse) * now.normal);
      memories_[i].approach = last_memories_[match].approach;
    }
    old = old_end;
    first = end;
  }
}

void ContactSet::hash_into(Hash64& hash) const {
  hash.add(static_cast<std::uint64_t>(contacts_.size()));
  hash.add(last_h_);
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    hash.add(static_cast<std::uint64_t>(memories_[i].pair.a));
    hash.add(static_cast<std::uint64_t>(memories_[i].pair.b));
    hash.add(contacts_[i].normal_impulse);
    for (const double x : contacts_[i].friction_impulse) hash.add(x);
    for (const double x : memories_[i].offset) hash.add(x);
    hash.add(memories_[i].approach);
  }
}

}  // namespace poinsot
