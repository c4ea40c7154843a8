// How good find_gap is: for every pair of shapes and a ladder of gaps, the largest and the typical
// difference of its bounds, relative to the smaller bounding radius, over many random poses.
//
// The bounds are taken from the shapes' own closed forms, not from what find_gap says: the points
// are on the shapes, and as far apart as `value`; the slab along the normal is `lower` wide.
// Usage: bench_gap_accuracy [poses per pair] [size in m] [first shape] [second shape]

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "poinsot/collision/proximity.h"
#include "support/geometry.h"

namespace poinsot::test {
namespace {

struct Regime {
  const char* name;
  double low, high;  // gap over the smaller bounding radius; negative: depth
};
constexpr Regime kRegimes[] = {{"1e-9..1e-6", 1e-9, 1e-6},
                               {"1e-6..1e-3", 1e-6, 1e-3},
                               {"1e-3..2", 1e-3, 2},
                               {"-1e-3..-1e-9", -1e-9, -1e-3},
                               {"-0.3..-1e-3", -1e-3, -0.3}};

// The worst over the poses of a regime, relative to the smaller bounding radius.
struct Worst {
  double bounds = 0, outside = 0, slab = 0;
  int coarse = 0;  // poses whose bounds differ by more than 1e-11
};

Gap moved_to(const Collider& a, const Pose& pose_a, const Collider& b, Pose& pose_b,
             double wanted) {
  Gap gap = find_gap(a, pose_a, b, pose_b);
  for (int i = 0; i < 4; ++i) {
    pose_b.c -= (wanted - gap.value) * gap.normal;
    gap = find_gap(a, pose_a, b, pose_b);
    if (std::abs(gap.value - wanted) < 0.1 * std::abs(wanted)) break;
  }
  return gap;
}

void measure(int kind_a, int kind_b, int poses, double size) {
  std::printf("%-10s %-10s", name_of(kind_a).c_str(), name_of(kind_b).c_str());
  Random random(1000 + static_cast<std::uint64_t>(10 * kind_a + kind_b));
  for (const Regime& regime : kRegimes) {
    Worst worst;
    for (int i = 0; i < poses; ++i) {
      const Collider a = collider(random_shape(kind_a, random, size), 0),
                     b = collider(random_shape(kind_b, random, size), 1);
      const double small = std::min(a.bounding_radius, b.bounding_radius);
      const Pose pose_a{random.in_box(size), random.rotation()};
      const double reach = kind_b == kHalfSpace ? size : a.bounding_radius + b.bounding_radius;
      Pose pose_b{pose_a.c + random.uniform(0.3, 1) * reach * random.direction(),
                  random.rotation()};
      const double wanted =
          small * (regime.low > 0 ? random.log_uniform(regime.low, regime.high)
                                  : -random.log_uniform(-regime.low, -regime.high));
      const Gap gap = moved_to(a, pose_a, b, pose_b, wanted);
      const double slab = separation(a.shape, pose_a, b.shape, pose_b, gap.normal);
      const double outside =
          std::max({outside_by(a.shape, pose_a.inverse() * gap.point_a),
                    outside_by(b.shape, pose_b.inverse() * gap.point_b),
                    gap.value > 0 ? std::abs((gap.point_a - gap.point_b).norm() - gap.value) : 0});
      worst.bounds = std::max(worst.bounds, (gap.value - gap.lower) / small);
      worst.slab = std::max(worst.slab, (gap.lower - slab) / small);
      worst.outside = std::max(worst.outside, outside / small);
      worst.coarse += gap.value - gap.lower > 1e-11 * small;
    }
    std::printf("  %7.1e %7.1e %7.1e %6d", worst.bounds, worst.slab, worst.outside, worst.coarse);
  }
  std::printf("\n");
  std::fflush(stdout);
}

}  // namespace
}  // namespace poinsot::test

int main(int argc, char** argv) {
  using namespace poinsot::test;
  const int poses = argc > 1 ? std::atoi(argv[1]) : 1000;
  const double size = argc > 2 ? std::atof(argv[2]) : 1;
  std::printf("bounds slab outside count, per regime\n");
  for (int a = kSphere; a <= kConvex; ++a)
    for (int b = a; b <= kHalfSpace; ++b)
      if ((argc <= 3 || std::atoi(argv[3]) == a) && (argc <= 4 || std::atoi(argv[4]) == b))
        measure(a, b, poses, size);
}
