#include "poinsot/cli/format.h"

#include <spdlog/fmt/fmt.h>

#include "poinsot/cli/units.h"
#include "poinsot/cli/words.h"
#include "poinsot/program/log.h"

namespace poinsot {
namespace {

std::string_view state_name(RunState state) {
  return name_of<RunState>(kRunStateNames, state);
}

std::string until(std::uint64_t first, std::uint64_t last, double frame_rate) {
  if (last == kForever)
    return fmt::format("frames {} until cleared (from {:.3f} s)", first,
                       start_time(first, frame_rate));
  const std::uint64_t count = last - first + 1;
  const std::string frames = count == 1
                                 ? fmt::format("frame {}", first)
                                 : fmt::format("frames {} to {} ({} frames)", first, last, count);
  return fmt::format("{}, {:.3f} s to {:.3f} s", frames, start_time(first, frame_rate),
                     end_time(last, frame_rate));
}

std::string point_text(const WrenchCommand& command) {
  switch (command.point_frame) {
    case PointFrame::center_of_mass:
      return "at the centre of mass";
    case PointFrame::world:
      return "at the world's point " + vector_text(command.point) + " m";
    case PointFrame::body:
      return "at the body's point " + vector_text(command.point) + " m";
  }
  return {};
}

std::string wrench_text(const WrenchCommand& command) {
  if (command.kind == WrenchKind::tether)
    return fmt::format("tether to {} m, {:g} N/m, {:g} N s/m, {}", vector_text(command.target),
                       command.stiffness, command.damping, point_text(command));
  const bool impulse = command.kind == WrenchKind::impulse;
  std::string text;
  if (command.force != Vec3::Zero())
    text = (impulse ? "impulse " : "force ") + vector_text(command.force) +
           (impulse ? " N s " : " N ") + point_text(command);
  if (command.torque != Vec3::Zero())
    text += (text.empty() ? "" : ", ") + std::string(impulse ? "angular impulse " : "torque ") +
            vector_text(command.torque) + (impulse ? " N m s" : " N m");
  return text + (command.axes == Axes::world ? ", world axes" : ", body axes");
}

std::string cleared_text(const WrenchCommand& command) {
  std::string text = command.body_name.empty() ? "all bodies" : command.body_name;
  if (command.slot != 0) text += fmt::format(", slot {}", command.slot);
  return text;
}

// Zero has no sign.
std::string numbers(const Vec3& v) {
  return fmt::format(" {:.9g} {:.9g} {:.9g}", v.x() + 0.0, v.y() + 0.0, v.z() + 0.0);
}

std::string shape_text(const BodyInfo& body) {
  if (body.shapes.empty()) return "no shape";
  std::string text;
  for (const ShapeDef& part : body.shapes) {
    if (!text.empty()) text += '+';
    text += shape_name(part.shape);
  }
  return text;
}

}  // namespace

std::string pose_lines(const PoseSnapshot& poses, const Roster& roster, double frame_rate) {
  std::string text;
  for (const BodyState& body : poses.bodies) {
    const std::string* const name = roster.shown(body.id);
    if (name == nullptr) continue;
    text += fmt::format("{} {:.9g} {}", poses.frame, end_time(poses.frame, frame_rate),
                        poinsot::quoted(*name));
    for (const double x : body.position) text += fmt::format(" {:.9g}", x);
    for (const double x : body.orientation.coeffs()) text += fmt::format(" {:.9g}", x);
    for (const double x : body.linear_velocity) text += fmt::format(" {:.9g}", x);
    for (const double x : body.angular_velocity) text += fmt::format(" {:.9g}", x);
    text += '\n';
  }
  return text;
}

std::string impact_line(const ImpactNotice& impact, const std::string& a, const std::string& b) {
  std::string text = fmt::format("{} {:.12g} {} {}", impact.frame, impact.time, poinsot::quoted(a),
                                 poinsot::quoted(b));
  for (const Vec3* v : {&impact.point, &impact.normal, &impact.impulse, &impact.a.linear_before,
                        &impact.a.linear_after, &impact.b.linear_before, &impact.b.linear_after})
    text += numbers(*v);
  return text + '\n';
}

std::string contact_lines(const ContactSnapshot& contacts, const Roster& roster,
                          double frame_rate) {
  std::string text;
  for (const ContactState& contact : contacts.contacts) {
    const std::string* const a = roster.name(contact.a);
    const std::string* const b = roster.name(contact.b);
    if (a == nullptr || b == nullptr || !(roster.shown(contact.a) || roster.shown(contact.b)))
      continue;
    text += fmt::format("{} {:.9g} {} {}", contacts.frame, end_time(contacts.frame, frame_rate),
                        poinsot::quoted(*a), poinsot::quoted(*b));
    for (const Vec3* v : {&contact.point, &contact.normal, &contact.force}) text += numbers(*v);
    text += '\n';
  }
  return text;
}

std::string push_text(const WrenchCommand& command, const Reply& reply, double frame_rate) {
  if (command.hold == Hold::clear)
    return fmt::format("{}: cleared from frame {} on ({:.3f} s)\n", cleared_text(command),
                       reply.first_frame, start_time(reply.first_frame, frame_rate));
  return fmt::format("{}: {}: {}\n", command.body_name,
                     until(reply.first_frame, reply.last_frame, frame_rate), wrench_text(command));
}

std::string refusal_text(std::string_view what, const Reply& reply) {
  return fmt::format("poinsot: {} refused: {} ({})\n", what, reply.message,
                     name_of<ResultCode>(kResultCodeNames, reply.code));
}

std::string control_text(std::string_view done, const Reply& reply, double frame_rate) {
  return fmt::format("{}: {}frame {} ({:.3f} s), epoch {}, state hash {}\n", done,
                     reply.message.empty() ? "" : reply.message + ", ", reply.last_frame,
                     end_time(reply.last_frame, frame_rate), reply.epoch, hex(reply.state_hash));
}

std::string list_text(const std::string& world, const RunReport& report,
                      const std::vector<BodyInfo>& bodies) {
  std::string text = fmt::format("{}: {}, frame {} ({:.3f} s), {:g} Hz, {} bodies\n", world,
                                 state_name(report.state), report.frame.frame,
                                 report.frame.sim_time, report.frame_rate, bodies.size());
  for (const BodyInfo& body : bodies) {
    const std::string mass = body.is_static ? "static"
                             : body.is_kinematic
                                 ? "kinematic"
                                 : fmt::format("{:.4g} kg", body.mass_properties.mass);
    text += fmt::format("  {:<20} {:<12} {}\n", body.name, mass, shape_text(body));
  }
  return text;
}

}  // namespace poinsot
