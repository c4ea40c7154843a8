#include "poinsot/collision/surface_patch.h"

#include <algorithm>
#include <cmath>

namespace poinsot {
namespace {

constexpr double kAlongAxis = 1e-13;  // sine below which a normal has no part across an axis
constexpr double kLean = 1e-3;        // [rad] by which a normal leaves an axis
constexpr double kFacesCap = 0.1;     // sine below which a disc is tried before its rim
constexpr double kFlat = 1e-9;        // [-] of their distances: corners in a plane
constexpr double kInside = 0.95;      // [-] of the radius, where the blend has to lie for that

// Whether support_feature() thins none of its faces.
bool has_whole_faces(const Collider& shape) {
  const auto* convex = std::get_if<Convex>(&shape.shape);
  if (!convex) return true;
  for (const Convex::Face& face : convex->faces)
    if (face.loop.size() > Feature::kMaxCorners) return false;
  return true;
}

}  // namespace

SurfacePatch::SurfacePatch(const Collider& shape, const Mat3& R, const Vec3& c,
                           std::span<const Vec3> points, std::span<const double> weights,
                           const Vec3& m)
    : center_(c) {
  if (const auto* e = std::get_if<Ellipsoid>(&shape.shape)) {
    kind_ = Kind::kEllipsoid;
    from_ball_ = R * e->semi_axes.asDiagonal();
  } else if (const auto* cylinder = std::get_if<Cylinder>(&shape.shape)) {
    radius_ = cylinder->radius;
    half_ = 0.5 * cylinder->length;
    axis_ = R.col(2);
    start_round(points, weights, m);
  } else if (const auto* cone = std::get_if<Cone>(&shape.shape)) {
    radius_ = cone->radius;
    half_ = 0.5 * cone->length;
    axis_ = R.col(2);
    is_cone_ = true;
    start_round(points, weights, m);
  } else {
    start_corners(points, weights, kFlat * shape.bounding_radius);
    if (freedoms_ == 2 && has_whole_faces(shape))
      start_polygon(support_feature(shape, R.transpose() * m), R);
  }
}

// Corners come as differences, rounded: nearer than `same` [m] they are one.
void SurfacePatch::start_corners(std::span<const Vec3> points, std::span<const double> weights,
                                 double same) {
  base_ = points[0];
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Vec3 g = points[i] - base_;
    if (g.norm() <= same) continue;
    if (freedoms_ == 1 && (g - g_[0]).norm() <= same) {
      t_[0] += weights[i];
      continue;
    }
    g_[freedoms_] = g;
    t_[static_cast<Eigen::Index>(freedoms_++)] = weights[i];
  }
}

// The whole face, if the corners lie on it.
void SurfacePatch::start_polygon(const Feature& face, const Mat3& R) {
  if (face.count < 3) return;
  face_ = face;
  for (int i = 0; i < face.count; ++i)
    face_.corners[static_cast<std::size_t>(i)] = center_ + R * face[i];
  const Vec3 across = (face_[1] - face_[0]).cross(face_[2] - face_[0]).normalized();
  const double flat = kFlat * std::max(g_[0].norm(), g_[1].norm());
  for (const Vec3& p : {base_, Vec3(base_ + g_[0]), Vec3(base_ + g_[1])})
    if (std::abs(across.dot(p - face_[0])) > flat) return;
  kind_ = Kind::kPolygon;
}

void SurfacePatch::start_round(std::span<const Vec3> points, std::span<const double> weights,
                               const Vec3& m) {
  double top = 0, bottom = 0;  // weights of the points above and below the centre
  Vec3 blend = Vec3::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    (axis_.dot(points[i] - center_) > 0 ? top : bottom) += weights[i];
    blend += weights[i] * (points[i] - center_);
  }
  if (top > 0 && bottom > 0) {
    kind_ = is_cone_ ? Kind::kFunnel : Kind::kBarrel;
    t_[0] = is_cone_ ? bottom : top;
  } else if (is_cone_ && top > 0) {
    base_ = center_ + half_ * axis_;
  } else {
    become_rim(top > 0 ? 1 : -1);
    const Vec3 aside = blend - axis_.dot(blend) * axis_;
    if (m.cross(axis_).norm() < kFacesCap && aside.norm() < kInside * radius_) {
      across_ = aside / radius_;
      become_disc();
    }
  }
}

void SurfacePatch::become_edge(const Vec3& from, const Vec3& to, double t) {
  kind_ = Kind::kCorners;
  base_ = from;
  g_[0] = to - from;
  t_ = {std::clamp(t, 0.0, 1.0), 0};
  freedoms_ = 1;
}

void SurfacePatch::become_rim(double side) {
  kind_ = Kind::kRim;
  side_ = side;
  freedoms_ = 0;
  t_.setZero();
}

void SurfacePatch::become_disc() {
  kind_ = Kind::kDisc;
  Eigen::Index least = 0;
  axis_.cwiseAbs().minCoeff(&least);
  const Vec3 u = axis_.cross(Vec3::Unit(least)).normalized(), v = axis_.cross(u);
  t_ = {u.dot(across_), v.dot(across_)};
  g_ = {radius_ * u, radius_ * v};
  base_ = center_ + side_ * half_ * axis_;
}

