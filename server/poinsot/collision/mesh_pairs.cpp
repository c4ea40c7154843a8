#include "poinsot/collision/mesh_pairs.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "poinsot/base/check.h"
#include "poinsot/collision/epa.h"
#include "poinsot/collision/mesh_surface.h"

namespace poinsot {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
// A body through the surface with no more than this part of it in front came from behind.
constexpr double kBehind = 1e-3;
// Another direction than a face's normal must win by so much, relative to the smaller body.
constexpr double kFaceWins = 1e-9;
// Manifolds of normals nearer to each other than this become one; cos(1e-3 rad).
constexpr double kSameCluster = 1 - 5e-7;

// What a body has to do with one triangle, in the body's frame.
struct Felt {
  int triangle;
  Witness witness;
  double lower;  // [m] of the gap
  double side;   // +1: outside of the surface, −1: behind it
  bool by_face;  // pushes along the normal, and only from over the triangle
};

class MeshQuery {
 public:
  MeshQuery(const Collider& a, const Pose& pose_a, const Collider& b, const Pose& pose_b)
      : a_(a),
        surface_(*b.surface),
        triangle_(triangle_collider(b, std::max(b.triangle, 0))),
        only_(b.triangle),
        pair_(a, pose_a, triangle_, pose_b),
        small_(std::min(a.size, b.size)),
        pose_a_(pose_a),
        box_(bounds(a, pose_b.inverse() * pose_a)) {}

  Gap gap() {
    Felt best{};
    double value = kInfinite, lower = kInfinite;
    const auto visit = [&](int t) {
      Felt felt;
      if (!feel(t, value, felt)) return kInfinite;
      lower = std::min(lower, felt.lower);
      if (felt.witness.gap < value) {
        value = felt.witness.gap;
        best = felt;
      }
      return felt.witness.gap;
    };
    if (only_ >= 0)
      visit(only_);
    else
      surface_.bvh().nearest(box_.low, box_.high, kInfinite, visit);
    POINSOT_CHECK(value < kInfinite);
    const Witness& w = best.witness;
    const Vec3 normal = best.by_face ? face_normal(best) : w.normal;
    // From the core to the surface as the witness says, whose points these are.
    return {value, std::min(lower, value), pose_a_.q * normal,
            pose_a_ * Vec3(w.on_a - a_.core_radius * w.normal), pose_a_ * w.on_b};
  }

  void manifolds(double margin, std::vector<Manifold>& out) {
    gather(margin);
    group();
    out.resize(std::min(clusters_.size(), kMaxMeshManifolds));
    for (std::size_t k = 0; k < out.size(); ++k) {
      out[k] = reduced(clusters_[k]);
      to_world(out[k]);
    }
  }

 private:
  struct Point {
    Vec3 normal, point;
    double gap;
    std::size_t cluster;
  };
  struct Cluster {
    Vec3 normal;
    double least;  // [m] gap
    std::size_t id;
  };

  Vec3 in_a(const Vec3& direction) const { return pair_.R * direction; }
  Vec3 in_mesh(const Vec3& direction) const { return pair_.R.transpose() * direction; }
  Vec3 face_normal(const Felt& felt) const {
    return felt.side * in_a(surface_.normal(felt.triangle));
  }

  // [m] How far a is beyond triangle `t` in direction d; negative: how far it must go that way.
  double beyond(const Vec3& d) const {
    return d.dot(pair_.support_a(-d)) - a_.core_radius - d.dot(pair_.support_b(d));
  }

  // False if a is farther than `enough` from triangle t.
  bool feel(int t, double enough, Felt& felt) {
    triangle_.triangle = t;
    felt.triangle = t;
    const Vec3 n = in_a(surface_.normal(t));
    const double above = beyond(n), behind = beyond(-n);  // of its plane; both negative: through
    const double apart = std::max(enough, 0.0);           // depths are decided below
    if (std::max(above, behind) > apart) return false;
    const GjkResult near = gjk(pair_, apart + a_.core_radius);
    if (near.separated)
      felt.witness = {near.normal, near.on_a, near.on_b, near.distance - a_.core_radius};
    else
      take_depth(near, felt.witness);
    felt.lower = near.separated ? near.lower - a_.core_radius : felt.witness.gap;
    if (felt.lower > apart) return false;
    if (felt.witness.gap > 0 && near.separated) {
      felt.side = felt.witness.normal.dot(n) >= 0 ? 1 : -1;
      felt.by_face = !may_push(felt.witness, t);
    } else {
      choose_way_out(n, above, behind, felt);
      felt.lower = felt.witness.gap;
    }
    return felt.witness.gap <= enough;
  }

