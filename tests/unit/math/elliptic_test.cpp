#include "poinsot/math/elliptic.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

namespace poinsot {
namespace {

constexpr long double kPi = std::numbers::pi_v<long double>;
constexpr long double kPromise = 1e-18L;  // relative, of both headers' functions

long double relative(long double a, long double b) {
  return std::abs(a / b - 1);
}

TEST(CompleteK, IsTheTextbooksNumber) {
  EXPECT_LE(relative(complete_elliptic_k(1), kPi / 2), kPromise);
  // K(1/√2) = Γ(¼)²/(4 √π). Abramowitz, Stegun 17.3
  EXPECT_LE(relative(complete_elliptic_k(std::sqrt(0.5L)), 1.854074677301371918433850347195L),
            kPromise);
  // K(k) of k = sin 75°: 2.768063145368767697… (Abramowitz, Stegun, table 17.1, and by AGM)
  EXPECT_LE(relative(complete_elliptic_k(std::cos(5 * kPi / 12)),
                     std::sqrt(3.0L) * complete_elliptic_k(std::sin(5 * kPi / 12))),
            2 * kPromise);  // the third singular value: K(sin 75°) = √3 K(cos 75°)
}

// The C library's own is right to a few 1e-19 away from k = 1.
TEST(CompleteK, AgreesWithTheStandardLibrary) {
  long double worst = 0;
  for (int i = 0; i < 990; ++i) {
    const long double k = 1e-3L * i;
    const long double ours = complete_elliptic_k(std::sqrt((1 - k) * (1 + k)));
    worst = std::max(worst, relative(ours, std::comp_ellint_1(k)));
  }
  EXPECT_LE(worst, 5e-18L);
  RecordProperty("worst_1e-19", std::to_string(static_cast<double>(worst * 1e19L)));
}

// K = ln(4/k′) + (ln(4/k′) − 1) k′²/4 + O(k′⁴ ln k′). Abramowitz, Stegun 17.3.26
TEST(CompleteK, GrowsAsTheLogarithmOfTheComplement) {
  for (int e = 5; e <= 50; ++e) {
    const long double complement = std::pow(10.0L, -e);
    const long double log4 = std::log(4 / complement);
    const long double expected = log4 + (log4 - 1) * complement * complement / 4;
    EXPECT_LE(relative(complete_elliptic_k(complement), expected), kPromise) << e;
  }
}

// Legendre's relation needs E; E(k) = K − (K/2) Σ 2ⁿ cₙ² by the same means (A&S 17.6.4).
long double complete_e(long double k, long double k_complement) {
  long double a = 1, b = k_complement, c = k, sum = k * k, weight = 1;
  while (std::abs(c) > 1e-12L) {
    const long double next = (a + b) / 2;
    c = (a - b) / 2;
    b = std::sqrt(a * b);
    a = next;
    weight *= 2;
    sum += weight * c * c;
  }
  return kPi / (2 * a) * (1 - sum / 2);
}

TEST(CompleteK, FulfilsLegendresRelation) {
  for (int i = 1; i < 100; ++i) {
    const long double phi = kPi / 2 * 0.01L * i;
    const long double k = std::sin(phi), kc = std::cos(phi);
    const long double K = complete_elliptic_k(kc), K_prime = complete_elliptic_k(k);
    const long double E = complete_e(k, kc), E_prime = complete_e(kc, k);
    // E is a difference: it costs up to a digit where K is large.
    EXPECT_LE(std::abs(E * K_prime + E_prime * K - K * K_prime - kPi / 2), 10 * kPromise * K) << i;
  }
}

TEST(IncompleteF, IsTheAngleWithoutAModulus) {
  for (int i = -99; i < 100; ++i) {
    const long double phi = kPi / 2 * 0.01L * i;
    const long double F = incomplete_elliptic_f(std::sin(phi), std::cos(phi), 1);
    EXPECT_LE(std::abs(F - phi), 2 * kPromise * (1 + std::abs(phi))) << i;
  }
}

// F(φ, 1) is the inverse Gudermannian artanh(sin φ).
TEST(IncompleteF, IsTheInverseGudermannianAtModulusOne) {
  for (int i = 1; i < 100; ++i) {
    const long double phi = kPi / 2 * 0.01L * i;
    const long double c = std::cos(phi);
    const long double F = incomplete_elliptic_f(std::sin(phi), c, c * c);
    EXPECT_LE(relative(F, std::asinh(std::tan(phi))), 3 * kPromise) << i;
  }
}

TEST(IncompleteF, AgreesWithTheStandardLibrary) {
  long double worst = 0;
  for (int i = 1; i < 20; ++i)
    for (int j = 1; j < 20; ++j) {
      const long double phi = kPi / 2 * 0.05L * i, k = 0.05L * j;
      const long double s = std::sin(phi);
      const long double F = incomplete_elliptic_f(s, std::cos(phi), (1 - k * s) * (1 + k * s));
      worst = std::max(worst, relative(F, std::ellint_1(k, phi)));
    }
  EXPECT_LE(worst, 1e-17L);
  RecordProperty("worst_1e-19", std::to_string(static_cast<double>(worst * 1e19L)));
}

// F(π/2, k) = K, with dn² = k′² however small.
TEST(IncompleteF, EndsAtTheCompleteIntegral) {
  for (const long double complement : {1.0L, 0.5L, 1e-3L, 1e-6L, 1e-10L, 1e-13L, 1e-20L, 1e-50L})
    EXPECT_LE(relative(incomplete_elliptic_f(1, 0, complement * complement),
                       complete_elliptic_k(complement)),
              2 * kPromise)
        << static_cast<double>(complement);
}

// F(φ) + F(ψ) = K where tan φ tan ψ = 1/k′ (Abramowitz, Stegun 17.4.13): both sides of the turn.
TEST(IncompleteF, AddsUpToTheCompleteIntegral) {
  for (const long double kc : {0.9L, 0.1L, 1e-3L, 1e-8L, 1e-13L})
    for (const long double tangent : {1e-3L, 0.1L, 1.0L, 30.0L, 1e4L}) {
      const auto of_tangent = [kc](long double opposite, long double adjacent) {
        const long double r = std::hypot(opposite, adjacent);
        const long double s = opposite / r, c = adjacent / r;
        return incomplete_elliptic_f(s, c, c * c + kc * kc * s * s);
      };
      const long double sum = of_tangent(tangent, 1) + of_tangent(1, kc * tangent);
      EXPECT_LE(relative(sum, complete_elliptic_k(kc)), 4 * kPromise)
          << static_cast<double>(kc) << " " << static_cast<double>(tangent);
    }
}

}  // namespace
}  // namespace poinsot
