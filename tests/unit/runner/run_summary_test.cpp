#include "poinsot/runner/run_summary.h"

#include <gtest/gtest.h>

namespace poinsot {
namespace {

RunSummary example() {
  RunSummary s;
  s.frames = 600;
  s.sim_time = 10;
  s.wall_s = 0.25;
  s.times.presentation.cpu_s = 0.5;
  s.times.collision.cpu_s = 1;
  s.times.contact.cpu_s = 2;
  s.times.simulation.cpu_s = 4;
  s.times.publishing.cpu_s = 8;
  s.last.bodies = 12;
  s.last.energy_error = 1.5e-6;
  s.last.momentum_error = 2.5e-14;
  s.last.position_error = 3.5e-15;
  s.last.orientation_error = 4.5e-16;
  s.last.methods = {1, 8, 3};
  s.last.impacts_so_far = 227;
  s.last.islands = 2;
  s.last.restarts = 3;
  s.last.impact_searches = 4;
  s.last.asleep = 5;
  s.last.contacts = 48;
  s.last.soft_bodies = 6;
  s.last.direct_bodies = 7;
  s.last.solver_iterations = 8;
  s.last.unconverged = 9;
  s.last.contact_residual = 5.5e-4;
  s.last.max_penetration = 6.5e-5;
  s.last.flags = FrameFlag::crowded;
  s.state_hash = 0xabcdef;
  return s;
}

TEST(RunSummary, JsonIsOneLineWithTheHashInSixteenDigits) {
  EXPECT_EQ(
      to_json(example()),
      "{\"frames\": 600, \"sim_time\": 10, \"wall_s\": 0.25, \"cpu_s\": {\"presentation\": "
      "0.5, \"collision\": 1, \"contact\": 2, \"simulation\": 4, \"publishing\": 8}, "
      "\"bodies\": 12, \"energy_error\": 1.5e-06, \"momentum_error\": 2.5e-14, "
      "\"position_error\": 3.5e-15, \"orientation_error\": 4.5e-16, \"impacts\": 227, \"islands\": "
      "2, "
      "\"restarts\": 3, \"impact_searches\": 4, \"asleep\": 5, \"crowded\": true, "
      "\"soft_bodies\": 6, \"direct_bodies\": 7, \"solver_iterations\": 8, \"unconverged\": 9, "
      "\"contact_residual\": 0.00055, \"max_penetration\": 6.5e-05, \"methods\": "
      "{\"none\": 1, "
      "\"flight\": 8, \"taylor\": 3, \"dop853\": 0, \"dopri5\": 0, \"rosenbrock\": 0, \"rk4\": 0, "
      "\"semi_implicit_euler\": 0, \"explicit_euler\": 0}, \"state_hash\": "
      "\"0000000000abcdef\"}\n");
}

TEST(RunSummary, TextNamesEveryFigure) {
  const std::string text = to_text(example());
  for (const char* part :
       {"600", "10 s", "0.25 s", "factor 40", "presentation 0.5 s", "publishing 8 s",
        "12: flight 8, taylor 3\n",
        "227; last frame: 2 islands, 3 restarts, 4 searches, 5 asleep\n",
        "contacts      48, deepest 6.5e-05 m",
        "6 bodies soft_step, 7 convex_newton in 8 iterations,\n",
        "              9 unconverged, residual 0.00055 m/s\n", "energy error  1.5e-06\n",
        "momentum      error 2.5e-14\n", "3.5e-15 m, 4.5e-16 rad", "0000000000abcdef"})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
}

TEST(RunSummary, AnEmptyRunHasNoInfiniteFactor) {
  EXPECT_NE(to_text({}).find("real-time factor 0)"), std::string::npos);
}

}  // namespace
}  // namespace poinsot
