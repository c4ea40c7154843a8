#include "poinsot/collision/axis_bound.h"

#include <algorithm>
#include <cmath>

namespace poinsot {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// How near the end of the proven time is sought, of the height of L now.
constexpr double kClose = 0.05;
constexpr int kFacets = 12;

// Features within this of being extreme along the axis count for its rate [rad].
constexpr double kTilt = 1e-11;

}  // namespace

double first_root(double z, double v, double c) {
  if (z <= 0 && (v < 0 || (v == 0 && c < 0))) return 0;
  const double square = v * v - 2 * c * z;
  if (square < 0 || (c >= 0 && v >= 0)) return kInfinity;
  const double root = std::sqrt(square);
  return v <= 0 ? 2 * z / (root - v) : -(v + root) / c;
}

Vec3 TurningCore::support_at(double x) const {
  return offset + R * support(*collider, R.transpose() * direction(x));
}

AxisBound::Facet AxisBound::facet_at(double x) const {
  Facet facet{z, v};
  for (const TurningCore* core : {&a, &b}) {
    if (!core->collider) continue;
    const Vec3 p = core->support_at(x);
    facet.z -= p.dot(core->d);
    facet.v -= p.dot(core->d_rate);
  }
  return facet;
}

double AxisBound::at(double x) const {
  const Facet facet = facet_at(x);
  return facet.z + x * (facet.v + 0.5 * c * x);
}

double AxisBound::slope() const {
  const double rate = a.d_rate.norm() + b.d_rate.norm();
  return rate > 0 ? facet_at(kTilt / rate).v : facet_at(0).v;
}

double AxisBound::clear_until(double most) const {
  const double held = central_z > 0 ? first_root(central_z, v, central_c) : 0;
  if (held >= most) return most;
  return std::max(held, above_until(0, most));
}

double AxisBound::above_until(double floor, double most) const {
  Facet facet = facet_at(0);
  const double now = facet.z - floor;
  double x = std::min(first_root(std::max(now, 0.0), facet.v, c), most);
  if (!turns()) return x;
  // Roots of facets come down to that of L from above, in finitely many turns for polyhedra.
  for (int turn = 0; turn < kFacets && x > 0; ++turn) {
    facet = facet_at(x);
    const double height = facet.z - floor + x * (facet.v + 0.5 * c * x);
    if (height >= 0) return x;
    // A chord of a concave function is below it.
    if (-height <= kClose * now || turn + 1 == kFacets) return x * now / (now - height);
    x = std::min(x, first_root(std::max(facet.z - floor, 0.0), facet.v, c));
  }
  return 0;
}

double AxisBound::leaves(double gap, double most) const {
  const Facet facet = facet_at(0);
  double x = c < 0 ? std::min(most, facet.v / -c) : most;
  while (facet.z + x * facet.v > gap) {
    if (at(x) > gap) return x;
    x *= 0.5;
  }
  return 0;
}

}  // namespace poinsot
