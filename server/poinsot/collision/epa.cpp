#include "poinsot/collision/epa.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "poinsot/collision/polish.h"

namespace poinsot {
namespace {

constexpr int kEpaPoints = kEpaFaces / 2 + 4;

struct Face {
  std::array<int, 3> corner;     // counter-clockwise seen from outside
  std::array<int, 3> neighbour;  // across the edge from corner e to the next
  Vec3 normal;                   // unit, outward
  double distance;               // [m] of its plane from the origin
};

// A convex polytope about the origin, grown point by point. Fixed capacity: no allocation.
class Polytope {
 public:
  explicit Polytope(double rounding) : rounding_(rounding) {}

  // False when the four points are flat.
  bool start(const std::array<DifferencePoint, 4>& p) {
    for (const DifferencePoint& x : p) points_[static_cast<std::size_t>(point_count_++)] = x;
    const double volume = (w(1) - w(0)).cross(w(2) - w(0)).dot(w(3) - w(0));
    constexpr int kFaces[4][3] = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
    for (const auto& f : kFaces)
      if (volume > 0 ? add(f[0], f[2], f[1]) < 0 : add(f[0], f[1], f[2]) < 0) return false;
    for (int f = 0; f < 4; ++f)
      for (int g = 0; g < 4; ++g) join(f, g);
    return true;
  }

  int nearest() const {
    const auto begin = distance_.begin();
    return static_cast<int>(std::min_element(begin, begin + face_count_) - begin);
  }

  // Adds a point outside of a face: all faces that see it are replaced by a fan over their horizon.
  // False when out of room or when rounding leaves no proper horizon; the polytope is then used up.
  bool grow(int from, const DifferencePoint& p) {
    if (point_count_ == kEpaPoints) return false;
    see(from, p.w);
    if (!find_horizon()) {  // seen faces in a ring about unseen ones, flat with the point
      see_islands(p.w);
      if (!find_horizon()) return false;
    }
    for (int i = 0; i < seen_count_; ++i) kill(seen_[static_cast<std::size_t>(i)]);
    points_[static_cast<std::size_t>(point_count_)] = p;
    return fan_out();
  }

  const DifferencePoint& point(int i) const { return points_[static_cast<std::size_t>(i)]; }
  const Face& face(int f) const { return faces_[static_cast<std::size_t>(f)]; }

 private:
  static constexpr double kDead = std::numeric_limits<double>::infinity();
  struct Edge {
    int from, to;
    int beyond;  // the unseen face across it
  };

  Face& face(int f) { return faces_[static_cast<std::size_t>(f)]; }
  const Vec3& w(int i) const { return point(i).w; }
  bool is_alive(int f) const { return distance_[static_cast<std::size_t>(f)] != kDead; }
  bool is_seen(int f) const { return seen_at_[static_cast<std::size_t>(f)] == point_count_; }
  double height(int f, const Vec3& p) const { return face(f).normal.dot(p) - face(f).distance; }

  // The new face, or −1 without room or area.
  int add(int i, int j, int k) {
    const Vec3 n = (w(j) - w(i)).cross(w(k) - w(i));
    const double length = n.norm();
    if (length <= rounding_ * rounding_) return -1;
    if (free_count_ == 0 && face_count_ == kEpaFaces) return -1;
    const int f = free_count_ > 0 ? free_[static_cast<std::size_t>(--free_count_)] : face_count_++;
    const Vec3 normal = n / length;
    face(f) = {{i, j, k}, {-1, -1, -1}, normal, normal.dot(w(i))};
    distance_[static_cast<std::size_t>(f)] = face(f).distance;
    seen_at_[static_cast<std::size_t>(f)] = 0;
    return f;
  }
  void kill(int f) {
    distance_[static_cast<std::size_t>(f)] = kDead;
    free_[static_cast<std::size_t>(free_count_++)] = f;
  }

  void join(int f, int g) {
    for (std::size_t e = 0; e < 3; ++e)
      for (std::size_t d = 0; d < 3; ++d)
        if (face(f).corner[e] == face(g).corner[(d + 1) % 3] &&
            face(f).corner[(e + 1) % 3] == face(g).corner[d])
          face(f).neighbour[e] = g;
  }

