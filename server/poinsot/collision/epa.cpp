#include "poinsot/collision/epa.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace poinsot {
namespace {

constexpr int kEpaPoints = kEpaFaces / 2 + 4;

struct Face {
  std::array<int, 3> corner;  // counter-clockwise seen from outside
  Vec3 normal;                // unit, outward
  double distance;            // [m] of its plane from the origin
  bool alive;
};

// A convex polytope about the origin, grown point by point. Fixed capacity: no allocation.
class Polytope {
 public:
  explicit Polytope(double rounding) : rounding_(rounding) {}

  // False when the four points are flat.
  bool start(const std::array<DifferencePoint, 4>& p) {
    for (const DifferencePoint& x : p) points_[static_cast<std::size_t>(point_count_++)] = x;
    const double volume = (w(1) - w(0)).cross(w(2) - w(0)).dot(w(3) - w(0));
    const bool flip = volume > 0;
    const auto face = [&](int i, int j, int k) { return flip ? add(i, k, j) : add(i, j, k); };
    return face(0, 1, 2) && face(0, 3, 1) && face(0, 2, 3) && face(1, 3, 2);
  }

  const Face& nearest() const {
    const Face* best = nullptr;
    for (int f = 0; f < face_count_; ++f) {
      const Face& face = faces_[static_cast<std::size_t>(f)];
      if (face.alive && (!best || face.distance < best->distance)) best = &face;
    }
    return *best;
  }

  // Adds a point outside: faces that see it are replaced by a fan over their horizon. False when
  // out of room or when rounding leaves no proper horizon; the polytope is then used up.
  bool grow(const DifferencePoint& p) {
    if (point_count_ == kEpaPoints) return false;
    points_[static_cast<std::size_t>(point_count_)] = p;
    horizon_count_ = 0;
    for (int f = 0; f < face_count_; ++f) {
      Face& face = faces_[static_cast<std::size_t>(f)];
      if (!face.alive || face.normal.dot(p.w) - face.distance <= rounding_) continue;
      face.alive = false;
      for (std::size_t e = 0; e < 3; ++e)
        if (!toggle(face.corner[e], face.corner[(e + 1) % 3])) return false;
    }
    if (!horizon_is_a_loop()) return false;
    for (int e = 0; e < horizon_count_; ++e) {
      const auto [from, to] = horizon_[static_cast<std::size_t>(e)];
      if (!add(from, to, point_count_)) return false;
    }
    ++point_count_;
    return true;
  }

  const DifferencePoint& point(int i) const { return points_[static_cast<std::size_t>(i)]; }

 private:
  const Vec3& w(int i) const { return point(i).w; }

  bool add(int i, int j, int k) {
    const Vec3 n = (w(j) - w(i)).cross(w(k) - w(i));
    const double length = n.norm();
    if (length <= rounding_ * rounding_) return false;
    const Vec3 normal = n / length;
    int slot = 0;
    while (slot < face_count_ && faces_[static_cast<std::size_t>(slot)].alive) ++slot;
    if (slot == kEpaFaces) return false;
    face_count_ = std::max(face_count_, slot + 1);
    faces_[static_cast<std::size_t>(slot)] = {{i, j, k}, normal, normal.dot(w(i)), true};
    return true;
  }

  // An edge seen from both sides is inside the visible region, not on its horizon.
  bool toggle(int from, int to) {
    for (int e = 0; e < horizon_count_; ++e) {
      auto& edge = horizon_[static_cast<std::size_t>(e)];
      if (edge.first == to && edge.second == from) {
        edge = horizon_[static_cast<std::size_t>(--horizon_count_)];
        return true;
      }
    }
    if (horizon_count_ == kEpaFaces) return false;
    horizon_[static_cast<std::size_t>(horizon_count_++)] = {from, to};
    return true;
  }

  // Sorts the horizon head to tail; false if it is not one closed loop.
  bool horizon_is_a_loop() {
    if (horizon_count_ < 3) return false;
    for (int e = 1; e < horizon_count_; ++e) {
      const int head = horizon_[static_cast<std::size_t>(e - 1)].second;
      int next = e;
      while (next < horizon_count_ && horizon_[static_cast<std::size_t>(next)].first != head)
        ++next;
      if (next == horizon_count_) return false;
      std::swap(horizon_[static_cast<std::size_t>(e)], horizon_[static_cast<std::size_t>(next)]);
    }
    return horizon_[static_cast<std::size_t>(horizon_count_ - 1)].second == horizon_[0].first;
  }

  double rounding_;
  std::array<DifferencePoint, static_cast<std::size_t>(kEpaPoints)> points_;
  std::array<Face, static_cast<std::size_t>(kEpaFaces)> faces_;
  std::array<std::pair<int, int>, static_cast<std::size_t>(kEpaFaces)> horizon_;
  int point_count_ = 0, face_count_ = 0, horizon_count_ = 0;
};

Vec3 across(const Vec3& along) {  // some unit vector perpendicular to a unit vector
  Eigen::Index least = 0;
  along.cwiseAbs().minCoeff(&least);
  return along.cross(Vec3::Unit(least)).normalized();
}

// The start: the simplex of gjk, filled up to four points that span a volume.
struct Start {
  std::array<DifferencePoint, 4> p;
  std::size_t size;
  Vec3 flat_normal;  // when A − B spans no volume: unit, across it

