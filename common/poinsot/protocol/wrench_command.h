// What a client does to one body, and its answer.
//
//   force    a force and a torque, from one frame to another
//   impulse  an impulse and an angular impulse, at the start of one frame
//   tether   a spring with damping from a point of the body to a point in W that it is dragged to;
//            from one frame to another. F = stiffness (target − x) − damping x′ at the point x.
//
// It acts at a body-fixed point (the centre of mass by default), in axes of W or of B; the reply
// names the first and the last frame of effect. A point becomes body-fixed when the command is
// accepted; a force in W stays constant in W while the body turns, a force in B turns with it. What
// several commands do to one body adds up.
//
// A command with a slot replaces what the same client holds in that slot, from its first frame on,
// on whatever body: so a moving target or a joystick is one command after another in one slot. Slot
// 0 is none: the command stands for itself and replaces nothing.
//
// (client, seq) is the command's identity: the same pair is answered again and not applied again,
// so that a client may resend until it hears. seq starts at 1.

#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "poinsot/base/body_id.h"
#include "poinsot/base/limits.h"
#include "poinsot/base/names.h"
#include "poinsot/math/types.h"
#include "poinsot/protocol/result.h"
#include "poinsot/scene/scene.h"

namespace poinsot {

enum class WrenchKind : std::uint8_t { force = 0, impulse = 1, tether = 2 };

inline constexpr std::array<Named<WrenchKind>, 3> kWrenchKindNames = {{
    {"force", WrenchKind::force},
    {"impulse", WrenchKind::impulse},
    {"tether", WrenchKind::tether},
}};

enum class Hold : std::uint8_t {
  frame = 0,          // one frame; an impulse is always that
  duration = 1,       // duration_ns of simulated time, rounded up to frames
  until_cleared = 2,  // until this client clears or replaces it
  clear = 3,          // not a wrench: ends what this client holds, see below
};

// A clear ends what the client holds on the body, or on all bodies if none is named; of that, what
// is in `slot`, or all if it is 0. From its first frame of effect on.
struct WrenchCommand {
  std::uint64_t client = 0;    // chosen by the client, unique on the bus
  std::uint64_t seq = 0;       // counts the client's commands and controls
  std::uint32_t epoch = 0;     // run that it is meant for; 0: whichever runs
  std::uint32_t slot = 0;      // of the client; 0: none
  BodyId body = {};            // none: by name
  std::string body_name = {};  // used when `body` is none
  WrenchKind kind = WrenchKind::force;
  Vec3 force = Vec3::Zero();   // [N]; of an impulse [N·s]; of a tether unused
  Vec3 torque = Vec3::Zero();  // [N·m] a free couple; of an impulse [N·m·s]; of a tether unused
  Axes axes = Axes::world;     // of force and torque
  Vec3 point = Vec3::Zero();   // [m] in the frame of point_frame; ignored at the centre of mass
  PointFrame point_frame = PointFrame::center_of_mass;
  Vec3 target = Vec3::Zero();  // [m] of a tether, in W
  double stiffness = 0;        // [N/m] of a tether
  double damping = 0;          // [N·s/m] of a tether
  Hold hold = Hold::frame;
  std::int64_t duration_ns = 0;   // [ns] simulated time, for Hold::duration
  std::uint64_t start_frame = 0;  // first frame of effect; 0: the next
  // What a client holds ends when the client leaves or is not heard of for its lease; unless this
  // is set.
  bool outlives_client = false;
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
  BodyId body = {};               // that it acts on; of a spawn the first new one
};

inline constexpr std::uint64_t kForever = UINT64_MAX;

}  // namespace poinsot
