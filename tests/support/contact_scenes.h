// Contact problems as a solver sees them: boxes in towers, walls and chains over one step of
// gravity. Body 0 is the ground. Normals point from b to a.

#pragma once

#include <span>
#include <string>
#include <vector>

#include "poinsot/contact/contact.h"

namespace poinsot::test {

constexpr double kGravity = 9.81;   // [m/s²]
constexpr double kStep = 1.0 / 60;  // [s]

struct ContactProblem {
  std::vector<ContactBody> bodies;
  std::vector<Contact> contacts;
  std::vector<double> target;
  std::vector<PointJoint> joints;

  int add_ground();
  int add_box(double mass, const Vec3& size, const Vec3& c, const Vec3& v = Vec3::Zero());
  int add_point(int a, int b, const Vec3& point, const Vec3& normal, double friction);
  // Four corners of a square of the given half side about `centre`, normal z.
  void add_square(int a, int b, const Vec3& centre, double half_x, double half_y, double friction);
  void add_joint(int a, int b, const Vec3& point);
  void fall(double h = kStep);  // gravity's velocity on what moves

  double kinetic_energy() const;
  Vec3 momentum() const;
};

// Unit boxes, lowest first, friction 0.6.
ContactProblem tower(std::span<const double> masses);
// nx × ny columns of nz unit boxes, neighbours touching with four points as well.
ContactProblem wall(int nx, int ny, int nz);
// A chain of links of 1 m and 1 kg that hangs from the ground at 45°, its last link heavier.
ContactProblem chain(int links, double last_mass);

// Sum of the normal impulses over statics, largest relative error of an interface of a tower.
double tower_force_error(const ContactProblem& solved, std::span<const double> masses,
                         double h = kStep);

}  // namespace poinsot::test
