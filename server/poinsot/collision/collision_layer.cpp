#include "poinsot/collision/collision_layer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "poinsot/collision/contact_resolution.h"
#include "poinsot/collision/contact_set.h"

namespace poinsot {

struct CollisionLayer::Contacts {
  ContactSet set;
  ContactResolution resolution;
};

CollisionLayer::CollisionLayer(const Scene& scene)
    : simulation_(scene),
      contacts_(
          new Contacts{ContactSet(scene, simulation_.world()), ContactResolution(scene.collision)}),
      longest_step_(scene.collision.contact_step),
      energy_scale_(simulation_.world()),
      start_energy_(energy()) {}

CollisionLayer::~CollisionLayer() = default;
CollisionLayer::CollisionLayer(CollisionLayer&&) noexcept = default;
CollisionLayer& CollisionLayer::operator=(CollisionLayer&&) noexcept = default;

void CollisionLayer::advance_to(double t_end) {
  const double t_start = time();
  const int steps = step_count(t_end - t_start, longest_step_);
  for (int k = 1; k < steps; ++k) advance_substep(t_start + k * ((t_end - t_start) / steps));
  advance_substep(t_end);
}

void CollisionLayer::advance_substep(double t_end) {
  const double h = t_end - time();
  auto& [set, resolution] = *contacts_;
  {
    const Stopwatch::Lap lap(collision_elapsed_);
    set.find(world(), h);
  }
  {
    const Stopwatch::Lap lap(contact_elapsed_);
    report_.push_out_energy += resolution.push_out(world(), set, h);
    report_.impact_loss += resolution.resolve_impacts(world(), set, h);
    resolution.resolve_contacts(simulation_, set, h);
  }
  simulation_.advance_to(t_end);

  report_.contacts = 0;
  report_.max_penetration = 0;
  for (const Contact& contact : std::as_const(set).contacts()) {
    report_.contacts += contact.normal_impulse > 0 ? 1 : 0;
    report_.max_penetration = std::max(report_.max_penetration, -contact.gap);
  }
}

double CollisionLayer::energy() const {
  return kinetic_energy(world()) + potential_energy(world());
}

double CollisionLayer::energy_error() {
  const double kinetic = kinetic_energy(world());
  energy_scale_.see(kinetic);
  const WorkMeter& work = simulation_.work();
  const double expected =
      start_energy_ + work.held() + work.contact() - report_.impact_loss + report_.push_out_energy;
  const double scale = energy_scale_.value();
  return scale > 0 ? (kinetic + potential_energy(world()) - expected) / scale : 0;
}

void CollisionLayer::hash_into(Hash64& hash) const {
  contacts_->set.hash_into(hash);
}

}  // namespace poinsot
