// The simulation layer: moves bodies from one time to another under gravity, held wrenches, drag,
// springs and contact wrenches. It does not know that shapes exist.
//
// Each body is moved by what it needs. With integrator `exact`: not at all if it does not move, by
// its closed form while it flies (flight.h), by what integration.h chooses while something acts on
// it. The other integrators move every body. Kinematic bodies move evenly.
//
// Sets of bodies that no spring joins may be advanced separately, to times of their own, and at
// the same time by threads with a SimulationWorker each; commit() makes the frame's end the time of
// all.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "poinsot/base/hash.h"
#include "poinsot/simulation/course.h"
#include "poinsot/simulation/integration.h"
#include "poinsot/simulation/tethers.h"

namespace poinsot {

// What an advance of some bodies adds to the books. Sums are formed in the order of the sets, not
// of the threads.
struct Tally {
  double work = 0;      // [J] of held and contact wrenches, drag and damping, and on tethers
  LocalError error;     // sum over the advances of the largest of all bodies
  double mismatch = 0;  // [kg·m²/s] the same of |ΔL − ∫τ|
  double largest_momentum = 0;    // [kg·m²/s]
  std::uint32_t quarantined = 0;  // bodies frozen
  bool stiff = false;

  void add(const Tally& later);         // of the same bodies
  void add_apart(const Tally& others);  // of other bodies at the same time
  template <class Archive>
  void archive(Archive& with) {
    with(work, error, mismatch, largest_momentum, quarantined, stiff);
  }
};

// Scratch of one thread.
struct SimulationWorker {
  explicit SimulationWorker(const World& world);

  // Makes room for the springs of all systems.
  void prepare(const World& world);

  TaylorSeries taylor;
  Workspace lone;
  std::vector<Workspace> systems;  // of the scene's, to look ahead with
};

class SimulationLayer {
 public:
  explicit SimulationLayer(const Scene& scene);

  // Begins an advance of all bodies to t_end. Throws Error if t_end is not finite, lies in the past
  // or more than 1e9 fixed steps ahead, or if a held wrench is not finite: before anything moved.
  void begin(double t_end);

  // Moves `bodies`, systems as a whole, from time `from`, at which they are, to `to`. Contact
  // wrenches, if `in_contact`, act meanwhile and are zero afterwards. A body whose state became
  // non-finite is put back to where its last advance left it and frozen there.
  void advance(std::span<const Eigen::Index> bodies, double from, double to, bool in_contact,
               SimulationWorker& worker, Tally& tally);

  // These bodies were moved by others to the states they have; unsound ones are put back and
  // frozen.
  void accept(std::span<const Eigen::Index> bodies, Tally& tally);

  // All bodies are at t_end: it becomes the world's time.
  void commit(double t_end, const Tally& tally);

  // begin, advance of everything, commit.
  void advance_to(double t_end);

  // Puts bodies whose state is not finite, or absurd, back to where their last advance left them,
  // and freezes them there. Callers that changed the state call it before they ask anything.
  void freeze_unsound(std::span<const Eigen::Index> bodies, Tally& tally);

  // The flight that courses of body i look at, wherever it is now.
  const Flight& flight(Eigen::Index i) const { return flights_[static_cast<std::size_t>(i)]; }
  // The course of a body from its present state, which it has at `from`, on. Valid until its state,
  // its wrenches or `worker` are used for something else; a flight's lasts as long as the flight.
  Course course(Eigen::Index i, double from, double to, bool in_contact, SimulationWorker& worker);
  // The state of a driven body at time t of such a course.
  Course::Column preview(Eigen::Index i, const Course::Preview& course, double t);
  // Whether the body flies, and has not been touched since its flight was last evaluated or begun.
  bool is_in_flight(Eigen::Index i) const;
  // Begins a flight, at time `from`, unless the body is in one; and how that flight may turn.
  void begin_flight(Eigen::Index i, double from);
  const RotationBound& turning(Eigen::Index i, double from);
  // Something but gravity acts on the body in this frame, contacts aside.
  bool is_driven(Eigen::Index i) const { return driven_[static_cast<std::size_t>(i)] != 0; }
  // The body is left alone from now on: nothing moves it.
  void rest(Eigen::Index i) { methods_[static_cast<std::size_t>(i)] = Method::none; }
  bool flies_free() const { return integration_.kind() == IntegratorKind::exact; }

