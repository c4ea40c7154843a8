#include "poinsot/cli/format.h"

#include <spdlog/fmt/fmt.h>

#include "poinsot/cli/units.h"
#include "poinsot/program/log.h"
#include "poinsot/protocol/methods_text.h"

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

std::string vector_text(const Vec3& v) {
  return fmt::format("({:g}, {:g}, {:g})", v.x(), v.y(), v.z());
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
  std::string text;
  if (command.force != Vec3::Zero())
    text = "force " + vector_text(command.force) + " N " + point_text(command);
  if (command.torque != Vec3::Zero())
    text += (text.empty() ? "torque " : ", torque ") + vector_text(command.torque) + " N m";
  return text + (command.axes == Axes::world ? ", world axes" : ", body axes");
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

std::string flags_text(FrameFlag flags) {
  std::string text;
  for (const Named<FrameFlag>& row : kFrameFlagNames) {
    if (!has_flag(flags, row.value)) continue;
    if (!text.empty()) text += ' ';
    text += row.name;
  }
  return text.empty() ? "none" : text;
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
    for (const double x : *v) text += fmt::format(" {:.9g}", x);
  return text + '\n';
}

std::string push_text(const WrenchCommand& command, const Reply& reply, double frame_rate) {
  if (command.hold == Hold::clear)
    return fmt::format("{}: cleared from frame {} on ({:.3f} s)\n", command.body_name,
                       reply.first_frame, start_time(reply.first_frame, frame_rate));
  return fmt::format("{}: {}: {}\n", command.body_name,
                     until(reply.first_frame, reply.last_frame, frame_rate), wrench_text(command));
}

std::string refusal_text(std::string_view what, const Reply& reply) {
  return fmt::format("poinsot: {} refused: {} ({})\n", what, reply.message,
                     name_of<ResultCode>(kResultCodeNames, reply.code));
}

std::string control_text(std::string_view done, const Reply& reply, double frame_rate) {
  return fmt::format("{}: frame {} ({:.3f} s), epoch {}, state hash {}\n", done, reply.last_frame,
                     end_time(reply.last_frame, frame_rate), reply.epoch, hex(reply.state_hash));
}

std::string status_text(const std::string& world, const RunReport& r) {
  const FrameReport& f = r.frame;
  const LayerTimes& t = r.times;
  std::string text;
  text += fmt::format("world        {}\n", world);
  text += fmt::format("state        {}\n", state_name(r.state));
  text += fmt::format("frame        {} ({:.3f} s), epoch {}\n", f.frame, f.sim_time, r.epoch);
  text += fmt::format("pace         {:g} Hz, {:.3f} of real time, {} overruns\n", r.frame_rate,
                      r.real_time_factor, r.overruns);
  text += fmt::format("bodies       {} moving, {} asleep, {} quarantined\n", f.bodies, f.asleep,
                      f.quarantined);
  text += fmt::format("contacts     {}, deepest {:.3g} m\n", f.contacts, f.max_penetration);
  text += fmt::format("islands      {}, {} restarts, {} impact searches\n", f.islands, f.restarts,
                      f.impact_searches);
  text += fmt::format(
      "solvers      {} bodies soft_step, {} convex_newton in {} iterations, {} unconverged, "
      "residual {:.3g} m/s\n",
      f.soft_bodies, f.direct_bodies, f.solver_iterations, f.unconverged, f.contact_residual);
  text += fmt::format("impacts      {}, {} in all\n", f.impacts, f.impacts_so_far);
  text += fmt::format("energy       {:.6g} J, error {:.3g}, push-out {:.3g} J\n", f.energy,
                      f.energy_error, f.push_out_energy);
  text += fmt::format("local error  {:.3g} m, {:.3g} rad\n", f.position_error, f.orientation_error);
  text += fmt::format("momentum     error {:.3g}\n", f.momentum_error);
  const std::string methods = methods_text(f);
  text += fmt::format("methods      {}\n", methods.empty() ? "none yet" : methods);
  text += fmt::format("commands     {} accepted, {} refused\n", r.commands_accepted,
                      r.commands_refused);
  text +=
      fmt::format("dropped      {} snapshots, {} events\n", r.snapshots_dropped, r.events_dropped);
  text += fmt::format(
      "cpu [s]      presentation {:.3f}, collision {:.3f}, contact {:.3f}, simulation {:.3f}, "
      "publishing {:.3f}\n",
      t.presentation.cpu_s, t.collision.cpu_s, t.contact.cpu_s, t.simulation.cpu_s,
      t.publishing.cpu_s);
  text += fmt::format("flags        {}\n", flags_text(f.flags));
  text += fmt::format("state hash   {}\n", hex(r.state_hash));
  return text;
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
