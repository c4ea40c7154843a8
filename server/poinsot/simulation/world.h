// The bodies: their constant properties, their state, and what acts on them. Everything per body is
// an array in the same order, the order of the scene file; static bodies are columns like the
// others, with zero inverse mass. Bodies come and go: the column of one that is gone is absent,
// like a static body without a shape or a name, until the next that comes takes it.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "poinsot/base/body_id.h"
#include "poinsot/math/pose.h"
#include "poinsot/math/principal_axes.h"
#include "poinsot/scene/scene.h"
#include "poinsot/simulation/held_wrench.h"
#include "poinsot/simulation/springs.h"
#include "poinsot/simulation/state.h"

namespace poinsot {

struct Velocity {
  Vec3 linear = Vec3::Zero();   // [m/s] of the centre of mass, in W
  Vec3 angular = Vec3::Zero();  // [rad/s] in W

  template <class Archive>
  void archive(Archive& with) {
    with(linear, angular);
  }
};

enum class Motion : std::uint8_t {
  dynamic,
  fixed,      // static in the scene
  kinematic,  // moves evenly, whatever it meets
  frozen,     // dynamic, but its state became non-finite: held at its last good pose
  absent,     // a column that no body has
};

struct World {
  explicit World(const Scene& scene);

  Eigen::Index size() const { return y.cols(); }
  bool moves(Eigen::Index i) const {
    return motion[static_cast<std::size_t>(i)] == Motion::dynamic;
  }

  bool is_kinematic(Eigen::Index i) const {
    return motion[static_cast<std::size_t>(i)] == Motion::kinematic;
  }

  bool is_absent(Eigen::Index i) const {
    return motion[static_cast<std::size_t>(i)] == Motion::absent;
  }

  // Column of a body; nothing if there is no such body.
  std::optional<Eigen::Index> find(BodyId id) const;
  std::optional<Eigen::Index> find(std::string_view name) const;

  // Adds a body in the lowest absent column, or in a new one: which.
  Eigen::Index add(const BodyDef& body);
  // Makes a column absent; its id stays, with the generation that it had.
  void remove(Eigen::Index i);
  // From now on body i is there: pose of B in W, velocity of the centre of mass; of a body that
  // does not move the pose alone. A frozen one moves again.
  void set_state(Eigen::Index i, const Pose& pose, const Velocity& v);

  // Sets who is in which of the systems, all of which are the scene's.
  void number_systems();

  // Sets a body at rest for good at its present pose, and makes it a moving one again.
  void freeze(Eigen::Index i);
  void thaw(Eigen::Index i);

  // What of it changes in a run, for a world of the same scene.
  template <class Archive>
  void archive(Archive& with);

  double time = 0;  // [s]
  Vec3 gravity;     // [m/s²] in W
  StateArray y;     // 13×n

  // Constant, unless a body is frozen.
  std::vector<BodyId> ids;
  std::vector<std::string> names;             // empty: absent
  std::vector<Eigen::Index> columns_by_name;  // of those with a name, ascending by it
  std::vector<Motion> motion;
  std::vector<double> mass;          // [kg] 0 for static bodies
  std::vector<double> inv_mass;      // [1/kg] 0 for bodies that do not move
  std::vector<Vec3> center_of_mass;  // [m] in B
  std::vector<Mat3> J_B;             // [kg·m²] about the centre of mass, in B
  std::vector<Mat3> inv_J_B;         // [1/(kg·m²)] 0 for bodies that do not move

  std::vector<PrincipalAxes> principal_axes;
  std::vector<DragDef> drag;        // empty: no body had any yet
  std::vector<BodySystem> systems;  // bodies with springs or tethers; empty: there are none
  std::vector<int> system_of;       // index into systems, or kLone; empty as systems
  std::vector<int> place_of;        // index into that system's columns; empty as systems
  static constexpr int kLone = -1;
  std::size_t scene_systems = 0;  // the first of `systems`; the others are a tethered body each

  // Set by set_tethers() (tethers.h).
  std::vector<Tether> tethers;
  struct TetherPlace {
    int system, spring;  // indices into systems, and into that system's springs
  };
  std::vector<TetherPlace> tether_places;  // as tethers

  // Per column; empty: there was no kinematic body yet.
  struct Kinematic {
    Velocity velocity;
    Pose start;        // of the centre of mass …
    double since = 0;  // [s] … at this time

    template <class Archive>
    void archive(Archive& with) {
      with(velocity, start, since);
    }
  };
  std::vector<Kinematic> kinematic;

  // Inputs of the frame.
  std::vector<HeldWrench> held;

 private:
  void append();
  void fill(Eigen::Index i, const BodyDef& body);
  std::string_view name_of(Eigen::Index i) const { return names[static_cast<std::size_t>(i)]; }
};

// Derived quantities of one body.
Mat3 rotation(const World& world, Eigen::Index i);          // R, B → W
Mat3 inv_J_W(const World& world, Eigen::Index i);           // R J⁻¹ Rᵀ
Vec3 linear_velocity(const World& world, Eigen::Index i);   // [m/s] of the centre of mass
Vec3 angular_velocity(const World& world, Eigen::Index i);  // [rad/s] in W
Pose body_pose(const World& world, Eigen::Index i);         // of B in W

// What acts on body i now, about c, in W: gravity, held wrench, drag, springs and tethers [N, N·m].
Wrench acting_wrench(const World& world, Eigen::Index i);

// Elastic energy of springs and tethers, of one system or of all [J].
double spring_energy(const World& world, const BodySystem& system);
double spring_energy(const World& world);

}  // namespace poinsot
