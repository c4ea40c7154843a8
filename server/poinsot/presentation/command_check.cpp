#include "poinsot/presentation/command_check.h"

#include <cmath>
#include <cstdio>
#include <string_view>

namespace poinsot {
namespace {

std::string text(const Vec3& v) {
  char buffer[96];
  std::snprintf(buffer, sizeof buffer, "(%g, %g, %g)", v.x(), v.y(), v.z());
  return buffer;
}

std::string text(double x) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%g", x);
  return buffer;
}

std::optional<Refusal> invalid(std::string reason) {
  return Refusal{ResultCode::invalid_value, std::move(reason)};
}

std::optional<Refusal> check_vector(std::string_view what, const Vec3& v, std::string_view unit,
                                    double limit) {
  const std::string received =
      std::string(what) + " is " + text(v) + " " + std::string(unit) + ": ";
  if (!v.allFinite()) return invalid(received + "every component must be finite");
  if (v.cwiseAbs().maxCoeff() > limit)
    return invalid(received + "no component may exceed " + text(limit));
  return std::nullopt;
}

template <class Enum>
std::optional<Refusal> check_enumerator(std::string_view what, Enum value, Enum last) {
  if (value <= last) return std::nullopt;
  return invalid(std::string(what) + " is " + std::to_string(static_cast<int>(value)) +
                 ": the largest known value is " + std::to_string(static_cast<int>(last)));
}

std::optional<Refusal> check_duration(const WrenchCommand& command) {
  const std::string received = "duration is " + std::to_string(command.duration_ns) + " ns: ";
  if (command.duration_ns <= 0) return invalid(received + "it must be positive");
  if (command.duration_ns > kMaxDurationNs)
    return invalid(received + "at most " + std::to_string(kMaxDurationNs) + " is accepted");
  return std::nullopt;
}

}  // namespace

std::optional<Refusal> check_values(const WrenchCommand& command) {
  if (command.seq == 0) return invalid("seq is 0: a client counts from 1");
  if (auto r = check_enumerator("hold", command.hold, Hold::clear)) return r;
  if (auto r = check_enumerator("axes", command.axes, Axes::body)) return r;
  if (auto r = check_enumerator("point_frame", command.point_frame, PointFrame::body)) return r;
  if (command.start_frame > kMaxFrame)
    return invalid("start_frame is " + std::to_string(command.start_frame) + ": at most " +
                   std::to_string(kMaxFrame) + " is accepted");
  if (command.hold == Hold::clear) return std::nullopt;  // carries no wrench

  if (auto r = check_vector("force", command.force, "N", kMaxWrench)) return r;
  if (auto r = check_vector("torque", command.torque, "N·m", kMaxWrench)) return r;
  if (command.point_frame != PointFrame::center_of_mass)
    if (auto r = check_vector("point", command.point, "m", kMaxPoint)) return r;
  if (command.hold == Hold::duration) return check_duration(command);
  return std::nullopt;
}

}  // namespace poinsot
