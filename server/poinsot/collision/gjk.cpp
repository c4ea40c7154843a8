#include "poinsot/collision/gjk.h"

#include <cmath>

#include "poinsot/collision/polish.h"

namespace poinsot {
namespace {

// The corners of a simplex that carry its point nearest the origin, in ascending order.
struct Nearest {
  std::array<std::size_t, 3> corner{};
  std::array<double, 3> weight{};
  std::size_t count = 0;

  static Nearest at_corner(std::size_t i) { return {{i}, {1.0}, 1}; }
  static Nearest on_edge(std::size_t i, std::size_t j, double t) { return {{i, j}, {1 - t, t}, 2}; }
};

struct Simplex {
  std::array<DifferencePoint, 4> p;
  std::array<double, 4> weight{};
  std::size_t size = 0;

  const Vec3& w(std::size_t i) const { return p[i].w; }

  // The point nearest the origin. Its direction has to be good to rounding even where the point is
  // close or the simplex is a needle: what is left of the weights' rounding along the longest edge
  // is taken out, and across a fair triangle its plane knows better than the blend.
  Vec3 nearest_to_origin() {
    if (size == 1) return w(0);
    std::size_t from = 0, to = 1;
    double longest2 = 0;
    for (std::size_t i = 0; i < size; ++i) {
      const std::size_t j = i + 1 == size ? 0 : i + 1;
      const double length2 = (w(j) - w(i)).squaredNorm();
      if (length2 <= longest2) continue;
      longest2 = length2;
      from = i;
      to = j;
    }
    const Vec3 edge = w(to) - w(from);
    Vec3 v = weight[0] * w(0) + weight[1] * w(1);
    if (size == 3) v += weight[2] * w(2);
    const double along = v.dot(edge) / longest2;
    weight[from] += along;
    weight[to] -= along;
    v -= along * edge;
    if (size == 2) return v;
    const Vec3 n = (w(1) - w(0)).cross(w(2) - w(0));
    const bool plane_is_better = n.squaredNorm() > longest2 * v.squaredNorm();
    return plane_is_better ? Vec3((n.dot(w(0)) / n.squaredNorm()) * n) : v;
  }
  Blend blend() const {
    Blend result;
    result.size = std::min<std::size_t>(size, 3);
    for (std::size_t i = 0; i < result.size; ++i) {
      result.points[i] = p[i];
      result.weights[i] = weight[i];
    }
    return result;
  }
  void keep(const Nearest& nearest) {
    for (std::size_t k = 0; k < nearest.count; ++k) {
      p[k] = p[nearest.corner[k]];
      weight[k] = nearest.weight[k];
    }
    size = nearest.count;
  }
  bool holds(const Vec3& point) const {
    for (std::size_t i = 0; i < size; ++i)
      if (p[i].w == point) return true;
    return false;
  }
};

Vec3 point_of(const Simplex& s, const Nearest& nearest) {
  Vec3 v = nearest.weight[0] * s.w(nearest.corner[0]);
  for (std::size_t k = 1; k < nearest.count; ++k) v += nearest.weight[k] * s.w(nearest.corner[k]);
  return v;
}

Nearest nearest_on_segment(const Simplex& s, std::size_t i, std::size_t j) {
  const Vec3 ab = s.w(j) - s.w(i);
  const double along = -s.w(i).dot(ab), length2 = ab.squaredNorm();
  if (along <= 0) return Nearest::at_corner(i);
  if (along >= length2) return Nearest::at_corner(j);
  return Nearest::on_edge(i, j, along / length2);
}

// For triangles so thin that rounding leaves no inside.
Nearest nearest_on_rim(const Simplex& s, std::size_t i, std::size_t j, std::size_t k) {
  Nearest best;
  double least = std::numeric_limits<double>::infinity();
  for (const Nearest& edge :
       {nearest_on_segment(s, i, j), nearest_on_segment(s, i, k), nearest_on_segment(s, j, k)}) {
    const double d2 = point_of(s, edge).squaredNorm();
    if (d2 >= least) continue;
    least = d2;
    best = edge;
  }
  return best;
}

Nearest nearest_on_triangle(const Simplex& s, std::size_t i, std::size_t j, std::size_t k) {
  const Vec3 &a = s.w(i), &b = s.w(j), &c = s.w(k);
  const Vec3 ab = b - a, ac = c - a;
  const double d1 = -ab.dot(a), d2 = -ac.dot(a);
  if (d1 <= 0 && d2 <= 0) return Nearest::at_corner(i);
  const double d3 = -ab.dot(b), d4 = -ac.dot(b);
  if (d3 >= 0 && d4 <= d3) return Nearest::at_corner(j);
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return Nearest::on_edge(i, j, d1 / (d1 - d3));
  const double d5 = -ab.dot(c), d6 = -ac.dot(c);
  if (d6 >= 0 && d5 <= d6) return Nearest::at_corner(k);
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return Nearest::on_edge(i, k, d2 / (d2 - d6));
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0)
    return Nearest::on_edge(j, k, (d4 - d3) / ((d4 - d3) + (d5 - d6)));
  if (!(va > 0 && vb > 0 && vc > 0)) return nearest_on_rim(s, i, j, k);
  const double sum = va + vb + vc;
  return {{i, j, k}, {va / sum, vb / sum, vc / sum}, 3};
}

// Whether the origin and corner `apex` lie on the same side of a face; a tetrahedron flat to within
// `flat` [m] has no inside.
bool same_side(const Simplex& s, std::size_t i, std::size_t j, std::size_t k, std::size_t apex,
               double flat) {
  const Vec3& a = s.w(i);
  const Vec3 n = (s.w(j) - a).cross(s.w(k) - a);
  const double origin = -a.dot(n), inner = (s.w(apex) - a).dot(n);
  return inner * inner > flat * flat * n.squaredNorm() && (origin > 0) == (inner > 0);
}

// True if the origin is inside; otherwise reduces to the nearest face, edge or corner.
bool reduce_tetrahedron(Simplex& s, double flat) {
  // The newest corner lies beyond the face of the other three, as the origin does.
  constexpr std::size_t kFaces[3][4] = {{0, 1, 3, 2}, {0, 2, 3, 1}, {1, 2, 3, 0}};
  double least = std::numeric_limits<double>::infinity();
  Nearest best;
  for (const auto& f : kFaces) {
    if (same_side(s, f[0], f[1], f[2], f[3], flat)) continue;
    const Nearest nearest = nearest_on_triangle(s, f[0], f[1], f[2]);
    const double d2 = point_of(s, nearest).squaredNorm();
    if (d2 >= least) continue;
    least = d2;
    best = nearest;
  }
  if (best.count == 0) return true;
  s.keep(best);
  return false;
}

bool reduce(Simplex& s, double flat) {
  if (s.size == 1) s.weight[0] = 1;
  if (s.size == 2) s.keep(nearest_on_segment(s, 0, 1));
  if (s.size == 3) s.keep(nearest_on_triangle(s, 0, 1, 2));
  return s.size == 4 && reduce_tetrahedron(s, flat);
}

}  // namespace

