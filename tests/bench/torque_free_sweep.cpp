// Ten thousand random free bodies against the solution in extended precision: the worst error of
// the closed form after 10 s, and how far it is from the bound 1e-12 + 4 ε Φ.
//
//   bench_torque_free_sweep [bodies] [seconds]
//
// Inertia ratios to 1e6, spins 0 … 1e3 rad/s, every third body near the separatrix. Φ is ∫|ω|dt.
// It runs on all processors; 10 000 bodies take some ten minutes on two.

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
    std::printf("%-20s worst error %.2e rad, at most %.2f of the bound, %d beyond it\n", names[k],
                worst[k].error, worst[k].ratio, worst[k].beyond);
}

}  // namespace
}  // namespace poinsot

int main(int argc, char** argv) {
  const int bodies = argc > 1 ? std::atoi(argv[1]) : 10000;
  const double seconds = argc > 2 ? std::atof(argv[2]) : 10;
  poinsot::sweep(bodies, seconds);
}
