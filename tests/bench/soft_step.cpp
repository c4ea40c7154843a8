// What a soft step costs: columns of boxes and a sheet of spheres whose contacts are given, so that
// nothing but the solver is measured. Prints nanoseconds per manifold and sub-step and per body and
// sub-step, on one thread and on two.

#include "poinsot/contact/soft_step.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <vector>

namespace {

using namespace poinsot;
using Clock = std::chrono::steady_clock;

struct Crowd {
  std::vector<SoftBody> bodies;
  std::vector<SoftManifold> manifolds;
};

SoftBody box(const Vec3& c, double inv_mass) {
  SoftBody body;
  body.c = c;
  body.q = Quat::Identity();
  body.v = body.L = body.omega = body.torque = body.acceleration = Vec3::Zero();
  body.inv_mass = inv_mass;
  body.inv_J_B = 6 * inv_mass * Mat3::Identity();
  body.turns_evenly = true;
  if (inv_mass > 0) body.acceleration.z() = -9.81;
  return body;
}

void touch(Crowd& crowd, int a, int b, const Vec3& arm_a, const Vec3& normal, int count) {
  SoftManifold manifold = {};
  manifold.a = a;
  manifold.b = b;
  manifold.count = count;
  manifold.normal = normal;
  manifold.friction = 0.6;
  manifold.size = 1;
  const Vec3 between =
      crowd.bodies[static_cast<std::size_t>(a)].c - crowd.bodies[static_cast<std::size_t>(b)].c;
  const double side = count > 1 ? 0.5 : 0;
  for (int i = 0; i < count; ++i) {
    manifold.points[i].arm_a =
        arm_a + Vec3(i == 1 || i == 2 ? side : -side, i > 1 ? side : -side, 0);
    manifold.points[i].arm_b = manifold.points[i].arm_a + between;
  }
  crowd.manifolds.push_back(manifold);
}

Crowd columns(int count, int height) {
  Crowd crowd;
  crowd.bodies.push_back(box(Vec3::Zero(), 0));
  for (int column = 0; column < count; ++column)
    for (int k = 0; k < height; ++k) {
      crowd.bodies.push_back(box(Vec3(2.0 * (column % 10), 2.0 * (column / 10), k + 0.5), 1e-3));
      const int own = static_cast<int>(crowd.bodies.size()) - 1;
      touch(crowd, own, k == 0 ? 0 : own - 1, Vec3(0, 0, -0.5), Vec3::UnitZ(), 4);
    }
  return crowd;
}

// Layers of spheres, each on the one below and beside the next two.
Crowd spheres(int side, int height) {
  Crowd crowd;
  crowd.bodies.push_back(box(Vec3::Zero(), 0));
  const auto index = [&](int x, int y, int z) { return 1 + x + side * (y + side * z); };
  for (int z = 0; z < height; ++z)
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) crowd.bodies.push_back(box(Vec3(x, y, z + 0.5), 1e-3));
  for (int z = 0; z < height; ++z)
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        const int own = index(x, y, z);
        touch(crowd, own, z == 0 ? 0 : index(x, y, z - 1), Vec3(0, 0, -0.5), Vec3::UnitZ(), 1);
        if (x > 0) touch(crowd, own, index(x - 1, y, z), Vec3(-0.5, 0, 0), Vec3::UnitX(), 1);
        if (y > 0) touch(crowd, own, index(x, y - 1, z), Vec3(0, -0.5, 0), Vec3::UnitY(), 1);
      }
  return crowd;
}

// Best of several [s].
double seconds(const Crowd& start, int steps, Team& team) {
  Crowd crowd = start;
  SoftStep solver;
  SoftSettings settings;
  settings.steps = steps;
  double best = 1e9;
  for (int round = 0; round < 60; ++round) {
    const auto begin = Clock::now();
    solver.advance(crowd.bodies, crowd.manifolds, {}, 1.0 / 60, settings, team);
    best = std::min(best, std::chrono::duration<double>(Clock::now() - begin).count());
    for (std::size_t k = 0; k < crowd.bodies.size(); ++k) crowd.bodies[k].c = start.bodies[k].c;
  }
  return best;
}

void report(const char* name, const Crowd& crowd) {
  const double manifolds = static_cast<double>(crowd.manifolds.size());
  for (const int threads : {1, 2}) {
    Team team(threads);
    // What each further sub-step costs, and what a step costs beside.
    const double four = seconds(crowd, 4, team), twelve = seconds(crowd, 12, team);
    const double each = (twelve - four) / 8;
    std::printf(
        "%-22s %5zu bodies %6.0f manifolds %d thread(s): step of 4 %7.1f us, sub-step %6.1f "
        "ns and set-up %6.1f ns per manifold\n",
        name, crowd.bodies.size(), manifolds, threads, four * 1e6, each / manifolds * 1e9,
        (four - 4 * each) / manifolds * 1e9);
  }
}

Crowd without_contacts(Crowd crowd) {
  crowd.manifolds.resize(1);
  return crowd;
}

}  // namespace

int main() {
  report("columns 1 x 10", columns(1, 10));
  report("columns 10 x 10", columns(10, 10));
  report("columns 100 x 10", columns(100, 10));
  report("columns 1000 x 10", columns(1000, 10));
  report("spheres 14 x 14 x 10", spheres(14, 10));
  const Crowd free = without_contacts(columns(100, 10));
  Team team(1);
  const double each = (seconds(free, 12, team) - seconds(free, 4, team)) / 8;
  std::printf("free bodies: %.1f ns per body and sub-step\n", each / 1000 * 1e9);
}