DifferencePoint difference_support(const ConvexPair& pair, const Vec3& d) {
  const Vec3 on_a = pair.support_a(d);
  return {on_a - pair.support_b(-d), on_a};
}

namespace {

// True if Newton's method proves the cores apart, with bounds that meet.
bool improve(const ConvexPair& pair, const Vec3& normal, const Simplex& s, double gap,
             GjkResult& result) {
  result.near_stationary = polish(pair, normal, s.blend(), gap);
  const Polished& p = result.near_stationary;
  if (!p.settled || p.lower <= 0) return false;
  result.separated = true;
  result.distance = p.upper;
  result.lower = p.lower;
  result.normal = p.normal;
  result.on_a = p.on_a;
  result.on_b = p.on_b;
  result.size = 0;
  return true;
}

}  // namespace

GjkResult gjk(const ConvexPair& pair, double enough, const Vec3* first) {
  GjkResult result;
  Simplex s, before;
  const double touch = pair.at_least_rounding(kGjkTouch * pair.small);
  const double gap = pair.at_least_rounding(kGjkGap * pair.small);
  Vec3 v = first ? *first : Vec3(-pair.c);
  if (!(v.squaredNorm() > 0)) v = Vec3::UnitX();
  double length = v.norm();
  double polish_at = pair.is_curved() ? kPolishFrom * pair.small : 0;
  bool touching = false;

  for (; result.iterations < kGjkIterations; ++result.iterations) {
    const DifferencePoint next = difference_support(pair, -v);
    const double lower = v.dot(next.w) / length;
    if (lower > result.lower) {
      result.lower = lower;
      result.normal = v / length;
    }
    if (s.size > 0 && (length - result.lower <= gap || result.lower > enough || s.holds(next.w)))
      break;
    if (s.size > 0 && length - lower <= polish_at) {
      if (improve(pair, v / length, s, gap, result)) return result;
      polish_at = result.near_stationary.settled ? 0 : 0.1 * (length - lower);
    }
    before = s;
    s.p[s.size++] = next;
    const bool inside = reduce(s, pair.rounding());
    const Vec3 v_before = v;
    const double length_before = length;
    if (!inside) {
      v = s.nearest_to_origin();
      length = v.norm();
    }
    // No nearer, or inside against the lower bound: as far as rounding lets it come.
    const bool stalled = before.size > 0 && !inside && length >= length_before;
    if (stalled || (inside && result.lower > touch)) {
      s = before;
      v = v_before;
      length = length_before;
      break;
    }
    touching = inside || length <= touch;
    if (touching) break;
  }
  // Polytopes end exactly, so for them touching is certain.
  const bool unproven = touching
                            ? pair.is_curved() && before.size > 0 && !result.near_stationary.settled
                            : length - result.lower > gap && result.lower <= enough;
  if (unproven && length > 0 && improve(pair, v / length, s.size == 4 ? before : s, gap, result))
    return result;
  // Not proven apart, or so close that needles of simplices cannot measure it: the penetration
  // search, whose depth has a sign, knows better.
  const double unsure = length - result.lower;
  touching |=
      result.lower <= 0 || (length < kGjkNear * pair.small && unsure > kGjkSure * pair.small);

  result.simplex = s.p;
  result.size = static_cast<int>(s.size);
  if (s.size < 4) {
    const Blend blend = s.blend();
    result.on_a = blend.on_a();
    result.on_b = blend.on_b();
  }
  result.separated = !touching;
  result.distance = length;
  return result;
}

}  // namespace poinsot
