#include "poinsot/cli/push.h"

#include <array>

#include "poinsot/base/error.h"
#include "poinsot/cli/send.h"
#include "poinsot/cli/slots.h"

namespace poinsot {
namespace {

// Without a point it is the centre of mass; with one, one of these.
constexpr std::array<Named<PointFrame>, 2> kAtFrameNames = {
    {{"world", PointFrame::world}, {"body", PointFrame::body}}};

ExitCode push(const Context& context, const PushOptions& options) {
  return send(context, to_command(options), "push", options.json);
}

// An option whose use is remembered.
CLI::Option* add_vector(CLI::App& app, const std::string& name, Eigen::Vector3d& value, bool& used,
                        const std::string& description) {
  return add_vector_option(app, name, value, description)->each([&used](const std::string&) {
    used = true;
  });
}

}  // namespace

void add_push_options(CLI::App& app, PushOptions& options) {
  app.add_option("body", options.body, "name of the body")->required()->type_name("BODY");
  add_vector(app, "--force", options.force, options.has_wrench, "[N]");
  add_vector(app, "--torque", options.torque, options.has_wrench, "[N m] a free couple");
  add_vector(app, "--impulse", options.impulse, options.has_impulse,
             "[N s] at once, instead of a force");
  add_vector(app, "--angular-impulse", options.angular_impulse, options.has_impulse,
             "[N m s] at once, instead of a torque");
  add_choice_option<Axes>(app, "--frame", options.axes, kAxesNames,
                          "axes of force and torque [world]");
  CLI::Option* const at = add_vector(app, "--at", options.at, options.has_point,
                                     "[m] where the force acts [the centre of mass]");
  add_choice_option<PointFrame>(app, "--at-frame", options.at_frame, kAtFrameNames,
                                "frame of that point; body: from its origin [body]")
      ->needs(at);
  CLI::Option* const duration =
      add_duration_option(app, "--for", options.duration,
                          "how long, in simulated time; rounded up to frames [one frame]");
  duration->each([&options](const std::string&) { options.has_duration = true; });
  app.add_option("--from-frame", options.from_frame, "first frame of effect [the next]")
      ->type_name("N");
  CLI::Option* const hold = app.add_flag("--hold", options.hold,
                                         "until it is cleared: it stays when this tool has ended");
  app.add_option("--slot", options.slot, "replaces what you hold in this slot, on whatever body")
      ->check(CLI::Range(1u, kMaxUserSlot))
      ->type_name("N");
  CLI::Option* const clear =
      app.add_flag("--clear", options.clear, "end all that you push the body with");
  hold->excludes(duration);
  clear->excludes(hold)->excludes(duration);
  app.add_flag("--json", options.json, "print the answer as a JSON object");
}

WrenchCommand to_command(const PushOptions& options) {
  const bool pushes = options.has_wrench || options.has_impulse;
  if (!options.clear && !pushes)
    throw Error(
        "nothing to push with: give --force x,y,z or --torque x,y,z, or --impulse x,y,z or "
        "--angular-impulse x,y,z");
  if (options.clear && pushes) throw Error("--clear ends pushes: it takes no force");
  if (options.has_wrench && options.has_impulse)
    throw Error("a push is either a force with a torque or an impulse: send two");
  if (options.has_impulse && (options.hold || options.has_duration))
    throw Error("an impulse acts at once: it takes neither --for nor --hold");
  WrenchCommand command;
  command.body_name = options.body;
  command.kind = options.has_impulse ? WrenchKind::impulse : WrenchKind::force;
  command.force = options.has_impulse ? options.impulse : options.force;
  command.torque = options.has_impulse ? options.angular_impulse : options.torque;
  command.axes = options.axes;
  command.point = options.at;
  if (options.has_point) command.point_frame = options.at_frame;
  command.duration_ns = options.duration.count();
  command.start_frame = options.from_frame;
  command.slot = options.slot;
  if (options.clear) command.hold = Hold::clear;
  if (options.hold) command.hold = Hold::until_cleared;
  if (options.has_duration) command.hold = Hold::duration;
  return command;
}

Action declare_push(CLI::App& app) {
  const auto options = std::make_shared<PushOptions>();
  add_push_options(app, *options);
  return [options](const Context& context) { return push(context, *options); };
}

}  // namespace poinsot
