#include "poinsot/contact/sequential_impulses.h"

#include <random>

#include <gtest/gtest.h>

namespace poinsot {
namespace {

ContactBody body(double mass, const Vec3& c, const Vec3& v = Vec3::Zero()) {
  ContactBody b;
  b.c = c;
  b.v = v;
  b.omega.setZero();
  b.inv_mass = 1 / mass;
  b.inv_J_W = (6 / mass) * Mat3::Identity();  // a unit cube
  return b;
}

ContactBody fixed() {
  ContactBody b;
  b.c = b.v = b.omega = Vec3::Zero();
  return b;
}

Contact touch(int a, int b, const Vec3& point, double friction) {
  Contact contact;
  contact.a = a;
  contact.b = b;
  contact.point = point;
  contact.normal = Vec3::UnitZ();
  contact.friction = friction;
  return contact;
}

std::vector<Contact> four_corners(int a, int b, double z, double friction) {
  std::vector<Contact> contacts;
  for (const double x : {-0.5, 0.5})
    for (const double y : {-0.5, 0.5}) contacts.push_back(touch(a, b, {x, y, z}, friction));
  return contacts;
}

TEST(SequentialImpulses, OneContactIsSolvedExactly) {
  std::vector<ContactBody> bodies = {body(2, {0, 0, 0.5}, {0, 0, -3}), fixed()};
  std::vector<Contact> contacts = {touch(0, 1, {0, 0, 0}, 0)};
  SequentialImpulses solver;
  solver.solve(bodies, contacts, std::vector<double>{1.5});
  EXPECT_NEAR(bodies[0].v.z(), 1.5, 1e-15);
  EXPECT_NEAR(contacts[0].normal_impulse, 2 * 4.5, 1e-14);
}

TEST(SequentialImpulses, ABlockIsCarriedByItsCorners) {
  // A step of gravity under a cube at rest: the four impulses sum to m g h and leave it at rest.
  std::vector<ContactBody> bodies = {body(2, {0, 0, 0.5}, {0, 0, -9.81 / 240}), fixed()};
  std::vector<Contact> contacts = four_corners(0, 1, 0, 0.5);
  SequentialImpulses solver;
  solver.sweeps = 200;
  solver.settled_speed = 1e-14;
  solver.solve(bodies, contacts, std::vector<double>(4, 0.0));
  double sum = 0;
  for (const Contact& c : contacts) sum += c.normal_impulse;
  EXPECT_NEAR(sum, 2 * 9.81 / 240, 1e-12);
  EXPECT_NEAR(bodies[0].v.norm() + bodies[0].omega.norm(), 0, 1e-12);
}

TEST(SequentialImpulses, WarmStartFromTheSolutionChangesNothing) {
  std::vector<ContactBody> bodies = {body(2, {0, 0, 0.5}, {0.2, 0, -1}), fixed()};
  std::vector<Contact> contacts = four_corners(0, 1, 0, 0.5);
  SequentialImpulses solver;
  solver.sweeps = 500;
  solver.settled_speed = 1e-14;
  const std::vector<double> target(4, 0.0);
  solver.solve(bodies, contacts, target);
  const std::vector<Contact> solution = contacts;
  bodies[0] = body(2, {0, 0, 0.5}, {0.2, 0, -1});
  solver.solve(bodies, contacts, target);
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_NEAR(contacts[i].normal_impulse, solution[i].normal_impulse, 1e-10);
}

TEST(SequentialImpulses, NeverPullsAndStaysInTheCircularCone) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> u(-1, 1);
  const auto vec = [&] { return Vec3(u(random), u(random), u(random)); };
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<ContactBody> bodies;
    for (int i = 0; i < 4; ++i) {
      bodies.push_back(body(1 + 9 * std::abs(u(random)), vec(), 5 * vec()));
      bodies.back().omega = 5 * vec();
    }
    std::vector<Contact> contacts;
    for (int k = 0; k < 6; ++k) {
      Contact contact = touch(k % 4, (k + 1 + k / 4) % 4, vec(), std::abs(u(random)));
      contact.normal = vec().normalized();
      contacts.push_back(contact);
    }
    Vec3 momentum = Vec3::Zero(), moment = Vec3::Zero();
    const auto add = [&](double sign) {
      for (const ContactBody& b : bodies) {
        momentum += sign / b.inv_mass * b.v;
        moment += sign * (b.inv_J_W.inverse() * b.omega + b.c.cross(b.v) / b.inv_mass);
      }
    };
    add(1);
    SequentialImpulses solver;
    solver.solve(bodies, contacts, std::vector<double>(6, 0.0));
    add(-1);
    // Impulses come in opposite pairs along one line: P and L of the whole are kept.
    EXPECT_NEAR(momentum.norm(), 0, 1e-12);
    EXPECT_NEAR(moment.norm(), 0, 1e-12);
    for (const Contact& c : contacts) {
      EXPECT_GE(c.normal_impulse, 0);
      EXPECT_LE(c.friction_impulse.norm(), c.friction * c.normal_impulse * (1 + 1e-12) + 1e-14);
      EXPECT_NEAR(c.friction_impulse.dot(c.normal), 0, 1e-12 * (1 + c.normal_impulse));
    }
  }
}

TEST(SequentialImpulses, FrictionBrakesEquallyInAllDirections) {
  for (int k = 0; k < 24; ++k) {
    const double angle = 2 * 3.14159265358979 * k / 24;
    std::vector<ContactBody> bodies = {
        body(1, {0, 0, 0}, {5 * std::cos(angle), 5 * std::sin(angle), -1}), fixed()};
    bodies[0].inv_J_W.setZero();
    std::vector<Contact> contacts = {touch(0, 1, {0, 0, 0}, 0.3)};
    SequentialImpulses solver;
    solver.solve(bodies, contacts, std::vector<double>{0.0});
    EXPECT_NEAR(bodies[0].v.norm(), 5 - 0.3, 1e-14);
  }
}

TEST(SequentialImpulses, PushOutMovesApartWithoutTouchingTheImpulses) {
  std::vector<ContactBody> bodies = {body(1, {0, 0, 0.5}), body(1, {0, 0, -0.5})};
  std::vector<Contact> contacts = {touch(0, 1, {0, 0, 0}, 0.5)};
  contacts[0].normal_impulse = 3;
  SequentialImpulses solver;
  solver.push_out(bodies, contacts, std::vector<double>{0.2});
  EXPECT_NEAR(bodies[0].v.z(), 0.1, 1e-15);
  EXPECT_NEAR(bodies[1].v.z(), -0.1, 1e-15);
  EXPECT_EQ(contacts[0].normal_impulse, 3);
}

}  // namespace
}  // namespace poinsot
