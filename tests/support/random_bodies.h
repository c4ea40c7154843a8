// Random free bodies for sweeps: the same ones for tests and benchmarks.

#pragma once

#include <cmath>
#include <random>

#include "poinsot/math/types.h"

namespace poinsot::test {

struct RandomFreeBody {
  Mat3 J;      // [kg·m²] in B
  Quat q;      // B → W
  Vec3 omega;  // [rad/s] in W
};

// Inertia ratios to 1e6, spins 0 … 1e3 rad/s, every third near the separatrix.
inline RandomFreeBody random_free_body(std::mt19937_64& random, int n) {
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto magnitude = [&](double decades) { return std::pow(10, decades * unit(random)); };
  // Moments of a cloud: pairwise sums of three second moments.
  const Vec3 s(magnitude(3), magnitude(3), magnitude(3));
  RandomFreeBody sample;
  sample.J = Vec3(s[1] + s[2], s[2] + s[0], s[0] + s[1]).asDiagonal();
  sample.q = n % 2 == 0 ? Quat::Identity()
                        : Quat(unit(random), unit(random), unit(random), unit(random)).normalized();
  Vec3 omega(unit(random), unit(random), unit(random));
  if (n % 3 == 0) {
    // About the middle axis but for a little: k′² from 1e-2 down to 1e-26.
    Eigen::Index low, high;
    const Vec3 moments = sample.J.diagonal();
    moments.minCoeff(&low);
    moments.maxCoeff(&high);
    const Eigen::Index middle = 3 - low - high;
    if (low != high) {
      const double little = magnitude(6.5) * std::pow(10, -6.5);
      omega = Vec3::Constant(little).cwiseProduct(omega);
      omega[middle] = 1;
    }
  }
  omega.normalize();
  // [rad/s] to 1e3; near the separatrix, where the reference is dear, to 30.
  omega *=
      n % 50 == 0 ? 0.0 : std::pow(10, n % 3 == 0 ? 0.5 + unit(random) : 1.5 + 1.5 * unit(random));
  sample.omega = sample.q * omega;
  return sample;
}

}  // namespace poinsot::test
