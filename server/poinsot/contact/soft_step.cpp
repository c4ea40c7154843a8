#include "poinsot/contact/soft_step.h"

#include <vector>

#include "poinsot/contact/soft_blocks.h"
#include "poinsot/contact/soft_bodies.h"
#include "poinsot/contact/soft_joints.h"

namespace poinsot {
namespace {

// What all threads do together, one after another.
enum class Work {
  kSetBodies,
  kPack,
  kForces,
  kWarmJoints,
  kWarmStart,
  kJoints,
  kPush,
  kMove,
  kLevelJoints,
  kRelax,
  kBounce
};

}  // namespace

struct SoftStep::Scratch {
  SoftBodies bodies;
  SoftBlocks blocks;
  SoftJoints joints;
  // The plan of a step: what is done, in which run of blocks, and in how many pieces.
  struct Stage {
    Work work;
    std::size_t run;
  };
  std::vector<Stage> stages;
  std::vector<std::size_t> pieces;

  void add(Work work, std::size_t count) {
    stages.push_back({work, 0});
    pieces.push_back(count);
  }
  void add_sweep(Work work) {
    for (std::size_t run = 0; run < blocks.runs(); ++run) {
      stages.push_back({work, run});
      pieces.push_back(blocks.pieces(run));
    }
  }
  void plan(int steps, bool has_joints) {
    stages.clear();
    pieces.clear();
    add(Work::kSetBodies, bodies.pieces());
    add(Work::kPack, blocks.pack_pieces());
    for (int step = 0; step < steps; ++step) {
      add(Work::kForces, bodies.pieces());
      if (step == 0) {
        if (has_joints) add(Work::kWarmJoints, 1);
        add_sweep(Work::kWarmStart);
      }
      if (has_joints) add(Work::kJoints, 1);
      add_sweep(Work::kPush);
      add(Work::kMove, bodies.pieces());
      if (has_joints) add(Work::kLevelJoints, 1);
      add_sweep(Work::kRelax);
    }
    add_sweep(Work::kBounce);
  }
};

SoftStep::SoftStep() : scratch_(std::make_unique<Scratch>()) {}
SoftStep::~SoftStep() = default;
SoftStep::SoftStep(SoftStep&&) noexcept = default;
SoftStep& SoftStep::operator=(SoftStep&&) noexcept = default;

SoftOutcome SoftStep::advance(std::span<SoftBody> bodies, std::span<SoftManifold> manifolds,
                              std::span<PointJoint> joints, double duration,
                              const SoftSettings& settings, Team& team) {
  const double h = duration / settings.steps;  // steps ≥ 1
  Scratch& s = *scratch_;
  s.bodies.start(bodies, h);
  s.blocks.start(bodies, manifolds, settings, h);
  s.joints.start(bodies, joints);
  s.plan(settings.steps, !joints.empty());
  team.run_stages(s.pieces, [&](std::size_t stage, std::size_t piece, int) {
    const std::size_t run = s.stages[stage].run;
    switch (s.stages[stage].work) {
      case Work::kSetBodies:
        return s.bodies.set(piece, bodies);
      case Work::kPack:
        return s.blocks.pack(piece, bodies, manifolds, s.bodies);
      case Work::kForces:
        return s.bodies.take_forces(piece);
      case Work::kWarmJoints:
        return s.joints.warm_start(joints, s.bodies);
      case Work::kWarmStart:
        return s.blocks.warm_start(s.bodies, run, piece);
      case Work::kJoints:
        return s.joints.solve(joints, s.bodies, true);
      case Work::kPush:
        return s.blocks.push(s.bodies, run, piece);
      case Work::kMove:
        return s.bodies.move(piece);
      case Work::kLevelJoints:
        return s.joints.solve(joints, s.bodies, false);
      case Work::kRelax:
        return s.blocks.relax(s.bodies, run, piece);
      case Work::kBounce:
        return s.blocks.bounce(s.bodies, run, piece);
    }
  });
  s.bodies.finish(bodies);
  SoftOutcome outcome;
  s.blocks.finish(manifolds, outcome);
  outcome.force_work = s.bodies.work();
  outcome.loss = outcome.force_work + outcome.push_out_energy - s.bodies.kinetic_change();
  return outcome;
}

}  // namespace poinsot
