#include "poinsot/collision/polish.h"

#include <cmath>

#include "poinsot/collision/surface_patch.h"

namespace poinsot {
namespace {

constexpr double kLongestTurn = 0.3;  // [rad] of the normal in one step
constexpr double kParallel = 1e-12;   // sine below which two freedoms count as one
constexpr double kOpposite = 1e-8;    // [-] of the smaller radius: points opposite each other
constexpr double kPastTheEnd = 4;     // [-] of a freedom, which is at most two long
constexpr double kOnFreedom = 1e-6;   // cosine below which a normal is perpendicular to a freedom

Tangents tangents(const Vec3& n) {
  Eigen::Index least = 0;
  n.cwiseAbs().minCoeff(&least);
  Tangents T;
  T.col(0) = n.cross(Vec3::Unit(least)).normalized();
  T.col(1) = n.cross(T.col(0));
  return T;
}

SurfacePatch patch_of_a(const ConvexPair& pair, const Vec3& normal, const Blend& blend) {
  std::array<Vec3, 3> points;
  for (std::size_t i = 0; i < blend.size; ++i) points[i] = blend.points[i].on_a;
  const std::span weights(blend.weights.data(), blend.size);
  return {pair.a, Mat3::Identity(), Vec3::Zero(), {points.data(), blend.size}, weights, -normal};
}

SurfacePatch patch_of_b(const ConvexPair& pair, const Vec3& normal, const Blend& blend) {
  std::array<Vec3, 3> points;
  for (std::size_t i = 0; i < blend.size; ++i) points[i] = blend.points[i].on_b();
  const std::span weights(blend.weights.data(), blend.size);
  return {pair.b, pair.R, pair.c, {points.data(), blend.size}, weights, normal};
}

enum class Refers { kNone, kA, kB };

// A straight freedom of either shape, as it moves the difference of the points.
struct Freedom {
  Vec2 g;      // [m] in the tangents
  double off;  // [m] along the normal: to become zero
  bool of_a;
  Eigen::Index k;  // of its shape
};

// One step: how the normal turns, and how the points move along their freedoms.
class Step {
 public:
  // `refers`: of two faces, the one whose normal holds.
  Step(const SurfacePatch& a, const SurfacePatch& b, const Vec3& n, Refers refers)
      : T(tangents(n)), refers_(refers) {
    for (std::size_t k = 0; k < a.freedoms(); ++k) add(a.freedom(k), n, true, k);
    for (std::size_t k = 0; k < b.freedoms(); ++k) add(-b.freedom(k), n, false, k);
    const Vec3 v = a.point() - b.point();
    M_ = a.curvature(T) + b.curvature(T);
    M_.diagonal().array() += n.dot(v);
    r_ = T.transpose() * v;
  }

  // False where the separation is not at a maximum along what is left free.
  bool solve(double tolerance) {
    choose();
    leave_others(tolerance);
    if (used_ == 2) return solve_fixed();
    if (used_ == 1) return solve_on_line(freedoms_[first_]);
    const double det = M_.determinant();
    if (!(M_(0, 0) > 0 && det > 0)) return false;
    turn = Vec2(M_(1, 1) * r_[0] - M_(0, 1) * r_[1], M_(0, 0) * r_[1] - M_(1, 0) * r_[0]) / det;
    return true;
  }

  Tangents T;
  Vec2 turn = Vec2::Zero();                             // of the normal, in T
  Vec2 along_a = Vec2::Zero(), along_b = Vec2::Zero();  // the freedoms

 private:
  void add(const Vec3& g, const Vec3& n, bool of_a, std::size_t k) {
    freedoms_[count_++] = {T.transpose() * g, -n.dot(g), of_a, static_cast<Eigen::Index>(k)};
  }
  void move(const Freedom& f, double by) { (f.of_a ? along_a : along_b)[f.k] = by; }

  // Two freedoms that span the plane, as nearly perpendicular as there are; or the longest one.
  void choose() {
    if (refers_ != Refers::kNone) {
      used_ = 2;
      first_ = refers_ == Refers::kA ? 0 : 2;
      second_ = first_ + 1;
      return;
    }
    if (count_ == 0) return;
    used_ = 1;
    std::array<double, 4> length2;
    for (std::size_t i = 0; i < count_; ++i) length2[i] = freedoms_[i].g.squaredNorm();
    double widest2 = kParallel * kParallel;
    for (std::size_t i = 0; i < count_; ++i) {
      if (used_ == 1 && length2[i] > length2[first_]) first_ = i;
      for (std::size_t j = i + 1; j < count_; ++j) {
        const double area = cross(freedoms_[i].g, freedoms_[j].g);
        if (!(area * area > widest2 * length2[i] * length2[j])) continue;
        widest2 = area * area / (length2[i] * length2[j]);
        first_ = i;
        second_ = j;
        used_ = 2;
      }
    }
  }
  // What is left over is along the two in use, or its end is nearer than its inside.
  void leave_others(double tolerance) {
    for (const bool of_a : {true, false}) {
      double most = 0.1 * tolerance;
      for (std::size_t i = 0; i < count_; ++i)
        if (freedoms_[i].of_a == of_a && !is_used(i))
          most = std::max(most, std::abs(freedoms_[i].off));
      if (most == 0.1 * tolerance) continue;
      for (std::size_t i = 0; i < count_; ++i)
        if (freedoms_[i].of_a == of_a && !is_used(i))
          move(freedoms_[i], kPastTheEnd * freedoms_[i].off / most);
    }
  }
  bool is_used(std::size_t i) const {
    return (used_ > 0 && i == first_) || (used_ > 1 && i == second_);
  }
  static double cross(const Vec2& u, const Vec2& v) { return u[0] * v[1] - u[1] * v[0]; }