  // False when A − B is thinner than `flat` [m] in some direction.
  bool fill(const ConvexPair& pair, double flat) {
    if (size == 1) fill_point(pair, flat);
    if (size == 2) fill_line(pair, flat);
    if (size == 3) fill_plane(pair, flat);
    return size == 4;
  }

 private:
  // Adds the support point, along one of the directions, that is farthest off; if any is.
  void farthest(const ConvexPair& pair, auto&& off, double flat, std::span<const Vec3> directions) {
    double best = flat;
    for (const Vec3& d : directions) {
      for (const double sign : {1.0, -1.0}) {
        const DifferencePoint candidate = difference_support(pair, sign * d);
        const double distance = off(candidate.w - p[0].w);
        if (distance <= best) continue;
        best = distance;
        p[size] = candidate;
      }
    }
    if (best > flat) ++size;
  }
  void fill_point(const ConvexPair& pair, double flat) {
    const std::array<Vec3, 3> axes = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
    farthest(
        pair, [](const Vec3& d) { return d.norm(); }, flat, axes);
    flat_normal = pair.c.squaredNorm() > 0 ? Vec3(pair.c.normalized()) : axes[2];
  }
  void fill_line(const ConvexPair& pair, double flat) {
    const Vec3 along = (p[1].w - p[0].w).normalized();
    const Vec3 u = across(along), v = along.cross(u);
    const std::array<Vec3, 4> around = {u, v, u + v, u - v};
    farthest(
        pair, [&](const Vec3& d) { return d.cross(along).norm(); }, flat, around);
    flat_normal = u;
  }
  void fill_plane(const ConvexPair& pair, double flat) {
    const std::array<Vec3, 1> n = {(p[1].w - p[0].w).cross(p[2].w - p[0].w).normalized()};
    farthest(
        pair, [&](const Vec3& d) { return std::abs(d.dot(n[0])); }, flat, n);
    flat_normal = n[0];
  }
};

Penetration across_flat(const ConvexPair& pair, const GjkResult& ended, const Vec3& flat_normal) {
  const Vec3 normal = flat_normal.dot(pair.c) > 0 ? Vec3(-flat_normal) : flat_normal;
  return {0, 0, normal, ended.on_a, ended.on_b};
}

Penetration along_support(const ConvexPair& pair, const Vec3& outward) {
  const DifferencePoint p = difference_support(pair, outward);
  return {p.w.dot(outward), 0, -outward, p.on_a, p.on_b()};
}

// The deepest points are blended as the foot of the origin on the face is of its corners.
void blend_foot(const Polytope& polytope, const Face& face, Penetration& result) {
  std::array<DifferencePoint, 3> p;
  for (std::size_t i = 0; i < 3; ++i) p[i] = polytope.point(face.corner[i]);
  const Vec3 ab = p[1].w - p[0].w, ac = p[2].w - p[0].w;
  const Vec3 n = ab.cross(ac);
  const Vec3 foot = face.distance * face.normal - p[0].w;
  const double along_b = foot.cross(ac).dot(n) / n.squaredNorm();
  const double along_c = ab.cross(foot).dot(n) / n.squaredNorm();
  const std::array<double, 3> weight = {1 - along_b - along_c, along_b, along_c};
  result.on_a.setZero();
  result.on_b.setZero();
  for (std::size_t i = 0; i < 3; ++i) {
    result.on_a += weight[i] * p[i].on_a;
    result.on_b += weight[i] * p[i].on_b();
  }
}

}  // namespace

Penetration penetration(const ConvexPair& pair, const GjkResult& ended) {
  Start start{ended.simplex, static_cast<std::size_t>(ended.size), Vec3::UnitZ()};
  if (!start.fill(pair, kEpaFlat * pair.small)) return across_flat(pair, ended, start.flat_normal);

  Polytope polytope(pair.rounding());
  Penetration best = along_support(
      pair, pair.c.squaredNorm() > 0 ? Vec3(pair.c.normalized()) : Vec3(Vec3::UnitZ()));
  if (!polytope.start(start.p)) return best;
  const double gap = pair.at_least_rounding(kEpaGap * pair.small);
  double lower = -std::numeric_limits<double>::infinity();
  for (;;) {
    const Face& face = polytope.nearest();
    lower = std::max(lower, face.distance);
    const Vec3 outward = face.normal;
    const DifferencePoint p = difference_support(pair, outward);
    const double upper = p.w.dot(outward);
    if (upper < best.depth) {
      best.depth = upper;
      best.normal = -outward;
      blend_foot(polytope, face, best);
    }
    if (upper - lower <= gap || !polytope.grow(p)) break;
  }
  best.lower = std::min(lower, best.depth);
  return best;
}

}  // namespace poinsot
