// The exact rotation against a reference of 113 bits, and against what closed forms say.

#include "poinsot/simulation/torque_free.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "poinsot/math/rotation.h"
#include "support/extended_reference.h"

namespace poinsot {
namespace {

using test::ExtendedReference;
using test::ReferenceBody;

struct Rotation {
  Mat3 J;
  Vec3 L;                     // [kg·m²/s] in W
  Quat q = Quat::Identity();  // at t = 0
};

// ω₀ in the axes of J, at the identity.
Rotation spinning(const Vec3& moments, const Vec3& omega) {
  return {moments.asDiagonal(), moments.cwiseProduct(omega)};
}

TorqueFree torque_free(const Rotation& r) {
  return {principal_axes(r.J), r.q, r.L};
}

double largest_spin(const Rotation& r) {
  return r.L.norm() / static_cast<double>(principal_axes(r.J).moments[0]);
}

// The bound that is promised, and that it is worth having: 1e-14 rad and 2e-18 of the phase.
// `growth` [1/s]: rate at which neighbours part, which the reference's own rounding suffers from.
void expect_exact(const Rotation& r, const std::vector<double>& times, double growth = 0) {
  ReferenceBody body;
  body.J_B = r.J;
  ExtendedReference reference(body, Vec3::Zero(), r.q, Vec3::Zero(), r.L);
  const TorqueFree rotation = torque_free(r);
  double worst = 0;
  for (const double t : times) {
    reference.advance_to(t);
    const double of_reference = 1e-32 * std::exp(growth * t);
    ASSERT_LE(of_reference, 1e-16);
    const double error = reference.orientation_error(rotation.at(t));
    EXPECT_LE(error, rotation.error(t) + of_reference) << "at " << t << " s";
    EXPECT_NEAR(rotation.at(t).norm(), 1, 6.7e-16);  // a product of three: 3 ε
    worst = std::max(worst, error / rotation.error(t));
  }
  EXPECT_LE(rotation.error(times.back()), 1e-14 + 2e-18 * largest_spin(r) * times.back());
  testing::Test::RecordProperty("worst_over_bound", std::to_string(worst));
}

std::vector<double> every(double step, double end) {
  std::vector<double> times;
  for (int n = 1; n * step <= end * (1 + 1e-9); ++n) times.push_back(n * step);
  return times;
}

TEST(TorqueFree, FollowsAGenericBody) {
  expect_exact(spinning({1, 2, 3}, {1, 3, 2}), every(0.5, 20));
}

TEST(TorqueFree, FollowsTheTennisRacket) {
  expect_exact(spinning({1, 2, 3}, {1e-3, 5, 1e-3}), every(1.0 / 7, 20));
}

TEST(TorqueFree, FollowsEveryOrderOfTheMoments) {
  for (const Vec3& moments :
       {Vec3(1, 2, 3), Vec3(1, 3, 2), Vec3(2, 1, 3), Vec3(2, 3, 1), Vec3(3, 1, 2), Vec3(3, 2, 1)})
    for (const Vec3& omega : {Vec3(1, 3, 2), Vec3(-2, 0.5, -1)})
      expect_exact(spinning(moments, omega), every(0.7, 4.2));
}

// Both sides of the separatrix and both directions along each axis.
TEST(TorqueFree, FollowsEveryBranchOfTheMotion) {
  for (const double s1 : {-1.0, 1.0})
    for (const double s2 : {-1.0, 1.0})
      for (const double s3 : {-1.0, 1.0})
        for (const Vec3& size : {Vec3(3, 0.6, 0.8), Vec3(0.5, 0.6, 2)})
          expect_exact(spinning({1, 2, 3}, {s1 * size.x(), s2 * size.y(), s3 * size.z()}),
                       every(0.9, 2.7));
}

// k'² about δ²: turned over once after ln(4/k')/λ, λ = 2.9/s.
TEST(TorqueFree, PassesTheUnstableAxisHoweverClose) {
  const double lambda = 5 / std::sqrt(3.0);
  for (const double delta : {1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13, 1e-30, 1e-90, 1e-150}) {
    expect_exact(spinning({1, 2, 3}, {delta, 5, 0.3 * delta}), every(1.1, 12), lambda);
    expect_exact(spinning({1, 2, 3}, {-0.2 * delta, -5, delta}), every(1.1, 12), lambda);
  }
}

// On the separatrix itself m₃² = 3 m₁² (moments 1, 2, 3): solutions of Pell's equation a² − 3b² = 1
// come as close as integers of 53 bits can, with k'² about 1/a² by cancellation.
TEST(TorqueFree, FollowsTheSeparatrixThatCancellationLeaves) {
  long long a = 2, b = 1;
  while (a < (1LL << 46)) {
    const long long next = 2 * a + 3 * b;
    b = a + 2 * b;
    a = next;
    if (a < 1000) continue;
    const double scale = std::ldexp(1.0, -std::ilogb(static_cast<double>(b)));
    const double m1 = scale * static_cast<double>(b), m3 = scale * static_cast<double>(a);
    const double lambda = std::hypot(m1, 3.0, m3) / 2 / std::sqrt(3.0);
    expect_exact({Vec3(1, 2, 3).asDiagonal(), {m1, 3, m3}}, every(1.3, 9.1), lambda);
  }
}

TEST(TorqueFree, FollowsTops) {
  expect_exact(spinning({2, 2, 1}, {1, 0.5, 3}), every(1.7, 17));
  expect_exact(spinning({2, 2, 3.5}, {1, 0.5, -3}), every(1.7, 17));
  expect_exact(spinning({1, 2, 2}, {1, -0.5, 3}), every(1.7, 17));
  expect_exact(spinning({3.5, 2, 2}, {0, 0.5, 3}), every(1.7, 17));
}

TEST(TorqueFree, FollowsBodiesThatAreNearlyTops) {
  for (const double gap : {1e-3, 1e-9, 1e-12, 5e-16})
    for (const Vec3& moments :
         {Vec3(2, 2 * (1 + gap), 3), Vec3(1, 2, 2 * (1 + gap)), Vec3(3, 1, 3 * (1 + gap)),
          Vec3(2, 2 * (1 + gap), 2 * (1 + 3 * gap))})
      expect_exact(spinning(moments, {0.4, 1, -0.7}), {1.0, 5.0, 10.0});
}

TEST(TorqueFree, FollowsASphere) {
  expect_exact(spinning({2, 2, 2}, {0.4, 3, -0.7}), every(2, 20));
}

TEST(TorqueFree, FollowsPureSpinAboutEachAxis) {
  for (const Vec3& moments : {Vec3(1, 2, 3), Vec3(2, 2, 3)})
    for (int k = 0; k < 3; ++k)
      for (const double spin : {-5.0, 5.0})
        expect_exact(spinning(moments, spin * Vec3::Unit(k)), {1.0, 4.0, 10.0});
}

TEST(TorqueFree, FollowsNeedlesAndDiscs) {
  expect_exact(spinning({1e-6, 1, 1 + 5e-7}, {3, 1, 2}), every(1.3, 13));
  expect_exact(spinning({1e-6, 1, 1}, {3, 1, 2}), every(1.3, 13));
  expect_exact(spinning({1, 1e-6, 1 + 1e-6}, {1, 100, 2}), every(0.5, 2));  // a flat needle
  expect_exact(spinning({1e-6, 1, 1 + 5e-7}, {300, 0.1, 2}), every(0.3, 1));
  expect_exact(spinning({1, 1 + 1e-6, 2 + 1e-6}, {3, 1, 2}), every(1.3, 13));  // a disc
  expect_exact(spinning({1, 1, 2}, {3, 1, 2}), every(1.3, 13));
}

TEST(TorqueFree, FollowsObliqueBodiesFromAnyOrientation) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < 24; ++i) {
    const auto turn = [&] {
      return Quat(normal(random), normal(random), normal(random), normal(random)).normalized();
    };
    const double a = 0.2 + unit(random), b = 0.2 + unit(random);
    const double c = std::abs(a - b) + 1e-3 + unit(random) * (a + b - std::abs(a - b) - 1e-3);
    const Mat3 R = turn().toRotationMatrix();
    const Mat3 J = R * Vec3(a, b, c).asDiagonal() * R.transpose();
    const Vec3 L(normal(random), normal(random), normal(random));
    expect_exact({(J + J.transpose()) / 2, L, turn()}, {0.5, 2.0, 6.0});
  }
}