  void mark_seen(int f) {
    seen_at_[static_cast<std::size_t>(f)] = point_count_;
    seen_[static_cast<std::size_t>(seen_count_++)] = f;
  }

  // Lists the faces that see the point and connect to `from`.
  void see(int from, const Vec3& p) {
    seen_count_ = 0;
    mark_seen(from);
    for (int i = 0; i < seen_count_; ++i)
      for (const int next : face(seen_[static_cast<std::size_t>(i)]).neighbour)
        if (!is_seen(next) && height(next, p) > rounding_) mark_seen(next);
  }

  // Also lists what does not connect to the far side over unseen faces.
  void see_islands(const Vec3& p) {
    int far = -1;
    for (int f = 0; f < face_count_; ++f)
      if (is_alive(f) && !is_seen(f) && (far < 0 || height(f, p) < height(far, p))) far = f;
    if (far < 0) return;
    std::array<bool, static_cast<std::size_t>(kEpaFaces)> is_far{};
    std::array<int, static_cast<std::size_t>(kEpaFaces)> open;
    int count = 0;
    open[static_cast<std::size_t>(count++)] = far;
    is_far[static_cast<std::size_t>(far)] = true;
    for (int i = 0; i < count; ++i) {
      for (const int next : face(open[static_cast<std::size_t>(i)]).neighbour) {
        if (is_seen(next) || is_far[static_cast<std::size_t>(next)]) continue;
        is_far[static_cast<std::size_t>(next)] = true;
        open[static_cast<std::size_t>(count++)] = next;
      }
    }
    for (int f = 0; f < face_count_; ++f)
      if (is_alive(f) && !is_seen(f) && !is_far[static_cast<std::size_t>(f)]) mark_seen(f);
  }

  // The edges between seen and unseen faces, head to tail; false if they are not one closed loop.
  bool find_horizon() {
    horizon_count_ = 0;
    for (int i = 0; i < seen_count_; ++i) {
      const Face& f = face(seen_[static_cast<std::size_t>(i)]);
      for (std::size_t e = 0; e < 3; ++e)
        if (!is_seen(f.neighbour[e]))
          horizon_[static_cast<std::size_t>(horizon_count_++)] = {
              f.corner[e], f.corner[(e + 1) % 3], f.neighbour[e]};
    }
    if (horizon_count_ < 3) return false;
    const auto begin = horizon_.begin(), end = begin + horizon_count_;
    for (auto edge = begin; edge + 1 != end; ++edge) {
      const auto next =
          std::find_if(edge + 1, end, [&](const Edge& x) { return x.from == edge->to; });
      if (next == end) return false;
      std::swap(*(edge + 1), *next);
    }
    return (end - 1)->to == begin->from;
  }

  // New faces from the horizon to the newest point, joined to each other and to what is beyond.
  bool fan_out() {
    int first = -1, last = -1;
    for (int i = 0; i < horizon_count_; ++i) {
      const Edge& edge = horizon_[static_cast<std::size_t>(i)];
      const int fan = add(edge.from, edge.to, point_count_);
      if (fan < 0) return false;
      face(fan).neighbour = {edge.beyond, -1, last};
      Face& beyond = face(edge.beyond);
      for (std::size_t e = 0; e < 3; ++e)
        if (beyond.corner[e] == edge.to) beyond.neighbour[e] = fan;
      if (last >= 0) face(last).neighbour[1] = fan;
      if (first < 0) first = fan;
      last = fan;
    }
    face(first).neighbour[2] = last;
    face(last).neighbour[1] = first;
    ++point_count_;
    return true;
  }

