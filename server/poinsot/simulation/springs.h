// Springs and drag: their force laws, and the systems of bodies that springs join.

#pragma once

#include <vector>

#include "poinsot/scene/scene.h"

namespace poinsot {

struct World;

// A spring between point p_a of body a and p_b of body b, or of W; indices into a system. Damping
// is of the velocity along the line between them, or if it is isotropic of all of it: a spring that
// is meant to have no length has no line.
struct SpringLink {
  int a;
  int b;             // kWorld: p_b is in W
  Vec3 p_a, p_b;     // [m] from the centre of mass, in B; or in W
  double stiffness;  // [N/m]
  double damping;    // [N·s/m]
  double rest;       // [m]
  bool isotropic = false;
  // The end in W is on a body that does not move: its column (none: kWorld), and the point [m] in
  // its B, from its origin.
  Eigen::Index anchor = kWorld;
  Vec3 p_anchor = Vec3::Zero();

  static constexpr int kWorld = -1;
  // Its force is linear in where its points are and how they move.
  bool is_linear() const { return rest == 0 && (isotropic || damping == 0); }
};

struct BodySystem {
  std::vector<Eigen::Index> columns;  // of the world
  std::vector<SpringLink> springs;
  std::vector<std::vector<int>> springs_of;  // per body: which springs hold it
  std::size_t scene_springs = 0;             // the first of `springs`; the others are tethers
};

// The systems of more than a lone body without springs, each in column order; empty if the scene
// has no springs. Springs between two bodies that do not move are left out.
std::vector<BodySystem> make_systems(const Scene& scene, const World& world);

// Takes all springs and tethers off body i. What they held together falls apart. Returns for each
// of the scene's systems that are left which one it was; kAnother: a part of one.
std::vector<int> drop_springs(World& world, Eigen::Index i);
inline constexpr int kAnother = -1;

// Springs to body i, which does not move, end where it is now.
void move_anchors(World& world, Eigen::Index i);

// The force of a spring on its point of a, in W [N], from the points and their velocities.
struct SpringForce {
  Vec3 elastic, damping;
};
SpringForce spring_force(const SpringLink& spring, const Vec3& x_a, const Vec3& x_b,
                         const Vec3& v_a, const Vec3& v_b);

// ½ k (d − rest)² [J].
double spring_energy(const SpringLink& spring, const Vec3& x_a, const Vec3& x_b);

// A spring of no length, with damping, from a body-fixed point to a point that stands still in W:
// what a client drags a body with. F = k (target − x) − d ẋ [N] at the point.
struct Tether {
  Eigen::Index column;
  Vec3 p_B;          // [m] from the centre of mass, in B
  Vec3 target;       // [m] in W
  double stiffness;  // [N/m]
  double damping;    // [N·s/m]

  template <class Archive>
  void archive(Archive& with) {
    with(column, p_B, target, stiffness, damping);
  }
};

// What drag exerts at velocity v [m/s] in W [N].
inline Vec3 drag_force(const DragDef& drag, const Vec3& v) {
  const double quadratic = drag.quadratic > 0 ? drag.quadratic * v.norm() : 0;
  return -(drag.linear + quadratic) * v;
}

}  // namespace poinsot
