#include "poinsot/cli/push.h"

#include <array>
#include <cstdio>

#include "poinsot/base/error.h"
#include "poinsot/cli/connect.h"
#include "poinsot/cli/format.h"
#include "poinsot/cli/json.h"

namespace poinsot {
namespace {

// Without a point it is the centre of mass; with one, one of these.
constexpr std::array<Named<PointFrame>, 2> kAtFrameNames = {
    {{"world", PointFrame::world}, {"body", PointFrame::body}}};

ExitCode push(const Context& context, const PushOptions& options) {
  const WrenchCommand command = to_command(options);
  Client client = connect(context);
  const RunReport report = client.report(context.flags.timeout);
  const Reply reply = client.apply(command, context.flags.timeout);
  if (options.json) std::fputs(push_json(command, reply, report.frame_rate).c_str(), stdout);
  if (reply.code != ResultCode::ok) {
    std::fputs(refusal_text("push", reply).c_str(), stderr);
    return ExitCode::failure;
  }
  if (!options.json) std::fputs(push_text(command, reply, report.frame_rate).c_str(), stdout);
  if (report.state == RunState::paused)
    std::fputs("the run is paused: the push acts when it goes on (poinsot resume, poinsot step)\n",
               stderr);
  return ExitCode::ok;
}

}  // namespace

void add_push_options(CLI::App& app, PushOptions& options) {
  app.add_option("body", options.body, "name of the body")->required()->type_name("BODY");
  add_vector_option(app, "--force", options.force, "[N]")->each([&options](const std::string&) {
    options.has_wrench = true;
  });
  add_vector_option(app, "--torque", options.torque, "[N m] a free couple")
      ->each([&options](const std::string&) { options.has_wrench = true; });
  add_choice_option<Axes>(app, "--frame", options.axes, kAxesNames,
                          "axes of force and torque [world]");
  CLI::Option* const at =
      add_vector_option(app, "--at", options.at, "[m] where the force acts [the centre of mass]")
          ->each([&options](const std::string&) { options.has_point = true; });
  add_choice_option<PointFrame>(app, "--at-frame", options.at_frame, kAtFrameNames,
                                "frame of that point; body: from its origin [body]")
      ->needs(at);
  CLI::Option* const duration =
      add_duration_option(app, "--for", options.duration,
                          "how long, in simulated time; rounded up to frames [one frame]");
  duration->each([&options](const std::string&) { options.has_duration = true; });
  app.add_option("--from-frame", options.from_frame, "first frame of effect [the next]")
      ->type_name("N");
  CLI::Option* const hold = app.add_flag("--hold", options.hold, "until it is cleared");
  CLI::Option* const clear =
      app.add_flag("--clear", options.clear, "end all that you push the body with");
  hold->excludes(duration);
  clear->excludes(hold)->excludes(duration);
  app.add_flag("--json", options.json, "print the answer as a JSON object");
}

WrenchCommand to_command(const PushOptions& options) {
  if (!options.clear && !options.has_wrench)
    throw Error("nothing to push with: give --force x,y,z or --torque x,y,z");
  if (options.clear && options.has_wrench)
    throw Error("--clear ends pushes: it takes neither --force nor --torque");
  WrenchCommand command;
  command.body_name = options.body;
  command.force = options.force;
  command.torque = options.torque;
  command.axes = options.axes;
  command.point = options.at;
  if (options.has_point) command.point_frame = options.at_frame;
  command.duration_ns = options.duration.count();
  command.start_frame = options.from_frame;
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