TEST(TorqueFree, StaysWhereItIsWithoutSpin) {
  const Quat q = Quat(0.1, 0.2, -0.3, 0.9).normalized();
  for (const double spin : {0.0, 1e-310, 5e-324}) {
    const Rotation still{Vec3(1, 2, 3).asDiagonal(), spin * Vec3(1, 1, 1), q};
    for (const double t : {0.0, 1.0, 1e9})
      EXPECT_LE(angle_between(torque_free(still).at(t), q), 2e-16 + 2 * spin * t);
  }
}

// The smallest moment of an oblique needle is a difference of entries a million times as large.
TEST(TorqueFree, FollowsObliqueNeedles) {
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  for (const double ratio : {1e2, 1e4, 1e6})
    for (int i = 0; i < 4; ++i) {
      const Mat3 R = Quat(normal(random), normal(random), normal(random), normal(random))
                         .normalized()
                         .toRotationMatrix();
      const Mat3 J = R * Vec3(1 / ratio, 1, 1 + 0.5 / ratio).asDiagonal() * R.transpose();
      expect_exact({(J + J.transpose()) / 2, J * (R * Vec3(3, 1, 2))}, {1.0, 10.0});
    }
}

// Twice the spin is twice the rate: a power of two changes nothing but exponents.
TEST(TorqueFree, ScalesFromSlowestToFastestSpin) {
  const Rotation unit = spinning({1, 2, 3}, {1, 3, 2});
  for (const int exponent : {-180, -100, -30, 10, 30, 100}) {
    Rotation scaled = unit;
    scaled.L *= std::ldexp(1.0, exponent);
    for (const double t : {0.3, 2.0, 11.0})
      EXPECT_LE(
          angle_between(torque_free(scaled).at(std::ldexp(t, -exponent)), torque_free(unit).at(t)),
          1e-15)
          << exponent;
  }
}

