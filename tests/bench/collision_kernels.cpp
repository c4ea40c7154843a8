// Nanoseconds per query of the collision kernels beside FCL's, in one run on the same poses: apart
// by 0.2 m, touching (0.1 mm deep) and deep (50 mm). The least mean of 25 passes over 128 random
// poses.
//
// FCL with libccd, transforms prepared, result reused: collide with contacts, distance unsigned at
// its default tolerance. Where FCL is wrong (most of its contacts of curved shapes and convex
// hulls, cone against half-space) its time is printed all the same. Usage: bench_collision_kernels
// [first shape] [second shape]

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <vector>

#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include "poinsot/collision/proximity.h"
#include "support/fcl_oracle.h"
#include "support/geometry.h"

namespace poinsot::test {
namespace {

constexpr double kMargin = 0.005;  // [m]

struct Placed {
  Collider a, b;
  Pose pose_a, pose_b;
};

// b is pushed along the normal of the nearest or deepest points until the gap is as wanted.
Placed placed_at(int kind_a, int kind_b, double gap, Random& random) {
  const Collider a = collider(random_shape(kind_a, random), 0);
  const Collider b = collider(random_shape(kind_b, random), 1);
  const Pose pose_a{random.in_box(1), random.rotation()};
  Pose pose_b = kind_b == kHalfSpace ? Pose{Vec3::Zero(), random.rotation()}
                                     : pose_at_gap(a.shape, pose_a, b.shape, gap, random);
  for (int i = 0; i < 4; ++i) {
    const Gap now = find_gap(a, pose_a, b, pose_b);
    pose_b.c -= (gap - now.value) * now.normal;
  }
  return {a, b, pose_a, pose_b};
}

template <class Case>
double nanoseconds(const std::vector<Case>& cases, const std::function<void(const Case&)>& f) {
  using Clock = std::chrono::steady_clock;
  double best = 1e300;
  for (int pass = 0; pass < 25; ++pass) {
    const auto start = Clock::now();
    for (const Case& c : cases) f(c);
    const std::chrono::duration<double, std::nano> took = Clock::now() - start;
    best = std::min(best, took.count() / static_cast<double>(cases.size()));
  }
  return best;
}

double ours(const std::vector<Placed>& cases) {
  Manifold manifold;
  return nanoseconds<Placed>(cases, [&](const Placed& p) {
    find_manifold(p.a, p.pose_a, p.b, p.pose_b, kMargin, manifold);
  });
}

double our_gap(const std::vector<Placed>& cases) {
  return nanoseconds<Placed>(cases,
                             [&](const Placed& p) { find_gap(p.a, p.pose_a, p.b, p.pose_b); });
}

// With the axis of the last query, the shape turned by 1e-3 rad since.
double our_gap_again(const std::vector<Placed>& cases) {
  struct Again {
    Placed placed;
    GapHint hint;
  };
  std::vector<Again> again;
  const Quat turn(Eigen::AngleAxisd(1e-3, Vec3(0.6, 0, 0.8)));
  for (const Placed& p : cases) {
    again.push_back({p, {}});
    find_gap(p.a, p.pose_a, p.b, {p.pose_b.c, turn * p.pose_b.q}, &again.back().hint);
  }
  return nanoseconds<Again>(again, [&](const Again& c) {
    GapHint hint = c.hint;
    find_gap(c.placed.a, c.placed.pose_a, c.placed.b, c.placed.pose_b, &hint);
  });
}

struct PlacedInFcl {
  std::shared_ptr<fcl::CollisionGeometryd> a, b;
  fcl::Transform3d X, Y;
};

std::vector<PlacedInFcl> in_fcl(const std::vector<Placed>& cases) {
  std::vector<PlacedInFcl> result;
  for (const Placed& p : cases)
    result.push_back({to_fcl(p.a.shape), to_fcl(p.b.shape), to_fcl(p.pose_a), to_fcl(p.pose_b)});
  return result;
}

double fcl_collide(const std::vector<PlacedInFcl>& cases) {
  fcl::CollisionRequestd request(Manifold::kMaxPoints, true);
  request.gjk_solver_type = fcl::GST_LIBCCD;
  fcl::CollisionResultd result;
  return nanoseconds<PlacedInFcl>(cases, [&](const PlacedInFcl& p) {
    result.clear();
    fcl::collide(p.a.get(), p.X, p.b.get(), p.Y, request, result);
  });
}

double fcl_distance(const std::vector<PlacedInFcl>& cases) {
  fcl::DistanceRequestd request(true, false);
  request.gjk_solver_type = fcl::GST_LIBCCD;
  fcl::DistanceResultd result;
  return nanoseconds<PlacedInFcl>(cases, [&](const PlacedInFcl& p) {
    result.clear();
    fcl::distance(p.a.get(), p.X, p.b.get(), p.Y, request, result);
  });
}

void measure(int kind_a, int kind_b) {
  std::printf("%-9s %-10s", name_of(kind_a).c_str(), name_of(kind_b).c_str());
  std::vector<std::vector<Placed>> regimes;
  for (const double gap : {0.2, -1e-4, -0.05}) {
    Random random(7);
    std::vector<Placed>& cases = regimes.emplace_back();
    for (int i = 0; i < 128; ++i) cases.push_back(placed_at(kind_a, kind_b, gap, random));
    std::printf("  %5.0f /%5.0f", ours(cases), fcl_collide(in_fcl(cases)));
  }
  Random random(8);
  std::vector<Placed> near;
  for (int i = 0; i < 128; ++i) near.push_back(placed_at(kind_a, kind_b, 1e-4, random));
  const bool has_distance = kind_b != kHalfSpace;  // FCL's crashes
  std::printf(" |");
  for (const std::vector<Placed>* cases : {&regimes[0], &near})
    std::printf("  %5.0f %5.0f /%5.0f", our_gap(*cases), our_gap_again(*cases),
                has_distance ? fcl_distance(in_fcl(*cases)) : 0.0);
  std::printf("  %5.0f\n", our_gap(regimes[2]));
  std::fflush(stdout);
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
    std::printf("  %5.0f /%5.0f", ours(cases), fcl_collide(in_fcl(cases)));
  }
  std::printf("\n");
}

}  // namespace
}  // namespace poinsot::test

int main(int argc, char** argv) {
  using namespace poinsot::test;
  std::printf(
      "ns, ours / FCL's\n%-20s  manifold: apart, touching, deep           | gap: apart, "
      "with hint / FCL, 0.1 mm, with hint / FCL, deep\n",
      "");
  for (int a = kSphere; a <= kConvex; ++a)
    for (int b = a; b <= kHalfSpace; ++b)
      if ((argc <= 1 || std::atoi(argv[1]) == a) && (argc <= 2 || std::atoi(argv[2]) == b))
        measure(a, b);
  if (argc > 1) return 0;
  std::printf("\nns per manifold of a face on a face, ours / FCL's: 0.1 mm apart, 0.1 mm deep\n");
  const poinsot::Box box{{1, 1, 1}};
  measure_stacked("box", box, box, 1);
  measure_stacked("cylinder", box, poinsot::Cylinder{0.5, 1}, 1);
  measure_stacked("prism", box, prism(12, 0.5, 1), 1);
  measure_stacked("cylinder", poinsot::Cylinder{0.5, 1}, poinsot::Cylinder{0.5, 1}, 1);
}
