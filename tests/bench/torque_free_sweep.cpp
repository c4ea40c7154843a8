// Ten thousand random free bodies against the solution in extended precision: the worst error of
// the closed form after 10 s, and how far it is from the bound 1e-12 + 4 ε Φ.
//
//   bench_torque_free_sweep [bodies] [seconds]
//
// Inertia ratios to 1e6, spins 0 … 1e3 rad/s, every third body near the separatrix. Φ is ∫|ω|dt.
// It runs on all processors; 10 000 bodies take some ten minutes on two.
//
// The reference itself errs by 1e-32/k'² near the separatrix (k'² goes down to 1e-27 here) and,
// where it runs in 64 bits, by more than the bound for fast needles. Bodies beyond the bound are
// printed with their result, for torque_free_exact.py to judge in 90 digits:
//
//   bench_torque_free_sweep | tests/bench/torque_free_exact.py

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <mutex>
#include <random>
#include <thread>
#include <vector>

#include "poinsot/simulation/torque_free.h"
#include "support/extended_reference.h"
#include "support/random_bodies.h"

namespace poinsot {
namespace {

struct Worst {
  double error = 0;  // [rad]
  double ratio = 0;  // to the bound
  double error_over_phase = 0;
  int beyond = 0;
};

// judge: moments, q, L, time, result; one line, read back to the same bits.
void print(const test::RandomFreeBody& body, const Vec3& L, double seconds, const Quat& result) {
  const Vec3 J = body.J.diagonal();
  const Eigen::Vector4d q = body.q.coeffs(), r = result.coeffs();
  std::printf(
      "judge: %.17g %.17g %.17g  %.17g %.17g %.17g %.17g  %.17g %.17g %.17g  %.17g  "
      "%.17g %.17g %.17g %.17g\n",
      J[0], J[1], J[2], q[0], q[1], q[2], q[3], L[0], L[1], L[2], seconds, r[0], r[1], r[2], r[3]);
}

void measure(const test::RandomFreeBody& body, bool near_separatrix, double seconds, Worst& worst) {
  const Vec3 L = body.q * Vec3(body.J * (body.q.conjugate() * body.omega));
  test::ExtendedReference reference({.mass = 1, .J_B = body.J}, Vec3::Zero(), body.q, Vec3::Zero(),
                                    L, near_separatrix ? test::ReferenceOptions{} : test::kQuick);
  reference.advance_to(seconds);
  const TorqueFree flight(principal_axes(body.J), body.q, L);
  const double error = reference.orientation_error(flight.at(seconds));
  const double phase = reference.spin_phase();
  const double bound = 1e-12 + 4 * std::numeric_limits<double>::epsilon() * phase;
  worst.error = std::max(worst.error, error);
  worst.ratio = std::max(worst.ratio, error / bound);
  worst.error_over_phase = std::max(worst.error_over_phase, error / std::max(phase, 1.0));
  worst.beyond += error > bound ? 1 : 0;
  if (error > bound) print(body, L, seconds, flight.at(seconds));
}

void sweep(int bodies, double seconds) {
  std::vector<test::RandomFreeBody> all;
  std::mt19937_64 random(20);
  for (int n = 0; n < bodies; ++n) all.push_back(test::random_free_body(random, n));
  Worst worst[2];  // anywhere, near the separatrix
  std::mutex mutex;
  std::atomic<int> next = 0;
  {
    std::vector<std::jthread> team;
    for (unsigned t = 0; t < std::max(1u, std::thread::hardware_concurrency()); ++t)
      team.emplace_back([&] {
        for (int n = next++; n < bodies; n = next++) {
          Worst one;
          measure(all[static_cast<std::size_t>(n)], n % 3 == 0, seconds, one);
          const std::lock_guard lock(mutex);
          Worst& sum = worst[n % 3 == 0 ? 1 : 0];
          sum.error = std::max(sum.error, one.error);
          sum.ratio = std::max(sum.ratio, one.ratio);
          sum.error_over_phase = std::max(sum.error_over_phase, one.error_over_phase);
          sum.beyond += one.beyond;
        }
      });
  }
  std::printf("%d bodies, %g s\n", bodies, seconds);
  const char* const names[] = {"anywhere", "near the separatrix"};
  for (int k = 0; k < 2; ++k)
    std::printf("%-20s largest difference %.2e rad, at most %.2f of the bound, %d beyond it\n",
                names[k], worst[k].error, worst[k].ratio, worst[k].beyond);
}

}  // namespace
}  // namespace poinsot

int main(int argc, char** argv) {
  const int bodies = argc > 1 ? std::atoi(argv[1]) : 10000;
  const double seconds = argc > 2 ? std::atof(argv[2]) : 10;
  poinsot::sweep(bodies, seconds);
}