TEST(TorqueFree, FollowsHugeSpin) {
  expect_exact(spinning({1, 2, 3}, {500, 700, 510}), {0.1, 0.3});
  expect_exact(spinning({1, 2, 3}, {1, 1000, 1}), {0.02, 0.06}, 1000 / std::sqrt(3.0));
}

// After 1e4 rad and more the reference of 64 bits is left with 1e-19 of the phase squared.
TEST(TorqueFree, FollowsHugeSpinForALongTime) {
  const Rotation r = spinning({1, 2, 3}, {500, 700, 510});
  ReferenceBody body;
  body.J_B = r.J;
  ExtendedReference quick(body, Vec3::Zero(), r.q, Vec3::Zero(), r.L, test::kQuick);
  quick.advance_to(10);
  const double of_reference = 1e-19 * quick.spin_phase() * quick.spin_phase();
  const TorqueFree rotation = torque_free(r);
  EXPECT_LE(quick.orientation_error(rotation.at(10)), rotation.error(10) + of_reference);
  RecordProperty("error", std::to_string(1e12 * quick.orientation_error(rotation.at(10))) + "e-12");
}

TEST(TorqueFree, IsTheSameInWhateverOrderItIsAsked) {
  for (const Vec3& omega : {Vec3(1, 3, 2), Vec3(1e-3, 5, 1e-3), Vec3(1e-12, 5, 1e-12)}) {
    const TorqueFree rotation = torque_free(spinning({1, 2, 3}, omega));
    std::vector<Quat> forward;
    for (int n = 0; n < 500; ++n) forward.push_back(rotation.at(0.1 * n));
    for (int n = 499; n >= 0; --n) {
      const Quat q = rotation.at(0.1 * n);
      const Quat& before = forward[static_cast<std::size_t>(n)];
      ASSERT_EQ(std::memcmp(q.coeffs().data(), before.coeffs().data(), sizeof q), 0);
    }
  }
}

TEST(TorqueFree, StartsAtItsStart) {
  const Quat q = Quat(0.1, 0.2, -0.3, 0.9).normalized();
  for (const Vec3& omega :
       {Vec3(1, 3, 2), Vec3(1e-3, 5, 1e-3), Vec3(1e-12, 5, 1e-12), Vec3(5, 0, 0), Vec3(0, 0, 0)})
    for (const Vec3& moments : {Vec3(1, 2, 3), Vec3(2, 2, 1), Vec3(2, 2, 2)}) {
      Rotation r = spinning(moments, omega);
      r.q = q;
      EXPECT_LE(angle_between(torque_free(r).at(0), q), torque_free(r).error(0));
    }
}

// What was, by turning back: the motion with −L from the end leads to the start.
TEST(TorqueFree, GoesBackInTime) {
  const Rotation r = spinning({1, 2, 3}, {1, 3, 2});
  const TorqueFree rotation = torque_free(r);
  const TorqueFree reversed = torque_free({r.J, -r.L, r.q});
  for (const double t : {0.5, 3.0, 50.0})
    EXPECT_LE(angle_between(rotation.at(-t), reversed.at(t)),
              rotation.error(t) + reversed.error(t));
}

}  // namespace
}  // namespace poinsot
