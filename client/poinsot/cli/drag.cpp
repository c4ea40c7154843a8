#include "poinsot/cli/drag.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "poinsot/cli/connect.h"
#include "poinsot/cli/send.h"
#include "poinsot/cli/slots.h"

namespace poinsot {
namespace {

constexpr double kOnePercent = 6.64;  // ωt at which (1 + ωt) exp(−ωt) = 0.01

constexpr std::array<Named<PointFrame>, 2> kAtFrameNames = {
    {{"world", PointFrame::world}, {"body", PointFrame::body}}};

// Of a body that is not there, or has none, 1 kg: the daemon then says what is wrong.
double mass_of(Client& client, const std::string& name, Client::Duration timeout) {
  const std::vector<BodyInfo> bodies = client.scene(timeout);
  const auto body = std::find_if(bodies.begin(), bodies.end(),
                                 [&](const BodyInfo& info) { return info.name == name; });
  const bool has_mass = body != bodies.end() && !body->is_static && !body->is_kinematic;
  return has_mass ? body->mass_properties.mass : 1.0;
}

ExitCode drag(const Context& context, const DragOptions& options) {
  Client client = connect(context);
  const double mass = mass_of(client, options.body, context.flags.timeout);
  return send(context, client, to_command(options, mass), "drag", options.json);
}

}  // namespace

double drag_stiffness(double mass) {
  const double omega = kOnePercent / kDragTime;
  return mass * omega * omega;
}

double critical_damping(double stiffness, double mass) {
  return 2 * std::sqrt(stiffness * mass);
}

WrenchCommand to_command(const DragOptions& options, double mass) {
  WrenchCommand command;
  command.body_name = options.body;
  command.kind = WrenchKind::tether;
  command.target = options.to;
  command.point = options.at;
  if (options.has_point) command.point_frame = options.at_frame;
  command.stiffness = options.stiffness > 0 ? options.stiffness : drag_stiffness(mass);
  command.damping =
      options.damping >= 0 ? options.damping : critical_damping(command.stiffness, mass);
  command.hold = options.has_duration ? Hold::duration : Hold::until_cleared;
  command.duration_ns = options.duration.count();
  command.slot = options.slot != 0 ? options.slot : drag_slot(options.body);
  return command;
}

void add_drag_options(CLI::App& app, DragOptions& options) {
  app.add_option("body", options.body, "name of the body")->required()->type_name("BODY");
  add_vector_option(app, "--to", options.to, "[m] where to, in the world")->required();
  CLI::Option* const at =
      add_vector_option(app, "--at", options.at,
                        "[m] the point of the body that is dragged [the centre of mass]")
          ->each([&options](const std::string&) { options.has_point = true; });
  add_choice_option<PointFrame>(app, "--at-frame", options.at_frame, kAtFrameNames,
                                "frame of that point; body: from its origin [body]")
      ->needs(at);
  app.add_option("--stiffness", options.stiffness,
                 "[N/m] [from the body's mass, so that it is there after 0.3 s]")
      ->check(CLI::PositiveNumber)
      ->type_name("K");
  app.add_option("--damping", options.damping, "[N s/m] [critical: no overshoot]")
      ->check(CLI::NonNegativeNumber)
      ->type_name("C");
  add_duration_option(app, "--for", options.duration,
                      "how long, in simulated time [until it is cleared, though this tool ends]")
      ->each([&options](const std::string&) { options.has_duration = true; });
  app.add_option("--slot", options.slot,
                 "replaces what you hold in this slot [the last drag of the same body]")
      ->check(CLI::Range(1u, kMaxUserSlot))
      ->type_name("N");
  app.add_flag("--json", options.json, "print the answer as a JSON object");
}

Action declare_drag(CLI::App& app) {
  const auto options = std::make_shared<DragOptions>();
  add_drag_options(app, *options);
  return [options](const Context& context) { return drag(context, *options); };
}

}  // namespace poinsot
