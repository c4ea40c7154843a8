#include "poinsot/contact/single_impact.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "poinsot/contact/slip.h"

namespace poinsot {
namespace {

using Vec2 = Eigen::Vector2d;

constexpr double kEndless = std::numeric_limits<double>::infinity();

// Where slip leads from rest: f = −μ θ with Atn − μ Att θ = κ θ, κ > 0, |θ| = 1. There is one κ,
// found by Newton on 1/|θ(κ)| − 1, which is concave: the steps come from below and never overshoot.
Vec2 slip_from_rest(const Eigen::Matrix2d& Att, const Vec2& Atn, double friction) {
  double kappa = 0;
  Vec2 theta = Vec2::Zero();
  for (int i = 0; i < 60; ++i) {
    const Eigen::Matrix2d inverse =
        (friction * Att + kappa * Eigen::Matrix2d::Identity()).inverse();
    theta = inverse * Atn;
    const double length = theta.norm();
    const double step = (length - 1) * length * length / theta.dot(inverse * theta);
    if (!(step > 1e-16 * kappa)) break;
    kappa += step;
  }
  return -friction * theta.normalized();
}

}  // namespace

std::optional<Vec3> single_impact(const Mat3& A, const Vec3& u, double restitution,
                                  double friction) {
  if (!(u.z() < 0)) return Vec3::Zero();
  Slip slip(A, u, restitution * restitution);
  if (!(friction > 0)) return Vec3(0, 0, (1 + restitution) * -u.z() / A(2, 2));
  if (slip.tangential.norm() > 0) {
    const Slip::End end = slip.until_it_ends(friction);
    if (end == Slip::End::kLost) return std::nullopt;
    if (end == Slip::End::kImpactOver) return slip.impulse(friction);
  }
  const Eigen::Matrix2d Att = A.topLeftCorner<2, 2>();
  const Vec2 Atn = A.topRightCorner<2, 1>();
  Vec2 force = -(Att.inverse() * Atn);
  if (force.norm() > friction) force = slip_from_rest(Att, Atn, friction);
  if (!slip.straight(force, kEndless)) return std::nullopt;
  return slip.impulse(friction);
}

}  // namespace poinsot
