// A client's force and torque on one body, and its answer.
//
// What it acts on and when: the force acts at a body-fixed point (the centre of mass by default),
// in axes of W or of B, from one frame to another, both named by the reply. A point becomes
// body-fixed when the command is accepted; a force in W stays constant in W while the body turns, a
// force in B turns with it. Commands of one body add up.
//
// (client, seq) is the command's identity: the same pair is answered again and not applied again,
// so that a client may resend until it hears. seq starts at 1.

#pragma once

#include <cstdint>
#include <string>

#include "poinsot/base/body_id.h"
#include "poinsot/base/limits.h"
#include "poinsot/math/types.h"
#include "poinsot/protocol/result.h"
#include "poinsot/scene/scene.h"

namespace poinsot {

enum class Hold : std::uint8_t {
  frame = 0,          // one frame
  duration = 1,       // duration_ns of simulated time, rounded up to frames
  until_cleared = 2,  // until this client clears it
  clear = 3,          // not a wrench: ends all that this client holds on the body
};

struct WrenchCommand {
  std::uint64_t client = 0;    // chosen by the client, unique on the bus
  std::uint64_t seq = 0;       // counts the client's commands and controls
  std::uint32_t epoch = 0;     // run that it is meant for; 0: whichever runs
  BodyId body = {};            // none: by name
  std::string body_name = {};  // used when `body` is none
  Vec3 force = Vec3::Zero();   // [N]
  Vec3 torque = Vec3::Zero();  // [N·m] about the point of action's own axes: a free couple
  Axes axes = Axes::world;     // of force and torque
  Vec3 point = Vec3::Zero();   // [m] in the frame of point_frame; ignored at the centre of mass
  PointFrame point_frame = PointFrame::center_of_mass;
  Hold hold = Hold::frame;
  std::int64_t duration_ns = 0;   // [ns] simulated time, for Hold::duration
  std::uint64_t start_frame = 0;  // first frame of effect; 0: the next
};

// The answer to a command or a control.
struct Reply {
  std::uint64_t client = 0;
  std::uint64_t seq = 0;
  std::uint32_t epoch = 0;  // of the run that answered
  ResultCode code = ResultCode::ok;
  std::string message = {};       // why, in words; empty when all is well
  std::uint64_t first_frame = 0;  // first and last frame of effect; for a control the frame reached
  std::uint64_t last_frame = 0;   // kForever: until cleared
  std::uint64_t state_hash = 0;   // after a control: hash of the frame reached
};

inline constexpr std::uint64_t kForever = UINT64_MAX;

}  // namespace poinsot
