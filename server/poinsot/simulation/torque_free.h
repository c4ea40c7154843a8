// Torque-free rotation, exact: the orientation of a free body at any later time.
//
// Set up once, from orientation and angular momentum; evaluated at any time with an error of a few
// units in the last place of a unit quaternion, whatever the time passed, the inertia or the spin
// (README.md, "Flight", states the measured bound). Evaluations do not depend on one another.
//
//   still       no spin, or one too slow to turn anything
//   spin        about a principal axis, or of a body with three equal moments: one rotation
//   top         two equal moments: a rotation about L after one about the body's axis
//   polhode     three moments: Jacobi's elliptic functions as theta series
//   separatrix  the same close to the unstable axis, as sums of Gaussians
//
// Sources: Jacobi, Sur la rotation d'un corps, 1849; van Zon, Schofield, J. Comput. Phys. 225
// (2007) 145; Celledoni et al., SIAM J. Sci. Comput. 30 (2008) 2084; Abramowitz, Stegun, 16–17.

#pragma once

#include <array>
#include <variant>

#include "poinsot/math/phase.h"
#include "poinsot/math/principal_axes.h"
#include "poinsot/math/types.h"

namespace poinsot {

class TorqueFree {
 public:
  TorqueFree() : motion_(Still{Quat::Identity()}) {}  // still, at the identity

  // q: orientation at t = 0, B → W; L [kg·m²/s] in W. body: principal axes in B.
  TorqueFree(const PrincipalAxes& body, const Quat& q, const Vec3& L);

  // Orientation at t [s], B → W, unit. Its sign is not continuous in t.
  Quat at(double t) const;

  // Largest error of at(t) [rad].
  double error(double t) const;

  template <class Archive>
  void archive(Archive& with) {
    with(motion_, rate_);
  }

 private:
  struct Still {
    Quat q;

    template <class Archive>
    void archive(Archive& with) {
      with(q);
    }
  };
  struct Spin {
    Phase half_angle;  // [turn] of half the rotation
    Vec3 axis;         // unit, in W
    Quat q;

    template <class Archive>
    void archive(Archive& with) {
      with(half_angle, axis, q);
    }
  };
  struct Top {
    Phase half_precession, half_spin;  // [turn] of half the rotations
    Vec3 axis_W, axis_B;               // unit: of L, of the body
    Quat q;

    template <class Archive>
    void archive(Archive& with) {
      with(half_precession, half_spin, axis_W, axis_B, q);
    }
  };
  // R(t) = left · Rz(ψ) · A(m̂) · right with A the shortest arc from m̂ = m/|m| to e₃, m in the
  // principal frame, m₃ > 0; exp(iψ) = exp(iλt) Θ(u + ib) (m₁ − i m₂) up to a positive factor.
  struct Frame {
    Quat left, right;
    Vec3 scale;       // of m̂₁, m̂₂, m̂₃ against their theta quotients
    double sn_scale;  // of m₂ against m₁ where only their direction counts
    Phase z;          // u in turns: z = π u / 2K for the series, u / 2K for the Gaussians
    Phase lambda;     // [turn]

    template <class Archive>
    void archive(Archive& with) {
      with(left, right, scale, sn_scale, z, lambda);
    }
  };
  struct Polhode : Frame {
    static constexpr int kTerms = 5;  // enough for a nome of ¼
    int terms;
    bool shifted;                               // θ₁ in place of θ₄ in Θ(u + ib)
    std::array<double, kTerms + 1> even, odd;   // qⁿ², qⁿ⁽ⁿ⁺¹⁾
    std::array<double, kTerms + 1> real, imag;  // of Θ(u + ib)

    template <class Archive>
    void archive(Archive& with) {
      Frame::archive(with);
      with.choice(terms, kTerms);
      with(shifted, even, odd, real, imag);
    }
  };
  struct Separatrix : Frame {
    double exponent;                   // h = exp(exponent · z), z [half turn]
    double q1, q2, q4, q6;             // powers of the complementary nome
    double beta;                       // b / K′
    std::array<double, 3> real, imag;  // of exp(iβπ(n + ½))

    template <class Archive>
    void archive(Archive& with) {
      Frame::archive(with);
      with(exponent, q1, q2, q4, q6, beta, real, imag);
    }
  };

  static Quat turn(const Frame& frame, const Vec3& m, double x, double y, double angle);
  static void evaluate(const Polhode& p, double t, Vec3& m, double& x, double& y, double& angle);
  static void evaluate(const Separatrix& p, double t, Vec3& m, double& x, double& y, double& angle);
  template <class Kind>
  static Quat orientation(const Kind& kind, double t);

  struct Setup;
  std::variant<Still, Spin, Top, Polhode, Separatrix> motion_;
  double rate_ = 0;  // [rad/s] bound of the growth of all phases, for error()
};

}  // namespace poinsot
