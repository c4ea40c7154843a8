// Runs an engine over the contact scenes and prints one CSV row per case and setting. Each row is
// measured in a process of its own, so that an engine's fault ends no more than its run; one that
// is cut at the limit prints what it has, with the simulated time that it reached.
//
// Cost is CPU time of the process inside advance_to; building the scene is not in it. Errors, per
// question:
//   stands   [m] largest displacement of a body's centre, at the end and over all outputs; extra:
//            sideways drift of the top one at the end
//   sticks   [m] largest displacement at the end of all azimuths; extra: spread over the azimuths
//   slides   [-] largest error of the place on the plane, relative to the distance; extra: spread
//            of the distance, relative
//   stops    [m] error of the place on the plane; extra: highest lift-off
//   rolls    [m] error of the place on the plane at the end; extra: error of the speed [m/s]
//   piles    none
// Penetration, kinetic energy and the lowest centre are of the final poses, by Poinsot's own gaps
// between the exact shapes, the same for all engines. Bodies that are no longer finite, or
// whose centre lies below the ground or a kilometre away, are counted as lost.

#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "contact_cases.h"

namespace poinsot::bench {

struct ContactState {
  Pose pose;                     // of the centre of mass
  Vec3 velocity = Vec3::Zero();  // [m/s] of the centre of mass, in W
  Vec3 omega = Vec3::Zero();     // [rad/s] in W
};

class ContactWorld {
 public:
  virtual ~ContactWorld() = default;
  virtual void advance_to(double t) = 0;                           // [s] the next output
  virtual void read(std::vector<ContactState>& states) const = 0;  // of the bodies that move
};

// One way to run an engine. The name is the method, a space, and its step.
struct ContactSetting {
  std::string name;
  std::function<std::unique_ptr<ContactWorld>(const ContactScene&)> make;
  bool by_wall = false;  // cost is wall time, as for several threads
};

// The first setting is the engine's default.
using ContactSettings = std::function<std::vector<ContactSetting>(const ContactCase&)>;

// Arguments: names of cases, or `accuracy`, `piles`, `all`; --wall: costs of piles are wall time;
// --limit S: CPU time of a run (default 60), which may take five times as long on a shared machine;
// --defaults: the first setting only;
// --header: the columns; --list: names of the cases instead. Returns the exit code.
int measure_contacts(const std::string& engine, const ContactSettings& settings, int argc,
                     char** argv);

}  // namespace poinsot::bench