void SurfacePatch::turn_to(const Vec3& m) {
  if (kind_ == Kind::kEllipsoid) {
    ball_ = from_ball_.transpose() * m;
    width_ = ball_.norm();
    ball_ /= width_;
    point_ = center_ + from_ball_ * ball_;
    return;
  }
  if (kind_ == Kind::kRim || kind_ == Kind::kBarrel || kind_ == Kind::kFunnel) {
    Vec3 aside = m - axis_.dot(m) * axis_;
    aside -= axis_.dot(aside) * axis_;  // what rounding left, which counts where the rest is small
    const double sine = aside.norm();
    // A rim whose normal passes over the axis touches with its disc.
    if (kind_ == Kind::kRim && (sine < kAlongAxis || aside.dot(across_) < 0)) {
      become_disc();
    } else {
      across_ = sine > 0 ? Vec3(aside / sine) : across_;
      bend_ = radius_ / std::max(sine, kAlongAxis);
    }
  }
  switch (kind_) {
    case Kind::kRim:
      point_ = center_ + side_ * half_ * axis_ + radius_ * across_;
      return;
    case Kind::kBarrel:
      freedoms_ = 1;
      g_[0] = 2 * half_ * axis_;
      point_ = center_ + radius_ * across_ + (2 * t_[0] - 1) * half_ * axis_;
      return;
    case Kind::kFunnel:
      freedoms_ = 1;
      g_[0] = radius_ * across_ - 2 * half_ * axis_;
      point_ = center_ + half_ * axis_ + t_[0] * g_[0];
      bend_ *= t_[0];
      return;
    case Kind::kDisc:
      leaning_ = m - axis_.dot(m) * axis_;
      freedoms_ = 2;
      break;
    case Kind::kPolygon:
      freedoms_ = 2;
      break;
    default:
      break;
  }
  point_ = base_;
  for (std::size_t k = 0; k < freedoms_; ++k) point_ += t_[static_cast<Eigen::Index>(k)] * g_[k];
}

Mat2 SurfacePatch::curvature(const Tangents& T) const {
  switch (kind_) {
    case Kind::kEllipsoid: {
      const Tangents t = from_ball_.transpose() * T;
      const Vec2 x = t.transpose() * ball_;
      return (t.transpose() * t - x * x.transpose()) / width_;
    }
    case Kind::kRim:
    case Kind::kBarrel:
    case Kind::kFunnel: {
      const Vec2 along = T.transpose() * axis_.cross(across_);
      return bend_ * along * along.transpose();
    }
    default:
      return Mat2::Zero();
  }
}

Vec3 SurfacePatch::move(const Vec2& by) {
  t_ += by;
  const bool beyond = t_[0] < 0 || t_[0] > 1;
  switch (kind_) {
    case Kind::kCorners:
      if (freedoms_ == 2) leave_triangle();
      if (freedoms_ == 1 && (t_[0] < 0 || t_[0] > 1)) {
        if (t_[0] > 1) base_ += g_[0];
        freedoms_ = 0;
      }
      break;
    case Kind::kPolygon:
      leave_polygon();
      break;
    case Kind::kBarrel:
      if (beyond) become_rim(t_[0] > 1 ? 1 : -1);
      break;
    case Kind::kFunnel:
      if (beyond && t_[0] > 1) become_rim(-1);
      if (beyond && t_[0] < 0) {
        kind_ = Kind::kCorners;
        base_ = center_ + half_ * axis_;
        freedoms_ = 0;
      }
      break;
    case Kind::kDisc:
      if (t_.squaredNorm() > 1) {
        across_ = (t_[0] * g_[0] + t_[1] * g_[1]).normalized();
        become_rim(side_);
        if (leaning_.dot(across_) <= kAlongAxis) return kLean * across_;
      }
      break;
    default:
      break;
  }
  return Vec3::Zero();
}

void SurfacePatch::leave_triangle() {
  const Vec3 a = base_, b = base_ + g_[0], c = base_ + g_[1];
  if (t_[0] < 0)
    become_edge(a, c, t_[1]);
  else if (t_[1] < 0)
    become_edge(a, b, t_[0]);
  else if (t_[0] + t_[1] > 1)
    become_edge(b, c, 0.5 * (1 - t_[0] + t_[1]));
}

void SurfacePatch::leave_polygon() {
  const Vec3 p = base_ + t_[0] * g_[0] + t_[1] * g_[1];
  const Vec3 out_of_face = (face_[1] - face_[0]).cross(face_[2] - face_[0]);
  double farthest = 0;
  for (int i = 0; i < face_.count; ++i) {
    const Vec3 &from = face_[i], &to = face_[i + 1 == face_.count ? 0 : i + 1];
    const Vec3 along = (to - from).normalized();
    const double outside = along.cross(out_of_face).dot(p - from);
    if (outside <= farthest) continue;
    farthest = outside;
    become_edge(from, to, along.dot(p - from) / (to - from).norm());
  }
}

bool SurfacePatch::grow(const Vec3& farther) {
  switch (kind_) {
    case Kind::kRim:
      t_[0] = is_cone_ || side_ > 0 ? 1 : 0;
      kind_ = is_cone_ ? Kind::kFunnel : Kind::kBarrel;
      return true;
    case Kind::kCorners:
      if (is_cone_) {
        kind_ = Kind::kFunnel;
        t_[0] = 0;
        return true;
      }
      if (freedoms_ == 2) return false;
      g_[freedoms_] = farther - base_;
      t_[static_cast<Eigen::Index>(freedoms_++)] = 0;
      return true;
    default:
      return false;
  }
}

}  // namespace poinsot
