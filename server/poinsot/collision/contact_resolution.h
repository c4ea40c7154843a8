// What contacts do to a world in a sub-step, in three parts that follow one another:
//
// push_out: removes penetration from positions, at bounded speed.
//
// resolve_impacts: gives approaching pairs an impulse at an instant, with restitution and friction.
//
// resolve_contacts: gives standing pairs impulses λ that act as forces λ/h over the sub-step, so
// that gravity, held wrenches and contact are integrated together.
//
// README.md, section "A sub-step", gives the equations.

#pragma once

#include <span>
#include <vector>

#include "poinsot/collision/contact_set.h"
#include "poinsot/contact/sequential_impulses.h"
#include "poinsot/simulation/simulation_layer.h"

namespace poinsot {

class ContactResolution {
 public:
  explicit ContactResolution(const CollisionDef& def) : def_(def) {
    solver_.sweeps = def.iterations;
  }

  // Returns the energy added [J]. Updates the gaps.
  double push_out(World& world, ContactSet& set, double h);

  // Returns the kinetic energy lost [J].
  double resolve_impacts(World& world, ContactSet& set, double h);

  // Fills the layer's contact wrenches.
  void resolve_contacts(SimulationLayer& simulation, ContactSet& set, double h);

 private:
  void gather(const World& world);
  bool choose_impact_targets(const World& world, ContactSet& set, double h);

  CollisionDef def_;
  SequentialImpulses solver_;
  std::vector<ContactBody> bodies_, before_;
  std::vector<double> target_;  // [m/s] per contact
  std::vector<Contact> impacts_;
};

}  // namespace poinsot
