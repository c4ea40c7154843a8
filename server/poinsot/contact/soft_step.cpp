#include "poinsot/contact/soft_step.h"

#include <algorithm>
#include <cmath>

#include "poinsot/contact/contact_colors.h"
#include "poinsot/contact/soft_blocks.h"
#include "poinsot/contact/soft_bodies.h"
#include "poinsot/contact/soft_joints.h"

namespace poinsot {

struct SoftStep::Scratch {
  SoftBodies bodies;
  SoftBlocks blocks;
  SoftJoints joints;
};

SoftStep::SoftStep() : scratch_(std::make_unique<Scratch>()) {}
SoftStep::~SoftStep() = default;
SoftStep::SoftStep(SoftStep&&) noexcept = default;
SoftStep& SoftStep::operator=(SoftStep&&) noexcept = default;

SoftOutcome SoftStep::advance(std::span<SoftBody> bodies, std::span<SoftManifold> manifolds,
                              std::span<PointJoint> joints, double duration,
                              const SoftSettings& settings, Team&) {
  const double h = duration / settings.steps;
  Scratch& s = *scratch_;
  s.bodies.start(bodies, h);
  s.blocks.start(bodies, manifolds, s.bodies, settings, h);
  s.joints.start(bodies, joints);
  s.blocks.note_approach(s.bodies);
  const std::size_t count = bodies.size();
  for (int step = 0; step < settings.steps; ++step) {
    s.bodies.take_forces(0, count);
    if (step == 0) {
      s.joints.warm_start(joints, s.bodies);
      s.blocks.warm_start(s.bodies);
    }
    s.joints.solve(joints, s.bodies, true);
    s.blocks.push(s.bodies);
    s.bodies.move(0, count);
    s.joints.solve(joints, s.bodies, false);
    s.blocks.relax(s.bodies);
  }
  s.blocks.bounce(s.bodies);
  s.bodies.finish(bodies);
  SoftOutcome outcome;
  s.blocks.finish(manifolds, outcome);
  outcome.force_work = s.bodies.work();
  outcome.loss = outcome.force_work + outcome.push_out_energy - s.bodies.kinetic_change();
  return outcome;
}

}  // namespace poinsot
