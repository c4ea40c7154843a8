#include "poinsot/collision/collision_layer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "poinsot/collision/contact_resolution.h"
#include "poinsot/collision/contact_set.h"

namespace poinsot {
namespace {

// Shares the CPU time of a frame among the layers as they shared its wall time: reading the CPU
// clock takes a system call, too dear for every sub-step.
class FrameTimes {
 public:
  explicit FrameTimes(CollisionTimes& times)
      : times_(times), before_(times), start_(Stopwatch::now()) {}
  ~FrameTimes() {
    const double cpu = Stopwatch::now().cpu_s - start_.cpu_s;
    const double wall = wall_of(times_) - wall_of(before_);
    if (wall <= 0) return;
    const auto share = [&](Elapsed& now, const Elapsed& before) {
      now.cpu_s += cpu * (now.wall_s - before.wall_s) / wall;
    };
    share(times_.collision, before_.collision);
    share(times_.contact, before_.contact);
    share(times_.simulation, before_.simulation);
  }
  FrameTimes(const FrameTimes&) = delete;
  FrameTimes& operator=(const FrameTimes&) = delete;

 private:
  static double wall_of(const CollisionTimes& t) {
    return t.collision.wall_s + t.contact.wall_s + t.simulation.wall_s;
  }

  CollisionTimes& times_;
  CollisionTimes before_;
  Elapsed start_;
};

// A body that is about to be frozen must not spoil the sums of all the others.
double finite_or_zero(double energy) {
  return std::isfinite(energy) ? energy : 0;
}

}  // namespace

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
  const FrameTimes frame_times(times_);
  simulation_.start_frame();
  const double t_start = time();
  if (!may_meet(t_end - t_start)) {
    advance_apart(t_end);
    return;
  }
  const int steps = step_count(t_end - t_start, longest_step_);
  for (int k = 1; k < steps; ++k) advance_substep(t_start + k * ((t_end - t_start) / steps));
  advance_substep(t_end);
}

bool CollisionLayer::may_meet(double h) {
  const Stopwatch::WallLap lap(times_.collision.wall_s);
  return !contacts_->set.contacts().empty() || contacts_->set.may_meet(world(), h);
}

// Nothing can touch: no sub-steps, no contacts.
void CollisionLayer::advance_apart(double t_end) {
  contacts_->set.forget();
  report_.contacts = 0;
  report_.max_penetration = 0;
  integrate(t_end);
}

void CollisionLayer::integrate(double t_end) {
  {
    const Stopwatch::WallLap lap(times_.simulation.wall_s);
    simulation_.advance_to(t_end);
  }
  if (simulation_.quarantined() != quarantined_) rebase_energy();
}

void CollisionLayer::advance_substep(double t_end) {
  const double h = t_end - time();
  auto& [set, resolution] = *contacts_;
  simulation_.freeze_unsound();  // before any geometry query
  {
    const Stopwatch::WallLap lap(times_.collision.wall_s);
    set.find(world(), h);
  }
  {
    const Stopwatch::WallLap lap(times_.contact.wall_s);
    report_.push_out_energy += finite_or_zero(resolution.push_out(world(), set, h));
    report_.impact_loss += finite_or_zero(resolution.resolve_impacts(world(), set, h));
    resolution.resolve_contacts(simulation_, set, h);
  }
  integrate(t_end);

  report_.contacts = 0;
  report_.max_penetration = 0;
  for (const Contact& contact : std::as_const(set).contacts()) {
    report_.contacts += contact.normal_impulse > 0 ? 1 : 0;
    report_.max_penetration = std::max(report_.max_penetration, -contact.gap);
  }
}

// A frozen body takes its energy with it: the balance of the others starts afresh.
void CollisionLayer::rebase_energy() {
  quarantined_ = simulation_.quarantined();
  start_energy_ += energy() - expected_energy();
}

double CollisionLayer::expected_energy() const {
  return start_energy_ + simulation_.work() - report_.impact_loss + report_.push_out_energy;
}

double CollisionLayer::energy() const {
  return kinetic_energy(world()) + potential_energy(world());
}

EnergyBalance CollisionLayer::energy_balance() {
  const double kinetic = kinetic_energy(world());
  energy_scale_.see(kinetic);
  const double energy = kinetic + potential_energy(world());
  const double scale = energy_scale_.value();
  return {energy, scale > 0 ? (energy - expected_energy()) / scale : 0};
}

void CollisionLayer::hash_into(Hash64& hash) const {
  contacts_->set.hash_into(hash);
  simulation_.hash_into(hash);
}

}  // namespace poinsot
