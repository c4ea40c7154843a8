// The contact scenes: what every engine is asked to simulate. Plain data, the same for all; random
// numbers come from a fixed seed and from arithmetic that is the same everywhere. SI units, W with
// z up, bodies given at their centres of mass in principal axes.

#pragma once

#include <string>
#include <vector>

#include "poinsot/math/pose.h"
#include "poinsot/scene/shape.h"

namespace poinsot::bench {

struct ContactBody {
  Shape shape;                   // its frame's origin is the centre of mass
  double mass = 0;               // [kg]; 0 for a wall
  Vec3 moments = Vec3::Zero();   // [kg·m²] about the axes of the shape's frame
  Pose pose = {};                // in W
  Vec3 velocity = Vec3::Zero();  // [m/s] in W
};

struct ContactScene {
  double friction = 0.5;                 // [-] of every pair; restitution is 0
  Quat ground = Quat::Identity();        // the ground is the half-space below the plane through
                                         // the origin whose normal is this rotation of z
  std::vector<ContactBody> bodies = {};  // that move
  std::vector<ContactBody> walls = {};   // static boxes
};

inline constexpr double kGravity = 9.81;  // [m/s²] along −z
inline constexpr double kFrameRate = 60;  // [Hz] of outputs

// What is asked of a case; contact_measure.h says what the error is.
enum class Question { stands, sticks, slides, stops, rolls, piles };

struct ContactCase {
  std::string name;
  Question question = Question::stands;
  double duration = 10;                   // [s]
  std::vector<ContactScene> scenes = {};  // variants; the error is the worst of them

  int frames() const { return static_cast<int>(duration * kFrameRate + 0.5); }
};

inline constexpr double kSlopeAngle = 0.52359877559829887308;  // [rad] 30°, of incline_slide
inline constexpr double kStickAngle = 0.34906585039886591538;  // [rad] 20°, of incline_stick
inline constexpr double kStopSpeed = 5, kStopFriction = 0.3;   // [m/s], [-] of sliding_stop
inline constexpr double kRollSpeed = 7, kRollFriction = 0.2;   // [m/s], [-] of slip_to_roll

// Names of all cases: those of accuracy first, then the piles.
std::vector<std::string> contact_case_names();

// Builds one; throws std::runtime_error for an unknown name.
ContactCase contact_case(const std::string& name);

}  // namespace poinsot::bench
