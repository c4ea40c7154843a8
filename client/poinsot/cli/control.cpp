#include "poinsot/cli/control.h"

#include "poinsot/cli/send.h"

namespace poinsot {
namespace {

std::shared_ptr<ControlOptions> options_of(CLI::App& app, ControlAction action) {
  const auto options = std::make_shared<ControlOptions>();
  options->control.action = action;
  app.add_flag("--json", options->json, "print the answer as a JSON object");
  return options;
}

Action action_of(std::shared_ptr<ControlOptions> options) {
  return [options = std::move(options)](const Context& context) {
    return send(context, options->control, options->json);
  };
}

void add_scope(CLI::App& app, ControlOptions& options, const std::string& name, ResetScope scope,
               const std::string& description) {
  app.add_flag_callback(
      name, [&options, scope] { options.control.scope |= static_cast<std::uint8_t>(scope); },
      description);
}

}  // namespace

void add_scale_options(CLI::App& app, ControlOptions& options) {
  app.add_option("scale", options.control.value,
                 "simulated time over wall time; 0: as fast as it can")
      ->required()
      ->check(CLI::Range(0.0, kMaxTimeScale))
      ->type_name("X");
}

void add_reset_options(CLI::App& app, ControlOptions& options) {
  add_scope(app, options, "--time", ResetScope::time, "only the frame and the time, to 0");
  add_scope(app, options, "--state", ResetScope::state,
            "only the bodies of the scene file: where, and as fast, as it says");
  add_scope(app, options, "--spawned", ResetScope::spawned, "only what was spawned: it is removed");
}

Action declare_pause(CLI::App& app) {
  return action_of(options_of(app, ControlAction::pause));
}

Action declare_resume(CLI::App& app) {
  return action_of(options_of(app, ControlAction::resume));
}

Action declare_step(CLI::App& app) {
  const auto options = options_of(app, ControlAction::step);
  app.add_option("frames", options->control.frames, "how many frames [1]")
      ->check(CLI::Range(std::uint64_t{1}, kMaxStepFrames))
      ->type_name("N");
  return action_of(options);
}

Action declare_until(CLI::App& app) {
  const auto options = options_of(app, ControlAction::run_until);
  add_duration_option(app, "time", options->time, "simulated time since frame 0, like 12.5s")
      ->required();
  return [options](const Context& context) {
    RunControl control = options->control;
    control.value = std::chrono::duration<double>(options->time).count();
    return send(context, control, options->json);
  };
}

Action declare_scale(CLI::App& app) {
  const auto options = options_of(app, ControlAction::scale);
  add_scale_options(app, *options);
  return action_of(options);
}

Action declare_reset(CLI::App& app) {
  const auto options = options_of(app, ControlAction::reset);
  add_reset_options(app, *options);
  return action_of(options);
}

Action declare_shutdown(CLI::App& app) {
  return action_of(options_of(app, ControlAction::shutdown));
}

}  // namespace poinsot