  void take_depth(const GjkResult& near, Witness& witness) const {
    const Penetration deep = penetration(pair_, near);
    witness = {deep.normal, deep.on_a, deep.on_b, -deep.depth - a_.core_radius};
  }

  bool may_push(const Witness& witness, int t) const {
    return surface_.may_push(t, in_mesh(witness.on_b - pair_.c), in_mesh(witness.normal));
  }

  // Through the triangle: the shortest of the ways out that the surface there can push.
  void choose_way_out(const Vec3& n, double above, double behind, Felt& felt) {
    const int t = felt.triangle;
    felt.side = -behind < -kBehind * (above + behind) ? -1 : 1;
    const Vec3 out = felt.side * n;
    const Witness found = felt.witness;
    take_way(out, felt.side > 0 ? above : behind, felt.witness);
    felt.by_face = true;
    const double must_win = kFaceWins * small_;
    if (found.normal.dot(out) > 0 && found.gap > felt.witness.gap + must_win &&
        may_push(found, t)) {
      felt.witness = found;
      felt.by_face = false;
    }
    surface_.across_ridges(t, felt.side, [&](const Vec3& normal) {
      const Vec3 d = felt.side * in_a(normal);
      const double gap = beyond(d);
      if (gap <= felt.witness.gap + must_win) return;
      take_way(d, gap, felt.witness);
      felt.by_face = false;
    });
  }

  void take_way(const Vec3& d, double gap, Witness& witness) const {
    const Vec3 deepest = pair_.support_a(-d);
    witness = {d, deepest, deepest - (a_.core_radius + gap) * d, gap};
  }

  // Whether a point [m], in a's frame, is over the triangle to within rounding.
  bool is_over(int t, const Vec3& point) const {
    const Vec3 p = in_mesh(point - pair_.c);
    const auto& corners = surface_.corners(t);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 side = corners[(k + 1) % 3] - corners[k];
      const double inside = surface_.normal(t).cross(side).dot(p - corners[k]);
      if (inside < -4 * pair_.rounding() * side.norm()) return false;
    }
    return true;
  }

  // The points of all triangles within the margin, of those on one side of the surface: what is
  // behind the nearest triangle is hidden by it.
  void gather(double margin) {
    felt_.clear();
    points_.clear();
    near_.clear();
    const Aabb box = box_.grown(margin);
    if (only_ >= 0)
      near_.push_back(only_);
    else
      surface_.bvh().overlapping(box.low, box.high, [&](int t) { near_.push_back(t); });
    std::ranges::sort(near_);
    const Felt* nearest = nullptr;
    felt_.reserve(near_.size());
    for (const int t : near_) {
      Felt felt;
      if (!feel(t, margin, felt)) continue;
      felt_.push_back(felt);
      if (!nearest || felt.witness.gap < nearest->witness.gap) nearest = &felt_.back();
    }
    for (const Felt& felt : felt_)
      if (felt.side == nearest->side) add_points(felt, margin);
  }

  void add_points(const Felt& felt, double margin) {
    triangle_.triangle = felt.triangle;
    Witness witness = felt.witness;
    bool keep_witness = true;
    if (felt.by_face) {
      const Vec3 out = face_normal(felt);
      take_way(out, beyond(out), witness);
      keep_witness = is_over(felt.triangle, witness.on_a);
    }
    const PointSet set = gather_points(pair_, witness, margin, keep_witness);
    for (int i = 0; i < set.count(); ++i)
      points_.push_back({set.normal(), set.point(i), set.gap(i), 0});
  }

  // Points of one normal are a cluster; the deepest cluster first.
  void group() {
    clusters_.clear();
    for (Point& p : points_) {
      auto cluster = std::ranges::find_if(
          clusters_, [&](const Cluster& c) { return c.normal.dot(p.normal) > kSameCluster; });
      if (cluster == clusters_.end())
        cluster = clusters_.insert(cluster, {p.normal, p.gap, clusters_.size()});
      cluster->least = std::min(cluster->least, p.gap);
      p.cluster = cluster->id;
    }
    std::ranges::sort(clusters_, {}, [](const Cluster& c) { return std::pair(c.least, c.id); });
  }

