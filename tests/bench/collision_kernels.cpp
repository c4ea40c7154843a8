// Nanoseconds per query of the collision kernels, for pairs 0.1 mm apart, 0.1 mm deep and 50 mm
// deep: the least mean of 25 passes over 128 random poses.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <vector>

#include "poinsot/collision/epa.h"
#include "poinsot/collision/proximity.h"
#include "support/geometry.h"

namespace poinsot::test {
namespace {

struct Placed {
  Collider a, b;
  Pose pose_a, pose_b;
};

// b is pushed along the normal of the nearest or deepest points until the gap is as wanted.
Placed placed_at(int kind_a, int kind_b, double gap, Random& random) {
  const Collider a = collider(random_shape(kind_a, random), 0);
  const Collider b = collider(random_shape(kind_b, random), 1);
  const Pose pose_a{random.in_box(1), random.rotation()};
  Pose pose_b = pose_at_gap(a.shape, pose_a, b.shape, gap, random);
  for (int i = 0; i < 4; ++i) {
    const double now = find_gap(a, pose_a, b, pose_b).value;
    Manifold manifold;
    find_manifold(a, pose_a, b, pose_b, now + 1, manifold);
    pose_b.c -= (gap - now) * manifold.normal;
  }
  return {a, b, pose_a, pose_b};
}

double nanoseconds(const std::vector<Placed>& cases, const std::function<void(const Placed&)>& f) {
  using Clock = std::chrono::steady_clock;
  double best = 1e300;
  for (int pass = 0; pass < 25; ++pass) {
    const auto start = Clock::now();
    for (const Placed& p : cases) f(p);
    const std::chrono::duration<double, std::nano> took = Clock::now() - start;
    best = std::min(best, took.count() / static_cast<double>(cases.size()));
  }
  return best;
}

void measure(int kind_a, int kind_b) {
  std::printf("%-10s %-10s", name_of(kind_a).c_str(), name_of(kind_b).c_str());
  for (const double gap : {1e-4, -1e-4, -0.05}) {
    Random random(7);
    std::vector<Placed> cases;
    for (int i = 0; i < 128; ++i) cases.push_back(placed_at(kind_a, kind_b, gap, random));
    Manifold manifold;
    std::printf("  %6.0f", nanoseconds(cases, [&](const Placed& p) {
                  find_manifold(p.a, p.pose_a, p.b, p.pose_b, 0.005, manifold);
                }));
    double iterations = 0;
    if (kind_b != kHalfSpace)
      for (const Placed& p : cases)
        iterations += gjk({p.a, p.pose_a, p.b, p.pose_b}).iterations / 128.0;
    std::printf(" (%4.1f)", iterations);
  }
  std::printf("\n");
}

// Faces on faces, as in a pile that has settled.
void measure_stacked(const char* name, const Shape& base, const Shape& top, double height) {
  std::printf("%-10s on %-10s", name, std::string(shape_name(base)).c_str());
  for (const double gap : {1e-4, -1e-4}) {
    Random random(8);
    std::vector<Placed> cases;
    for (int i = 0; i < 128; ++i) {
      const Pose world{random.in_box(5), random.rotation()};
      const Quat turn(Eigen::AngleAxisd(random.uniform(0, 3), Vec3::UnitZ()));
      const Quat tilt(Eigen::AngleAxisd(1e-6, random.direction()));
      const Vec3 at(random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), height + gap);
      cases.push_back({collider(base, 0), collider(top, 1), world, world * Pose{at, tilt * turn}});
    }
    Manifold manifold;
    std::printf("  %6.0f", nanoseconds(cases, [&](const Placed& p) {
                  find_manifold(p.a, p.pose_a, p.b, p.pose_b, 0.02, manifold);
                }));
  }
  std::printf("\n");
}

}  // namespace
}  // namespace poinsot::test

int main() {
  using namespace poinsot::test;
  std::printf("ns per manifold (GJK iterations)  0.1 mm apart, 0.1 mm deep, 50 mm deep\n");
  for (int a = kSphere; a <= kConvex; ++a)
    for (int b = a; b <= kHalfSpace; ++b) measure(a, b);
  std::printf("\nns per manifold of a face on a face  0.1 mm apart, 0.1 mm deep\n");
  const poinsot::Box box{{1, 1, 1}};
  measure_stacked("box", box, box, 1);
  measure_stacked("cylinder", box, poinsot::Cylinder{0.5, 1}, 1);
  measure_stacked("prism", box, prism(12, 0.5, 1), 1);
  measure_stacked("cylinder", poinsot::Cylinder{0.5, 1}, poinsot::Cylinder{0.5, 1}, 1);
}