  double rounding_;
  std::array<DifferencePoint, static_cast<std::size_t>(kEpaPoints)> points_;
  std::array<Face, static_cast<std::size_t>(kEpaFaces)> faces_;
  std::array<double, static_cast<std::size_t>(kEpaFaces)> distance_;  // of faces; infinite: dead
  std::array<int, static_cast<std::size_t>(kEpaFaces)> seen_at_;      // by which point, last
  std::array<int, static_cast<std::size_t>(kEpaFaces)> seen_, free_;
  std::array<Edge, 3 * static_cast<std::size_t>(kEpaFaces)> horizon_;
  int point_count_ = 0, face_count_ = 0, seen_count_ = 0, free_count_ = 0, horizon_count_ = 0;
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
  const double depth = -difference_support(pair, -normal).w.dot(normal);
  return {depth, std::min(depth, 0.0), normal, ended.on_a, ended.on_b};
}

Penetration along_support(const ConvexPair& pair, const Vec3& outward) {
  const DifferencePoint p = difference_support(pair, outward);
  return {p.w.dot(outward), 0, -outward, p.on_a, p.on_b()};
}

// The foot of the origin on a face, as a blend of its corners.
Blend foot(const Polytope& polytope, const Face& face) {
  Blend blend;
  blend.size = 3;
  for (std::size_t i = 0; i < 3; ++i) blend.points[i] = polytope.point(face.corner[i]);
  const Vec3& a = blend.points[0].w;
  const Vec3 ab = blend.points[1].w - a, ac = blend.points[2].w - a;
  const Vec3 n = ab.cross(ac);
  const Vec3 foot = face.distance * face.normal - a;
  const double along_b = foot.cross(ac).dot(n) / n.squaredNorm();
  const double along_c = ab.cross(foot).dot(n) / n.squaredNorm();
  blend.weights = {1 - along_b - along_c, along_b, along_c};
  return blend;
}

// The least depth near the best found, to rounding. The polytope bounds it, but knows its place
// only to the size of a face; and where many directions are all but equal, as deep inside a cone on
// its axis, it is used up on the ring of them. True if it settled.
bool improve(const ConvexPair& pair, const Blend& blend, Penetration& best) {
  const Polished p = polish(pair, best.normal, blend, pair.rounding());
  if (-p.lower > best.depth + pair.rounding()) return false;
  best.depth = -p.lower;
  best.normal = p.normal;
  if (!p.settled) return false;
  best.on_a = p.on_a;
  best.on_b = p.on_b;
  return true;
}

}  // namespace

Penetration penetration(const ConvexPair& pair, const GjkResult& ended, double accuracy) {
  Start start{ended.simplex, static_cast<std::size_t>(ended.size), Vec3::UnitZ()};
  if (!start.fill(pair, pair.at_least_rounding(kEpaFlat * pair.small)))
    return across_flat(pair, ended, start.flat_normal);

  Polytope polytope(pair.rounding());
  Penetration best = along_support(
      pair, pair.c.squaredNorm() > 0 ? Vec3(pair.c.normalized()) : Vec3(Vec3::UnitZ()));
  bool is_polished = ended.near_stationary.settled;
  if (const Polished& p = ended.near_stationary; p.settled && -p.lower < best.depth)
    best = {-p.lower, 0, p.normal, p.on_a, p.on_b};
  if (!polytope.start(start.p)) return best;
  const double coarse = accuracy * pair.small, fine = pair.at_least_rounding(kEpaGap * pair.small);
  double lower = -std::numeric_limits<double>::infinity();
  Blend blend;
  for (;;) {
    const int nearest = polytope.nearest();
    const Face& face = std::as_const(polytope).face(nearest);
    lower = std::max(lower, face.distance);
    const Vec3 outward = face.normal;
    const DifferencePoint p = difference_support(pair, outward);
    const double upper = p.w.dot(outward);
    if (upper < best.depth) {
      blend = foot(polytope, face);
      best = {upper, 0, -outward, blend.on_a(), blend.on_b()};
      is_polished = false;
    }
    if (best.depth - lower <= fine || !polytope.grow(nearest, p)) break;
    // Good enough, once its own digits are right.
    if (pair.is_curved() && best.depth - lower <= coarse) {
      is_polished = is_polished || improve(pair, blend, best);
      if (is_polished) break;
    }
  }
  if (pair.is_curved() && !is_polished && blend.size > 0) improve(pair, blend, best);
  best.lower = std::min(lower, best.depth);
  return best;
}

}  // namespace poinsot