  // Changes from outside, between frames. What a body did before leaves no trace in its column.
  Eigen::Index add(const BodyDef& body);
  // Springs to it go with it: if it says so, workers of others are to be made anew.
  bool remove(Eigen::Index i);
  void set_state(Eigen::Index i, const Pose& pose, const Velocity& velocity);
  // Changes the momenta of a dynamic body by an impulse [N·s, N·m·s] about c, in W; what its
  // kinetic energy changes by is work.
  void kick(Eigen::Index i, const Wrench& impulse);
  // All tethers from now on, between frames; those of columns that do not move are ignored. The
  // change of their energy counts as work; what a system knows of its steps is forgotten if its
  // tethers changed in more than their targets. Throws Error if one is not finite or pushes, before
  // anything changed. Afterwards workers of others are to be prepared if it says `joined`.
  TetherChange set_tethers(std::span<const Tether> tethers);

  World& world() { return world_; }
  const World& world() const { return world_; }

  // Wrench about c, in W, that contacts exert on each body in an advance in contact.
  std::span<Wrench> contact_wrenches() { return contact_wrenches_; }

  std::uint32_t quarantined() const { return total_.quarantined; }  // bodies frozen so far
  double work() const { return total_.work; }                       // [J] so far

  // What moved each body in the last advance, in column order.
  std::span<const Method> methods() const { return methods_; }
  bool is_stiff() const { return total_.stiff; }  // a system is integrated implicitly

  // Local errors of the last frame, the largest of all bodies.
  LocalError local_error() const;
  // Sum over the advances of the largest |ΔL − ∫τ| of a body, over the largest |L| seen [-].
  double momentum_error() const;

  // Adds what a continuation depends on besides the world: where flights began, and step sizes.
  void hash_into(Hash64& hash) const;

  // All that a continuation depends on; scratch is left out. For a layer of the same scene.
  template <class Archive>
  void archive(Archive& with);
  // To a course of body i that was read from bytes: whose it is. False if there can be none such.
  bool attach(Course& course, Eigen::Index i);

  // What of a body changes in an advance: to go back to.
  struct Backup {
    Course::Column y = Course::Column::Zero(), last_good = Course::Column::Zero();
    Flight flight;
    RotationBound turning;
    bool turning_known = false;
    Method method = Method::none;
    Motion motion = Motion::dynamic;
    StepMemory memory, system_memory;  // the system's with its first body
  };
  Backup backup(Eigen::Index i) const;
  void restore(Eigen::Index i, const Backup& backup);

 private:
  // Bodies to be integrated together, and what they keep between advances.
  struct Group {
    std::span<const Eigen::Index> columns;
    std::span<const SpringLink> springs;
    Workspace& work;
    StepMemory& memory;
  };
  struct Advance {
    SimulationWorker& worker;
    bool in_contact;
    LocalError error;
    double mismatch = 0;
  };

  void begin_anew(Eigen::Index i);
  void drop_springs(Eigen::Index i);
  bool is_pushed(Eigen::Index i) const;
  bool in_system(Eigen::Index i) const;
  bool in_scene_system(Eigen::Index i) const;
  Course kinematic_course(Eigen::Index i, double to) const;
  Group system_group(int s, std::vector<Workspace>& of_scene, Workspace& lone, StepMemory& memory);
  StepMemory& system_memory(int s);
  void load(const Group& group, bool in_contact) const;
  void fly(Eigen::Index i, double from, double to, Tally& tally);
  void integrate(const Group& group, double duration, Advance& advance, Tally& tally);

  World world_;
  Integration integration_;
  std::vector<Wrench> contact_wrenches_;
  StateArray last_good_;  // 13×n, at the end of each body's last advance

  std::vector<Method> methods_;
  std::vector<std::uint8_t> driven_;    // in this frame: something but gravity acts
  std::vector<Flight> flights_;         // of bodies whose method is flight
  std::vector<RotationBound> turning_;  // of those flights, once asked for
  std::vector<std::uint8_t> turning_known_;
  std::vector<StepMemory> memories_;         // per body, for the embedded pairs
  std::vector<StepMemory> system_memories_;  // of the scene's systems …
  std::vector<Workspace> systems_;           // … as these
  std::vector<Eigen::Index> relaid_;         // columns whose tethers changed, while they do
  std::vector<Eigen::Index> all_;            // columns
  std::vector<SimulationWorker> own_;        // of advance_to

  Tally total_;
  LocalError frame_error_;
};

}  // namespace poinsot
