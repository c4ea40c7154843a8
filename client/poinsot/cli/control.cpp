#include "poinsot/cli/control.h"

#include <cstdio>

#include "poinsot/cli/connect.h"
#include "poinsot/cli/format.h"
#include "poinsot/cli/json.h"
#include "poinsot/protocol/run_control.h"

namespace poinsot {
namespace {

// A step is answered when its frames are done, at this share of real time or faster.
constexpr double kSlowestPace = 0.1;

struct ControlOptions {
  RunControl control;
  bool json = false;
};

std::chrono::nanoseconds time_to_answer(const RunControl& control, double frame_rate) {
  if (control.action != ControlAction::step) return std::chrono::nanoseconds::zero();
  const double seconds = static_cast<double>(control.frames) / (frame_rate * kSlowestPace);
  return std::chrono::nanoseconds(static_cast<std::int64_t>(std::min(seconds, 1e9) * 1e9));
}

ExitCode send(const Context& context, const ControlOptions& options) {
  Client client = connect(context);
  const double frame_rate = client.report(context.flags.timeout).frame_rate;
  const std::string_view action =
      name_of<ControlAction>(kControlActionNames, options.control.action);
  const Reply reply = client.control(
      options.control, context.flags.timeout + time_to_answer(options.control, frame_rate));
  if (options.json) std::fputs(control_json(action, reply, frame_rate).c_str(), stdout);
  if (reply.code != ResultCode::ok) {
    std::fputs(refusal_text(action, reply).c_str(), stderr);
    return ExitCode::failure;
  }
  if (!options.json) std::fputs(control_text(action, reply, frame_rate).c_str(), stdout);
  return ExitCode::ok;
}

std::shared_ptr<ControlOptions> declare(CLI::App& app, ControlAction action) {
  const auto options = std::make_shared<ControlOptions>();
  options->control.action = action;
  app.add_flag("--json", options->json, "print the answer as a JSON object");
  return options;
}

Action action_of(std::shared_ptr<ControlOptions> options) {
  return [options = std::move(options)](const Context& context) { return send(context, *options); };
}

}  // namespace

Action declare_pause(CLI::App& app) {
  return action_of(declare(app, ControlAction::pause));
}

Action declare_resume(CLI::App& app) {
  return action_of(declare(app, ControlAction::resume));
}

Action declare_step(CLI::App& app) {
  const auto options = declare(app, ControlAction::step);
  app.add_option("frames", options->control.frames, "how many frames [1]")
      ->check(CLI::Range(std::uint64_t{1}, kMaxStepFrames))
      ->type_name("N");
  return action_of(options);
}

Action declare_reset(CLI::App& app) {
  return action_of(declare(app, ControlAction::reset));
}

}  // namespace poinsot
