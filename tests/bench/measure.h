// Runs an engine over the cases and prints one CSV row per case and setting:
//
//   engine,case,setting,orientation_error_rad,position_error_m,cpu_us_per_s
//
// Errors are the largest over all outputs and bodies, against the reference file of
// write_reference. The cost is CPU time of the whole process inside advance_to, per body and
// simulated second; building the scene is not in it.

#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "cases.h"

namespace poinsot::bench {

class Simulation {
 public:
  virtual ~Simulation() = default;
  virtual void advance_to(double t) = 0;                  // [s] the next output
  virtual void read(std::vector<Pose>& poses) const = 0;  // of the bodies' centres of mass
};

// One way to run an engine. The name is the method, a space, and its step or tolerance.
struct Setting {
  std::string name;
  std::function<std::unique_ptr<Simulation>()> make;
};

// The first setting is the engine's default. An empty list: the engine has no such thing.
using Settings = std::function<std::vector<Setting>(const Case&)>;

// Options: --reference FILE, --cases a,b (default all), --limit S: settings that would need more
// CPU time than that [s] for one run are left out. Returns the exit code.
int measure(const std::string& engine, const Settings& settings, int argc, char** argv);

// Steps of fixed length in one output interval, and how a setting names them.
struct FixedStep {
  int per_frame;
  std::string name;
};
inline std::vector<FixedStep> fixed_steps(bool with_finest) {
  std::vector<FixedStep> steps = {{1, "1/60"}, {4, "1/240"}, {17, "1/1020"}};
  if (with_finest) steps.push_back({167, "1/10020"});
  return steps;
}

}  // namespace poinsot::bench
