#include "poinsot/presentation/command_check.h"

#include <cmath>
#include <string>
#include <utility>

#include "poinsot/presentation/store_name.h"

namespace poinsot {
namespace {

std::optional<Refusal> check_duration(const WrenchCommand& command) {
  const std::string received = "duration is " + std::to_string(command.duration_ns) + " ns: ";
  if (command.duration_ns <= 0) return invalid(received + "it must be positive");
  if (command.duration_ns > kMaxDurationNs)
    return invalid(received + "at most " + std::to_string(kMaxDurationNs) + " is accepted");
  return std::nullopt;
}

std::optional<Refusal> check_push(const WrenchCommand& command) {
  const bool impulse = command.kind == WrenchKind::impulse;
  if (auto r = check_vector("force", command.force, impulse ? "N·s" : "N", kMaxWrench)) return r;
  return check_vector("torque", command.torque, impulse ? "N·m·s" : "N·m", kMaxWrench);
}

std::optional<Refusal> check_tether(const WrenchCommand& command) {
  if (auto r = check_vector("target", command.target, "m", kMaxPoint)) return r;
  if (auto r = check_coefficient("stiffness", command.stiffness, "N/m", kMaxStiffness)) return r;
  return check_coefficient("damping", command.damping, "N·s/m", kMaxStiffness);
}

}  // namespace

std::optional<Refusal> check_values(const WrenchCommand& command) {
  if (command.seq == 0) return invalid("seq is 0: a client counts from 1");
  if (auto r = check_enumerator("kind", command.kind, WrenchKind::tether)) return r;
  if (auto r = check_enumerator("hold", command.hold, Hold::clear)) return r;
  if (auto r = check_enumerator("axes", command.axes, Axes::body)) return r;
  if (auto r = check_enumerator("point_frame", command.point_frame, PointFrame::body)) return r;
  if (command.start_frame > kMaxFrame)
    return invalid("start_frame is " + std::to_string(command.start_frame) + ": at most " +
                   std::to_string(kMaxFrame) + " is accepted");
  if (command.hold == Hold::clear) return std::nullopt;  // carries no wrench

  if (auto r = command.kind == WrenchKind::tether ? check_tether(command) : check_push(command))
    return r;
  if (command.point_frame != PointFrame::center_of_mass)
    if (auto r = check_vector("point", command.point, "m", kMaxPoint)) return r;
  if (command.kind == WrenchKind::impulse && command.hold != Hold::frame)
    return invalid("an impulse acts at the start of one frame: hold must be frame");
  if (command.hold == Hold::duration) return check_duration(command);
  return std::nullopt;
}

std::optional<Refusal> check_epoch(std::uint32_t meant, std::uint32_t epoch) {
  if (meant == 0 || meant == epoch) return std::nullopt;
  return Refusal{ResultCode::wrong_epoch, "meant for epoch " + std::to_string(meant) + "; epoch " +
                                              std::to_string(epoch) + " runs"};
}

std::optional<Refusal> check_scope(const RunControl& control) {
  if (control.scope <= kMaxResetScope) return std::nullopt;
  return invalid("scope is " + std::to_string(control.scope) + ": the sum of all scopes is " +
                 std::to_string(kMaxResetScope));
}

std::optional<Refusal> check_state(const RunControl& control) {
  if (!control.sets_position && !control.sets_orientation && !control.sets_linear &&
      !control.sets_angular)
    return invalid("nothing is set: neither position, orientation nor velocities");
  if (control.sets_position)
    if (auto r = check_vector("position", control.position, "m", kMaxPoint)) return r;
  if (control.sets_linear)
    if (auto r = check_vector("linear_velocity", control.linear_velocity, "m/s", kMaxSpeed))
      return r;
  if (control.sets_angular)
    if (auto r = check_vector("angular_velocity", control.angular_velocity, "rad/s", kMaxSpeed))
      return r;
  if (!control.sets_orientation) return std::nullopt;
  const double norm = control.orientation.norm();
  if (std::abs(norm - 1) <= kUnitSlack) return std::nullopt;
  return invalid("orientation must be a unit quaternion, has norm " + text(norm));
}

std::optional<Refusal> check_store_name(std::string_view name) {
  if (std::string fault = store_name_fault(name); !fault.empty()) return invalid(std::move(fault));
  if (!is_autosave_name(name)) return std::nullopt;
  return invalid(std::string(name).append(
      ": a name of autosaves, of which only the last are kept; take another"));
}

}  // namespace poinsot
