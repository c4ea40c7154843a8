#include "support/contact_scenes.h"

#include <algorithm>
#include <cmath>

namespace poinsot::test {

constexpr double kFriction = 0.6;

int ContactProblem::add_ground() {
  ContactBody ground;
  ground.c = ground.v = ground.omega = Vec3::Zero();
  bodies.push_back(ground);
  return static_cast<int>(bodies.size()) - 1;
}

int ContactProblem::add_box(double mass, const Vec3& size, const Vec3& c, const Vec3& v) {
  ContactBody body;
  body.c = c;
  body.v = v;
  body.omega.setZero();
  body.inv_mass = 1 / mass;
  const Vec3 s = size.cwiseProduct(size);
  body.inv_J_W = Vec3(12 / (mass * (s.y() + s.z())), 12 / (mass * (s.x() + s.z())),
                      12 / (mass * (s.x() + s.y())))
                     .asDiagonal();
  bodies.push_back(body);
  return static_cast<int>(bodies.size()) - 1;
}

int ContactProblem::add_point(int a, int b, const Vec3& point, const Vec3& normal,
                              double friction) {
  Contact contact;
  contact.a = a;
  contact.b = b;
  contact.point = point;
  contact.normal = normal;
  contact.friction = friction;
  contacts.push_back(contact);
  target.push_back(0);
  return static_cast<int>(contacts.size()) - 1;
}

void ContactProblem::add_square(int a, int b, const Vec3& centre, double half_x, double half_y,
                                double friction) {
  for (const double x : {-half_x, half_x})
    for (const double y : {-half_y, half_y})
      add_point(a, b, centre + Vec3(x, y, 0), Vec3::UnitZ(), friction);
}

void ContactProblem::add_joint(int a, int b, const Vec3& point) {
  PointJoint joint;
  joint.a = a;
  joint.b = b;
  joint.point = point;
  joints.push_back(joint);
}

void ContactProblem::fall(double h) {
  for (ContactBody& body : bodies)
    if (body.inv_mass > 0) body.v.z() -= h * kGravity;
}

double ContactProblem::kinetic_energy() const {
  double sum = 0;
  for (const ContactBody& body : bodies)
    if (body.inv_mass > 0)
      sum += 0.5 * body.v.squaredNorm() / body.inv_mass +
             0.5 * body.omega.dot(body.inv_J_W.inverse() * body.omega);
  return sum;
}

Vec3 ContactProblem::momentum() const {
  Vec3 sum = Vec3::Zero();
  for (const ContactBody& body : bodies)
    if (body.inv_mass > 0) sum += body.v / body.inv_mass;
  return sum;
}

ContactProblem tower(std::span<const double> masses) {
  ContactProblem problem;
  int below = problem.add_ground();
  double z = 0;
  for (const double mass : masses) {
    const int box = problem.add_box(mass, Vec3::Ones(), {0, 0, z + 0.5});
    problem.add_square(box, below, {0, 0, z}, 0.5, 0.5, kFriction);
    below = box;
    z += 1;
  }
  problem.fall();
  return problem;
}

ContactProblem wall(int nx, int ny, int nz) {
  ContactProblem problem;
  problem.add_ground();
  const auto box = [&](int i, int j, int k) { return 1 + i + nx * (j + ny * k); };
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) problem.add_box(1, Vec3::Ones(), {i + 0.5, j + 0.5, k + 0.5});
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) {
        const int mine = box(i, j, k);
        problem.add_square(mine, k > 0 ? box(i, j, k - 1) : 0, {i + 0.5, j + 0.5, double(k)}, 0.5,
                           0.5, kFriction);
        if (i > 0 && (i + j + k) % 2 == 0)
          problem.add_point(mine, box(i - 1, j, k), {double(i), j + 0.5, k + 0.5}, Vec3::UnitX(),
                            kFriction);
        if (j > 0 && (i + j + k) % 2 == 1)
          problem.add_point(mine, box(i, j - 1, k), {i + 0.5, double(j), k + 0.5}, Vec3::UnitY(),
                            kFriction);
      }
  problem.fall();
  return problem;
}

ContactProblem chain(int links, double last_mass) {
  ContactProblem problem;
  int before = problem.add_ground();
  const Vec3 along = Vec3(1, 0, -1).normalized();
  for (int i = 0; i < links; ++i) {
    const int link =
        problem.add_box(i + 1 == links ? last_mass : 1.0, {0.2, 0.3, 1}, (i + 0.5) * along);
    problem.add_joint(link, before, i * along);
    before = link;
  }
  problem.fall();
  return problem;
}

double tower_force_error(const ContactProblem& solved, std::span<const double> masses, double h) {
  double worst = 0, above = 0;
  for (std::size_t k = masses.size(); k-- > 0;) {
    above += masses[k] * kGravity * h;
    double sum = 0;
    for (std::size_t i = 4 * k; i < 4 * k + 4; ++i) sum += solved.contacts[i].normal_impulse;
    worst = std::max(worst, std::abs(sum / above - 1));
  }
  return worst;
}

}  // namespace poinsot::test