  // Two freedoms: they alone say where the normal is.
  bool solve_fixed() {
    const Freedom &f = freedoms_[first_], &h = freedoms_[second_];
    const double det = cross(f.g, h.g);
    turn = Vec2(f.off * h.g[1] - h.off * f.g[1], h.off * f.g[0] - f.off * h.g[0]) / det;
    const Vec2 rest = M_ * turn - r_;
    move(f, cross(rest, h.g) / det);
    move(h, cross(f.g, rest) / det);
    return true;
  }
  bool solve_on_line(const Freedom& f) {
    const double length2 = f.g.squaredNorm();
    const Vec2 across(-f.g[1], f.g[0]);
    const Vec2 toward = (f.off / length2) * f.g;
    const double bend = across.dot(M_ * across);
    if (!(bend > 0)) return false;
    turn = toward + (across.dot(r_ - M_ * toward) / bend) * across;
    move(f, f.g.dot(M_ * turn - r_) / length2);
    return true;
  }

  Mat2 M_;  // [m] curvature of the separation
  Vec2 r_;  // [m] how far the points are from lying opposite each other
  Refers refers_;
  std::array<Freedom, 4> freedoms_;
  std::size_t count_ = 0, first_ = 0, second_ = 0;
  int used_ = 0;
};

// Two faces that all but face each other: the normal of the one that parts the cores more holds.
Refers reference(const ConvexPair& pair, const SurfacePatch& a, const SurfacePatch& b, Vec3& n) {
  if (a.freedoms() < 2 || b.freedoms() < 2) return Refers::kNone;
  const auto normal_of = [&](const SurfacePatch& face) {
    const Vec3 across = face.freedom(0).cross(face.freedom(1)).normalized();
    return across.dot(n) < 0 ? Vec3(-across) : across;
  };
  const auto apart = [&](const Vec3& d) { return difference_support(pair, -d).w.dot(d); };
  const Vec3 of_a = normal_of(a), of_b = normal_of(b);
  const bool a_holds = apart(of_a) >= apart(of_b);
  n = a_holds ? of_a : of_b;
  return a_holds ? Refers::kA : Refers::kB;
}

bool is_perpendicular(const SurfacePatch& patch, const Vec3& n) {
  for (std::size_t k = 0; k < patch.freedoms(); ++k)
    if (std::abs(n.dot(patch.freedom(k))) > kOnFreedom * patch.freedom(k).norm()) return false;
  return true;
}

}  // namespace

Polished polish(const ConvexPair& pair, const Vec3& normal, const Blend& blend, double tolerance) {
  SurfacePatch a = patch_of_a(pair, normal, blend), b = patch_of_b(pair, normal, blend);
  Polished best;
  best.lower = -std::numeric_limits<double>::infinity();
  best.upper = std::numeric_limits<double>::infinity();
  Vec3 n = normal;
  for (int i = 0; i < kPolishIterations; ++i) {
    a.turn_to(-n);
    b.turn_to(n);
    const Vec3 v = a.point() - b.point();
    const double apart = n.dot(v);
    const Vec3 farthest_a = pair.support_a(-n), farthest_b = pair.support_b(n);
    const double beyond_a = n.dot(a.point() - farthest_a), beyond_b = n.dot(farthest_b - b.point());
    const double lower = n.dot(farthest_a - farthest_b);
    if (lower > best.lower) {
      best.lower = lower;
      best.normal = n;
    }
    if (const double length = v.norm(); length < best.upper) {
      best.upper = length;
      best.on_a = a.point();
      best.on_b = b.point();
    }
    const double aside = (v - apart * n).norm();
    best.settled = apart > 0 ? best.upper - best.lower <= tolerance
                             : beyond_a + beyond_b <= tolerance && aside <= kOpposite * pair.small;
    if (best.settled) {
      if (apart <= 0) {
        best.lower = lower;
        best.normal = n;
        best.on_a = a.point();
        best.on_b = b.point();
      }
      break;
    }
    bool grown = false;
    if (beyond_a > tolerance && is_perpendicular(a, n)) grown |= a.grow(farthest_a);
    if (beyond_b > tolerance && is_perpendicular(b, n)) grown |= b.grow(farthest_b);
    if (grown) {
      a.turn_to(-n);
      b.turn_to(n);
    }
    Step step(a, b, n, reference(pair, a, b, n));
    if (!step.solve(tolerance)) break;
    const double turn = step.turn.norm();
    if (turn > kLongestTurn) step.turn *= kLongestTurn / turn;
    n += step.T * step.turn;
    n -= a.move(step.along_a);
    n += b.move(step.along_b);
    n.normalize();
  }
  return best;
}

}  // namespace poinsot
