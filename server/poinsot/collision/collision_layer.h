// The collision layer: what may meet before the frame ends is gone through island by island, from
// impact to impact and, where contacts last, in sub-steps; all else is left to the simulation
// layer as a whole.

#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "poinsot/base/archive.h"
#include "poinsot/base/hash.h"
#include "poinsot/base/stopwatch.h"
#include "poinsot/collision/impact_event.h"
#include "poinsot/simulation/diagnostics.h"
#include "poinsot/simulation/simulation_layer.h"

namespace poinsot {

// What the layer knows of the last frame, and sums since the start.
struct CollisionReport {
  std::uint32_t contacts = 0;  // points with a pushing impulse in the last sub-step
  double max_penetration = 0;  // [m] there, after push-out
  double impact_loss = 0;      // [J] kinetic energy taken out by impacts so far
  double push_out_energy = 0;  // [J] added by the removal of penetration so far

  // Of the last frame.
  std::uint32_t islands = 0;   // that were gone through
  std::uint32_t restarts = 0;  // times that islands were gone through again, merged
  std::uint32_t searches = 0;  // for impacts
  std::uint64_t search_poses = 0, search_gaps = 0;  // evaluations that they took
  std::uint32_t impacts = 0;                        // located
  bool crowded = false;             // more impacts in an island than it pays to locate
  std::uint32_t asleep = 0;         // bodies
  std::uint32_t soft_bodies = 0;    // stepped by soft_step
  std::uint32_t direct_bodies = 0;  // of islands whose contacts convex_newton solved
  // [m/s] The worst of the solves: of convex_newton how far from the law of contact
  // (SolveResidual::worst), of soft_step what its last sweep still changed (SoftOutcome::residual).
  double contact_residual = 0;
  std::uint32_t solver_iterations = 0;  // of convex_newton, all solves together
  std::uint32_t unconverged = 0;        // solves of it that did not reach its tolerance

  template <class Archive>
  void archive(Archive& with) {
    with(contacts, max_penetration, impact_loss, push_out_energy, islands, restarts, searches,
         search_poses, search_gaps, impacts, crowded, asleep, soft_bodies, direct_bodies,
         contact_residual, solver_iterations, unconverged);
  }
};

// What one body exerts on another at a point, as last solved. Sleeping pairs keep theirs.
struct ContactForce {
  int a, b;     // bodies, in scene order
  Vec3 point;   // [m] in W
  Vec3 normal;  // unit, in W, from b to a
  Vec3 force;   // [N] on a, in W; friction of a pair of the crowd is in its first point
};

struct EnergyBalance {
  double energy;  // [J] kinetic and potential
  double error;   // [-] relative, since the start
};

struct CollisionTimes {
  Elapsed collision;   // finding what meets, and when
  Elapsed contact;     // resolving contacts
  Elapsed simulation;  // integrating what nothing meets
};

// How CPU time is told from wall time while frames are short.
struct CpuShare {
  unsigned frames = 0;
  double last_wall_s = 0;   // [s] of the last frame
  double cpu_per_wall = 1;  // as last measured
};

class CollisionLayer {
 public:
  explicit CollisionLayer(const Scene& scene);
  ~CollisionLayer();
  CollisionLayer(CollisionLayer&&) noexcept;
  CollisionLayer& operator=(CollisionLayer&&) noexcept;

  // Afterwards time() == t_end exactly. Throws as SimulationLayer::begin() does.
  void advance_to(double t_end);

  double time() const { return world().time; }
  // To change something: what sleeps is looked at again.
  World& world();
  const World& world() const;
  const SimulationLayer& simulation() const;
  const CollisionReport& report() const { return report_; }
  // Located in the last frame, island by island and in order of time there.
  std::span<const ImpactEvent> impacts() const { return impacts_; }
  // Of all points that push, in the order of the pairs; replaces `forces`.
  void contact_forces(std::vector<ContactForce>& forces) const;
  bool is_asleep(Eigen::Index i) const;
  // Another one whenever the body's course changed, falling asleep included.
  std::uint32_t course_stamp(Eigen::Index i) const;

  // Energy [J], and the relative energy error since the start [-]: what the energy changed by
  // beyond the work of held wrenches, the work and loss at contacts and the push-out, over the
  // energy scale. Work includes what the ends of tethers did that were moved.
  EnergyBalance energy_balance();
  double energy() const;
  double energy_error() { return energy_balance().error; }

  // Changes from outside, between frames. Each wakes what it touches and leaves the courses of all
  // other bodies alone, to the bit. The energy balance takes what they bring, or take away, as
  // given; that of a kick is work.

  // Adds a body that is valid in itself and with the others (its name and generation included), in
  // the first absent column or a new one.
  Eigen::Index spawn(const BodyDef& body);
  // Its column becomes absent: no shape, no mass, found by nobody. Springs to it go with it.
  void remove(Eigen::Index i);
  // Pose of B in W and velocity of the centre of mass of a dynamic or kinematic body; of a static
  // one the pose. What overlaps then is pushed out at bounded speed. A frozen body moves again.
  void set_state(Eigen::Index i, const Pose& pose, const Velocity& velocity);
  // Changes P and L of a dynamic body at once: impulse [N·s] and angular impulse [N·m·s] about the
  // centre of mass, in W.
  void kick(Eigen::Index i, const Wrench& impulse);
  // All tethers from now on; those of columns that do not move are ignored. The change of their
  // energy is work, and no reason to start the balance afresh. The same ones again change nothing.
  // Throws Error as SimulationLayer::set_tethers() does.
  void set_tethers(std::span<const Tether> tethers);

  // All that a continuation depends on, for a layer of the same scene, bodies spawned and absent
  // included: it then goes on bit for bit. restore() throws Error if the bytes are not such a
  // state; the layer is then to be thrown away.
  void save(ByteWriter& out) const;
  void restore(ByteReader& in);

  // Adds what a continuation depends on besides the world.
  void hash_into(Hash64& hash) const;

  // Time spent so far. CPU time is read once per frame and shared out as wall time is.
  const CollisionTimes& times() const { return times_; }

 private:
  template <class Archive>
  void archive(Archive& with);
  void rebase_energy();
  double energy_about(Eigen::Index i) const;
  void take_as_given(double energy);
  double expected_energy() const;  // [J] from the start, the work and the losses

  struct Frame;  // keeps geometry out of the layers above
  std::unique_ptr<Frame> frame_;
  CollisionReport report_;
  std::vector<ImpactEvent> impacts_;
  EnergyScale energy_scale_;
  bool scale_is_old_ = false;  // bodies came, went or were moved since
  double start_energy_;        // [J]
  std::uint32_t quarantined_ = 0;
  CollisionTimes times_;
  CpuShare cpu_share_;
};

// Pairs of bodies that overlap by more than the scene's tolerance, as faults that name both and the
// depth.
std::vector<SceneFault> find_overlaps(const Scene& scene);

}  // namespace poinsot
