#include "poinsot/collision/gjk.h"

#include <algorithm>
#include <cmath>

namespace poinsot {
namespace {

// A simplex of the difference and the barycentric weights of its point nearest the origin.
struct Simplex {
  std::array<DifferencePoint, 4> p;
  std::array<double, 4> weight{};
  int size = 0;

  Vec3 w(int i) const { return p[static_cast<std::size_t>(i)].w; }

  template <class Member>
  Vec3 blend(Member member) const {
    Vec3 sum = Vec3::Zero();
    for (int i = 0; i < size; ++i)
      sum += weight[static_cast<std::size_t>(i)] * p[static_cast<std::size_t>(i)].*member;
    return sum;
  }

  // Keeps the named points with the given weights.
  void keep(std::initializer_list<std::pair<int, double>> kept) {
    const auto old = p;
    size = 0;
    for (const auto& [i, weight_i] : kept) {
      p[static_cast<std::size_t>(size)] = old[static_cast<std::size_t>(i)];
      weight[static_cast<std::size_t>(size)] = weight_i;
      ++size;
    }
  }
};

using Kept = std::array<std::pair<int, double>, 3>;

// Nearest point to the origin on triangle (i, j, k): which corners carry it, how many.
int nearest_on_triangle(const Simplex& s, int i, int j, int k, Kept& kept) {
  const Vec3 a = s.w(i), b = s.w(j), c = s.w(k);
  const Vec3 ab = b - a, ac = c - a;
  const double d1 = -ab.dot(a), d2 = -ac.dot(a);
  if (d1 <= 0 && d2 <= 0) return kept[0] = {i, 1.0}, 1;
  const double d3 = -ab.dot(b), d4 = -ac.dot(b);
  if (d3 >= 0 && d4 <= d3) return kept[0] = {j, 1.0}, 1;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) {
    const double t = d1 / (d1 - d3);
    return kept[0] = {i, 1 - t}, kept[1] = {j, t}, 2;
  }
  const double d5 = -ab.dot(c), d6 = -ac.dot(c);
  if (d6 >= 0 && d5 <= d6) return kept[0] = {k, 1.0}, 1;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) {
    const double t = d2 / (d2 - d6);
    return kept[0] = {i, 1 - t}, kept[1] = {k, t}, 2;
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return kept[0] = {j, 1 - t}, kept[1] = {k, t}, 2;
  }
  const double sum = va + vb + vc;
  return kept[0] = {i, va / sum}, kept[1] = {j, vb / sum}, kept[2] = {k, vc / sum}, 3;
}

void reduce_segment(Simplex& s) {
  const Vec3 a = s.w(0), ab = s.w(1) - a;
  const double length2 = ab.squaredNorm();
  const double t = length2 > 0 ? -a.dot(ab) / length2 : 0;
  if (t <= 0) return s.keep({{0, 1.0}});
  if (t >= 1) return s.keep({{1, 1.0}});
  s.keep({{0, 1 - t}, {1, t}});
}

void keep(Simplex& s, const Kept& kept, int count) {
  if (count == 1) return s.keep({kept[0]});
  if (count == 2) return s.keep({kept[0], kept[1]});
  s.keep({kept[0], kept[1], kept[2]});
}

void reduce_triangle(Simplex& s) {
  Kept kept;
  const int count = nearest_on_triangle(s, 0, 1, 2, kept);
  keep(s, kept, count);
}

// True if the origin is inside; otherwise reduces to the nearest face, edge or corner.
bool reduce_tetrahedron(Simplex& s) {
  constexpr int kFaces[4][4] = {{0, 1, 2, 3}, {0, 3, 1, 2}, {0, 2, 3, 1}, {1, 3, 2, 0}};
  double best = std::numeric_limits<double>::infinity();
  Kept best_kept;
  int best_count = 0;
  bool outside = false;
  for (const auto& f : kFaces) {
    const Vec3 a = s.w(f[0]);
    const Vec3 n = (s.w(f[1]) - a).cross(s.w(f[2]) - a);
    const double origin_side = -a.dot(n), inner_side = (s.w(f[3]) - a).dot(n);
    // A flat tetrahedron has no inner side: all its faces are candidates.
    if (inner_side != 0 && (origin_side > 0) == (inner_side > 0) && origin_side != 0) continue;
    outside = true;
    Kept kept;
    const int count = nearest_on_triangle(s, f[0], f[1], f[2], kept);
    Vec3 v = Vec3::Zero();
    for (int i = 0; i < count; ++i)
      v += kept[static_cast<std::size_t>(i)].second * s.w(kept[static_cast<std::size_t>(i)].first);
    if (v.squaredNorm() < best) {
      best = v.squaredNorm();
      best_kept = kept;
      best_count = count;
    }
  }
  if (!outside) return true;
  keep(s, best_kept, best_count);
  return false;
}

bool reduce(Simplex& s) {
  if (s.size == 1) s.weight[0] = 1;
  if (s.size == 2) reduce_segment(s);
  if (s.size == 3) reduce_triangle(s);
  return s.size == 4 && reduce_tetrahedron(s);
}

bool holds(const Simplex& s, const Vec3& w) {
  for (int i = 0; i < s.size; ++i)
    if (s.w(i) == w) return true;
  return false;
}

}  // namespace

DifferencePoint difference_support(const ConvexPair& pair, const Vec3& d) {
  const Vec3 on_a = pair.support_a(d);
  const Vec3 on_b = pair.support_b(-d);
  return {on_a - on_b, on_a, on_b};
}

GjkResult gjk(const ConvexPair& pair) {
  GjkResult result;
  Simplex s;
  const double touch = kGjkTouch * pair.scale, gap = kGjkGap * pair.scale;
  Vec3 v = pair.c.squaredNorm() > 0 ? Vec3(-pair.c) : Vec3(Vec3::UnitX());
  double distance = std::numeric_limits<double>::infinity();
  bool inside = false;

  for (result.iterations = 0; result.iterations < kGjkIterations; ++result.iterations) {
    const DifferencePoint next = difference_support(pair, -v);
    if (s.size > 0) {
      distance = v.norm();
      result.lower = std::max(result.lower, v.dot(next.w) / distance);
      if (distance - result.lower <= gap || holds(s, next.w)) break;
    }
    const Simplex before = s;
    const Vec3 v_before = v;
    s.p[static_cast<std::size_t>(s.size++)] = next;
    inside = reduce(s);
    if (inside) break;
    v = s.blend(&DifferencePoint::w);
    if (v.norm() <= touch) {
      inside = true;
      break;
    }
    if (before.size > 0 && v.squaredNorm() >= v_before.squaredNorm()) {  // rounding floor
      s = before;
      v = v_before;
      break;
    }
  }

  result.simplex = s.p;
  result.size = s.size;
  if (inside) return result;
  result.separated = true;
  result.distance = v.norm();
  result.normal = v / result.distance;
  result.on_a = s.blend(&DifferencePoint::on_a);
  result.on_b = s.blend(&DifferencePoint::on_b);
  return result;
}

}  // namespace poinsot
