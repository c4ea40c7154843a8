// An ellipsoid that rolls on the plane z = 0 without slipping, by its own equations: what bodies on
// contacts are measured against. Vectors are in the body's frame but for what is said.
//
//   (J + m (r² − r rᵀ)) ω′ = −ω × Jω + m r × (g n − ω × (r′ + ω × r)),   n′ = −ω × n
//
// r from the mass centre to the point of contact, n the upward normal; the mass centre has the
// velocity −ω × r. Fourth-order Runge–Kutta. Source: Kane, Levinson, Realistic Mathematical
// Modeling of the Rattleback, Int. J. Non-Linear Mechanics 17 (1982) 175.

#pragma once

#include <cmath>

#include "poinsot/math/types.h"

namespace poinsot::test {

struct RollingEllipsoid {
  double mass;     // [kg]
  Mat3 J;          // [kg·m²] about the mass centre
  Vec3 semi_axes;  // [m]
  Vec3 centre;     // [m] of the ellipsoid, from the mass centre
  double gravity;  // [m/s²]

  struct State {
    Vec3 omega;  // [rad/s]
    Vec3 up;     // n
  };

  Vec3 arm(const Vec3& n) const {
    const Vec3 An = semi_axes.cwiseAbs2().cwiseProduct(n);
    return centre - An / std::sqrt(n.dot(An));
  }

  State rate(const State& y) const {
    const Vec3 A = semi_axes.cwiseAbs2(), &n = y.up, &w = y.omega;
    const Vec3 An = A.cwiseProduct(n), dn = -w.cross(n), dAn = A.cwiseProduct(dn);
    const double s = std::sqrt(n.dot(An));
    const Vec3 r = arm(n), dr = -dAn / s + An * (n.dot(dAn) / (s * s * s));
    const Mat3 M = J + mass * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
    const Vec3 force = gravity * n - w.cross(dr + w.cross(r));
    return {M.ldlt().solve(Vec3(-w.cross(J * w) + mass * r.cross(force))), dn};
  }

  State step(const State& y, double h) const {
    const auto moved = [&](const State& k, double f) {
      return State{y.omega + f * k.omega, y.up + f * k.up};
    };
    const State k1 = rate(y), k2 = rate(moved(k1, h / 2)), k3 = rate(moved(k2, h / 2)),
                k4 = rate(moved(k3, h));
    State next{y.omega + h / 6 * (k1.omega + 2 * k2.omega + 2 * k3.omega + k4.omega),
               y.up + h / 6 * (k1.up + 2 * k2.up + 2 * k3.up + k4.up)};
    next.up.normalize();
    return next;
  }

  double energy(const State& y) const {  // [J]
    const Vec3 r = arm(y.up), v = -y.omega.cross(r);
    return 0.5 * mass * v.squaredNorm() + 0.5 * y.omega.dot(J * y.omega) -
           mass * gravity * r.dot(y.up);
  }
};

}  // namespace poinsot::test