  Manifold reduced(const Cluster& cluster) {
    candidates_.clear();
    members_.clear();
    Eigen::Index least = 0;
    cluster.normal.cwiseAbs().minCoeff(&least);
    const Vec3 u = cluster.normal.cross(Vec3::Unit(least)).normalized();
    const Vec3 v = cluster.normal.cross(u);
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (points_[i].cluster != cluster.id) continue;
      candidates_.push_back({u.dot(points_[i].point), v.dot(points_[i].point), points_[i].gap});
      members_.push_back(i);
    }
    put_outermost_first();
    const Choice choice = choose_points(candidates_, kSameGap * small_);
    Manifold manifold;
    manifold.normal = cluster.normal;
    manifold.count = choice.count;
    for (std::size_t k = 0; k < static_cast<std::size_t>(choice.count); ++k) {
      const Point& p = points_[members_[choice.index[k]]];
      manifold.points[k] = {p.point, p.gap};
    }
    return manifold;
  }

  // Of points equally deep the first is chosen: a corner of the patch, not a corner of a triangle
  // somewhere in its middle. Along a direction fixed to the body that is no edge's of a box.
  void put_outermost_first() {
    const Vec3 direction(1, 0.618, 0.382);
    double least = kInfinite, farthest = -kInfinite;
    for (const Candidate& c : candidates_) least = std::min(least, c.gap);
    std::size_t best = 0;
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
      const double along = direction.dot(points_[members_[i]].point);
      if (candidates_[i].gap > least + kSameGap * small_ || along <= farthest) continue;
      farthest = along;
      best = i;
    }
    std::swap(candidates_[0], candidates_[best]);
    std::swap(members_[0], members_[best]);
  }

  void to_world(Manifold& manifold) const {
    manifold.normal = pose_a_.q * manifold.normal;
    for (std::size_t k = 0; k < static_cast<std::size_t>(manifold.count); ++k)
      manifold.points[k].point = pose_a_ * manifold.points[k].point;
  }

  const Collider& a_;
  const MeshSurface& surface_;
  Collider triangle_;  // the one at hand
  int only_;           // the only one that is asked about; −1: all
  ConvexPair pair_;    // of a and triangle_
  double small_;       // [m] what relative tolerances are relative to
  Pose pose_a_;
  Aabb box_;  // of a in the frame of the mesh

  // Kept from query to query of a thread: the steady state does not allocate.
  struct Scratch {
    std::vector<int> near;
    std::vector<Felt> felt;
    std::vector<Point> points;
    std::vector<Cluster> clusters;
    std::vector<Candidate> candidates;
    std::vector<std::size_t> members;
  };
  static Scratch& scratch() {
    thread_local Scratch scratch;
    return scratch;
  }
  std::vector<int>& near_ = scratch().near;
  std::vector<Felt>& felt_ = scratch().felt;
  std::vector<Point>& points_ = scratch().points;
  std::vector<Cluster>& clusters_ = scratch().clusters;
  std::vector<Candidate>& candidates_ = scratch().candidates;
  std::vector<std::size_t>& members_ = scratch().members;
};

}  // namespace

Gap gap_to_mesh(const Collider& a, const Pose& pose_a, const Collider& b, const Pose& pose_b) {
  return MeshQuery(a, pose_a, b, pose_b).gap();
}

void mesh_manifolds(const Collider& a, const Pose& pose_a, const Collider& b, const Pose& pose_b,
                    double margin, std::vector<Manifold>& out) {
  MeshQuery(a, pose_a, b, pose_b).manifolds(margin, out);
}

void triangles_near(const Collider& mesh, const Pose& pose, const Aabb& box_W,
                    std::vector<int>& out) {
  out.clear();
  const Mat3 turn = pose.q.conjugate().toRotationMatrix();
  const Vec3 middle = turn * (0.5 * (box_W.low + box_W.high) - pose.c);
  // Rounding must not lose a triangle at the very edge.
  const double slack = kRounding * (mesh.bounding_radius + middle.norm());
  const Vec3 half = turn.cwiseAbs() * (0.5 * (box_W.high - box_W.low)) + Vec3::Constant(slack);
  mesh.surface->bvh().overlapping(middle - half, middle + half, [&](int t) { out.push_back(t); });
  std::ranges::sort(out);
}

Collider triangle_collider(const Collider& mesh, int triangle) {
  return Collider(mesh, triangle);
}

}  // namespace poinsot
