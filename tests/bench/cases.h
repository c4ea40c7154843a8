// The cases of speed against error: what every engine is asked to simulate. Plain data, the same
// for all; random numbers come from a fixed seed and from arithmetic that is the same everywhere.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "poinsot/math/pose.h"

namespace poinsot::bench {

struct CaseBody {
  double mass = 1;               // [kg]
  Vec3 moments = Vec3(1, 2, 3);  // [kg·m²] principal, along the axes of B
  Pose pose = {};                // of the centre of mass in W, axes of B
  Vec3 velocity = Vec3::Zero();  // [m/s] in W
  Vec3 omega = Vec3::Zero();     // [rad/s] in W
};

// Force −stiffness (c − anchor) on the centre of mass.
struct CaseSpring {
  double stiffness = 0;          // [N/m]
  Vec3 anchor_W = Vec3::Zero();  // [m]
};

// What acts is the same for all bodies of a case.
struct Case {
  std::string name;
  double duration = 20;          // [s]
  double frame_rate = 60;        // [Hz] of outputs
  Vec3 gravity = Vec3::Zero();   // [m/s²] in W
  Vec3 torque_W = Vec3::Zero();  // [N·m] constant in W
  Vec3 force_B = Vec3::Zero();   // [N] at the centre of mass, constant in B
  double drag = 0;               // [N·s/m] force −drag v on the centre of mass
  std::optional<CaseSpring> spring = std::nullopt;
  std::vector<CaseBody> bodies = {};

  int frames() const { return static_cast<int>(duration * frame_rate + 0.5); }
  bool has_wrench() const { return !torque_W.isZero(0) || !force_B.isZero(0); }
};

// racket, tumble, crowd, pushed, falling, spring.
const std::vector<Case>& cases();

}  // namespace poinsot::bench
